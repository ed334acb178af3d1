// SPDX-License-Identifier: Apache-2.0
#include "console/cues/cue.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "console/cues/shown.h"

namespace aquarama::console {
namespace {

using osc::OscArgument;
using osc::OscMessage;

OscArgument whole(std::int64_t value) {
    return value;
}

TEST(Cue, eachAddressIsOneWantedValue) {
    const std::vector<std::pair<OscMessage, std::string>> cues{
        {{"/aquarama/scene", {"bait_ball"}}, "scene bait_ball"},
        {{"/aquarama/quality", {"auto"}}, "quality auto"},
        {{"/aquarama/quality", {"high"}}, "quality high"},
        {{"/aquarama/quality", {whole(0)}}, "quality low"},
        {{"/aquarama/quality", {whole(3)}}, "quality ultra"},
        {{"/aquarama/pattern", {"world"}}, "pattern world"},
        {{"/aquarama/pattern", {"grid"}}, "pattern grid"},
        {{"/aquarama/pattern", {"grey"}}, "pattern grey"},
        {{"/aquarama/black", {whole(1)}}, "black on"},
        {{"/aquarama/black", {whole(0)}}, "black off"},
        {{"/aquarama/freeze", {whole(1)}}, "freeze on"},
        {{"/aquarama/freeze", {whole(0)}}, "freeze off"},
        {{"/aquarama/guests", {whole(0)}}, "guests off"},
        {{"/aquarama/drawings", {whole(1)}}, "drawings on"},
        {{"/aquarama/brightness", {0.25}}, "brightness 0.25"},
        {{"/aquarama/brightness", {whole(1)}}, "brightness 1.00"},
        {{"/aquarama/colour", {0.0}}, "colour 0.00"},
        {{"/aquarama/day", {"dusk"}}, "day dusk"},
        {{"/aquarama/day", {"first light"}}, "day first light"},
        {{"/aquarama/day", {"clock"}}, "day clock"}};
    for (const auto& [message, text] : cues) {
        const Cue cue = cueOf(message);
        EXPECT_EQ(cue.problem, "");
        EXPECT_EQ(wire::textOf(cue.order.show()), text);
    }
}

TEST(Cue, aReleaseNamesASpecies) {
    const Cue cue = cueOf({"/aquarama/release", {"blacktip_reef_shark"}});
    EXPECT_EQ(cue.problem, "");
    EXPECT_FALSE(cue.order.has_show());
    EXPECT_EQ(cue.order.release().species(), "blacktip_reef_shark");
}

TEST(Cue, whatIsNoCueIsRefusedWithWhatItTakes) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    const std::string one = "it takes one argument: ", share = one + "a number from 0 to 1",
                      onOff = one + "1 or 0, a whole number",
                      tier = one + "low, medium, high, ultra or auto, or 0 to 3",
                      scene = one + "the name of a scene, a text",
                      pattern = one + "world, grid or grey",
                      day = one +
                            "dawn, morning, noon, afternoon, sunset, dusk, night, first light or "
                            "clock, a text",
                      species = one + "the name of a species, a text",
                      address = "there is no such address; docs/cues.md lists them";
    const std::vector<std::pair<OscMessage, std::string>> wrong{
        {{"/aquarama", {whole(1)}}, address},
        {{"/aquarama/blackout", {whole(1)}}, address},
        {{"/aquarama/dusk", {}}, address},
        {{"/AQUARAMA/black", {whole(1)}}, address},
        {{"/aquarama/black/", {whole(1)}}, address},
        {{"/aquarama/black", {}}, onOff},
        {{"/aquarama/black", {whole(1), whole(1)}}, onOff},
        {{"/aquarama/black", {whole(2)}}, onOff},
        {{"/aquarama/black", {whole(-1)}}, onOff},
        {{"/aquarama/black", {1.0}}, onOff},
        {{"/aquarama/black", {"on"}}, onOff},
        {{"/aquarama/freeze", {0.5}}, onOff},
        {{"/aquarama/drawings", {"off"}}, onOff},
        {{"/aquarama/guests", {1.0}}, onOff},
        {{"/aquarama/quality", {"best"}}, tier},
        {{"/aquarama/quality", {whole(4)}}, tier},
        {{"/aquarama/quality", {whole(-1)}}, tier},
        {{"/aquarama/quality", {1.0}}, tier},
        {{"/aquarama/pattern", {"scan"}}, pattern},
        {{"/aquarama/day", {"Dusk"}}, day},
        {{"/aquarama/day", {"day unspecified"}}, day},
        {{"/aquarama/day", {whole(5)}}, day},
        {{"/aquarama/release", {}}, species},
        {{"/aquarama/release", {whole(1)}}, species},
        {{"/aquarama/release", {""}}, species},
        {{"/aquarama/release", {"shark\n"}}, species},
        {{"/aquarama/release", {std::string(65, 'a')}}, species},
        {{"/aquarama/pattern", {whole(1)}}, pattern},
        {{"/aquarama/scene", {whole(1)}}, scene},
        {{"/aquarama/scene", {""}}, scene},
        {{"/aquarama/scene", {std::string(65, 'a')}}, scene},
        {{"/aquarama/scene", {"reef\n"}}, scene},
        {{"/aquarama/scene", {"\xFF"}}, scene},
        {{"/aquarama/brightness", {1.01}}, share},
        {{"/aquarama/brightness", {-0.01}}, share},
        {{"/aquarama/brightness", {kNone}}, share},
        {{"/aquarama/brightness", {kEndless}}, share},
        {{"/aquarama/brightness", {"0.5"}}, share},
        {{"/aquarama/brightness", {whole(255)}}, share},
        {{"/aquarama/colour", {}}, share}};
    for (const auto& [message, why] : wrong)
        EXPECT_EQ(cueOf(message).problem, why) << message.address;
}

TEST(Shown, desksAreToldTheWallInSeventeenValues) {
    v1::StatusReply status;
    status.set_frame(77);
    v1::Show& show = *status.mutable_show();
    show.set_version(1);
    show.set_look(1);
    show.set_scene("reef");
    show.set_quality(2);
    show.set_pattern(v1::PATTERN_WORLD);
    show.set_black(true);
    show.set_brightness(51);
    show.set_frozen(false);
    show.set_calibration(1);
    show.set_colour_returned(255);
    for (const auto condition :
         {v1::NODE_IN_STEP, v1::NODE_PREPARING, v1::NODE_LATE, v1::NODE_ABSENT, v1::NODE_IN_STEP})
        status.add_nodes()->set_condition(condition);
    status.set_guests(false);
    status.set_drawings(true);
    status.set_day(v1::WantedShow::FIRST_LIGHT);
    const auto shown = shownBy(status, true, {.waiting = 3, .swimming = 41});
    const double fifth = double{51.0F / 255};
    const std::vector<ShownValue> expected{{"running", whole(1)},
                                           {"scene", "reef"},
                                           {"quality", "high"},
                                           {"pattern", "world"},
                                           {"black", whole(1)},
                                           {"freeze", whole(0)},
                                           {"brightness", fifth},
                                           {"colour", 1.0},
                                           {"guests", whole(0)},
                                           {"drawings", whole(1)},
                                           {"day", "first light"},
                                           {"drawings_waiting", whole(3)},
                                           {"drawings_swimming", whole(41)},
                                           {"frame", whole(77)},
                                           {"nodes_in_step", whole(2)},
                                           {"nodes_late", whole(1)},
                                           {"nodes_absent", whole(2)}};
    ASSERT_EQ(shown.size(), expected.size());
    for (std::size_t i = 0; i < shown.size(); ++i)
        EXPECT_EQ(shown[i], expected[i]) << shown[i].name;
    EXPECT_EQ(shownBy({}, false)[0], (ShownValue{"running", whole(0)})) << "no master is heard";
}

}  // namespace
}  // namespace aquarama::console
