// SPDX-License-Identifier: Apache-2.0
// A rig's file is read as written, and refused at the place of its first mistake.
#include "common/config/rig.h"

#include <algorithm>
#include <fstream>
#include <numbers>
#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/base/units.h"

namespace aquarama::config {
namespace {

const std::string kRig =
    R"(# A small rig.
name: "small"
screen { radius_m: 2 arc_deg: 90 height_m: 1 }
panorama { width_px: 640 height_px: 200 }
network {
  control: "tcp://127.0.0.1:7400"
  state: "tcp://127.0.0.1:7401"
}
timing { refresh_hz: 50 membership_s: 0.5 }
scene: "sea.txtpb"
channels {
  id: 4
  name: "left"
  width_px: 320
  height_px: 240
  projector { position { x_m: 0.5 y_m: 1 z_m: 0.25 } yaw_deg: 20 pitch_deg: -3 roll_deg: 1.5)"
    R"( focal_x_px: 300 focal_y_px: 310 principal_x_px: 150 principal_y_px: -20 }
  display { mode: FULLSCREEN connector: "HDMI-A-2" device: "device:2" refresh_hz: 50 }
}
channels {
  id: 5
  name: "right"
  width_px: 321
  height_px: 241
  projector { position { x_m: -0.5 y_m: 1 z_m: 0.25 } focal_x_px: 300 focal_y_px: 300 }
  display { mode: WINDOW window_x_px: -10 window_y_px: 30 }
}
)";

// The text of a standby, with one value replaced.
std::string withStandby(const std::string& good = "", const std::string& bad = "") {
    std::string block = R"(standby { machine: "spare" control: "tcp://127.0.0.1:7500")"
                        R"( state: "tcp://127.0.0.1:7501" etcd: "http://127.0.0.1:2379")"
                        R"( etcd: "https://192.168.7.1:2379" }
)";
    if (!good.empty()) block.replace(block.find(good), good.size(), bad);
    return kRig + block;
}

TEST(Rig, namesItsStandby) {
    EXPECT_FALSE(parseRig(kRig, "small.txtpb").standby);
    const Rig rig = parseRig(withStandby(), "small.txtpb");
    ASSERT_TRUE(rig.standby);
    EXPECT_EQ(rig.standby->machine, "spare");
    EXPECT_EQ(rig.standby->controlAddress, "tcp://127.0.0.1:7500");
    EXPECT_EQ(rig.standby->stateAddress, "tcp://127.0.0.1:7501");
    EXPECT_EQ(rig.standby->etcd,
              (std::vector<std::string>{"http://127.0.0.1:2379", "https://192.168.7.1:2379"}));
}

TEST(Rig, refusesAStandbyThatCannotBe) {
    struct Case {
        std::string good, bad, why;
    };
    for (const auto& [good, bad, why] :
         {Case{"machine: \"spare\"", "", "lacks machine"},
          Case{"7500", "7400", "the master's own address"},
          Case{"7501", "7500", "state and control share one port"},
          Case{"tcp://127.0.0.1:7500", "tcp://192.168.7.2:7500", "only one of them"},
          Case{"tcp://127.0.0.1:7501", "127.0.0.1:7501", "no address"},
          Case{"http://127.0.0.1:2379", "127.0.0.1:2379", "no address"},
          Case{"http://127.0.0.1:2379", "http://127.0.0.1", "no address"},
          Case{"http://127.0.0.1:2379", "http://127.0.0.1:x", "port"},
          Case{"https://192.168.7.1:2379", "http://192.168.7.1:2379", "write https"},
          Case{"https://192.168.7.1:2379", "https://etcd.example:2379", "one network card"}}) {
        try {
            static_cast<void>(parseRig(withStandby(good, bad), "small.txtpb"));
            ADD_FAILURE() << bad;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(why));
            EXPECT_THAT(error.what(), testing::StartsWith("small.txtpb:27:")) << "the place";
        }
    }
}

TEST(Rig, everyValueArrivesInItsPlace) {
    const Rig rig = parseRig(kRig, "small.txtpb");
    EXPECT_EQ(rig.name, "small");
    EXPECT_EQ(rig.screen.radiusMetres, 2);
    EXPECT_DOUBLE_EQ(rig.screen.arcRadians, std::numbers::pi / 2);
    EXPECT_EQ(rig.screen.heightMetres, 1);
    EXPECT_EQ(rig.panoramaPixels, glm::ivec2(640, 200));
    EXPECT_EQ(rig.controlAddress, "tcp://127.0.0.1:7400");
    EXPECT_EQ(rig.stateAddress, "tcp://127.0.0.1:7401");
    EXPECT_EQ(rig.timing.refreshHertz, 50);
    EXPECT_EQ(rig.timing.membershipSeconds, 0.5);
    EXPECT_EQ(rig.scene, "sea.txtpb");
    ASSERT_EQ(rig.channels.size(), 2U);

    const Channel& left = rig.channels[0];
    EXPECT_EQ(left.id, 4U);
    EXPECT_EQ(left.name, "left");
    EXPECT_EQ(left.sizePixels, glm::ivec2(320, 240));
    EXPECT_EQ(left.projector.positionMetres, glm::dvec3(0.5, 1, 0.25));
    EXPECT_EQ(left.projector.yawPitchRollRadians,
              glm::dvec3(20 * kRadiansPerDegree<double>,
                         -3 * kRadiansPerDegree<double>,
                         1.5 * kRadiansPerDegree<double>));
    EXPECT_EQ(left.projector.focalPixels, glm::dvec2(300, 310));
    EXPECT_EQ(left.projector.principalPixels, glm::dvec2(150, -20));
    EXPECT_EQ(left.display.mode, DisplayMode::Fullscreen);
    EXPECT_EQ(left.display.connector, "HDMI-2") << "as X names it";
    EXPECT_EQ(left.display.device, "device:2");
    EXPECT_EQ(left.display.refreshHertz, 50);
    EXPECT_EQ(left.place.line, 11);
    EXPECT_EQ(rig.channels[1].display.mode, DisplayMode::Window);
    EXPECT_EQ(rig.channels[1].display.windowPosition, glm::ivec2(-10, 30));
}

TEST(Rig, whatIsLeftOutGetsItsDocumentedDefault) {
    const Rig rig = parseRig(kRig, "small.txtpb");
    EXPECT_EQ(rig.timing.presentDeadlineSeconds, 1.0 / 50);  // one refresh
    const Channel& right = rig.channels[1];
    EXPECT_EQ(right.projector.yawPitchRollRadians, glm::dvec3(0));
    EXPECT_EQ(right.projector.principalPixels, glm::dvec2(160.5, 120.5));
    EXPECT_EQ(right.display.device, "auto");
    EXPECT_FALSE(right.display.refreshHertz.has_value());
}

TEST(Rig, keepsTheTextOfItsFile) {
    EXPECT_EQ(parseRig(kRig, "small.txtpb").text, kRig);
}

TEST(Rig, saysHowFineItsWallIsDrawnOrLeavesItToMeasuring) {
    EXPECT_EQ(parseRig(kRig, "small.txtpb").quality, std::nullopt);
    EXPECT_EQ(parseRig(kRig + "quality: MEASURED", "small.txtpb").quality, std::nullopt);
    EXPECT_EQ(parseRig(kRig + "quality: LOW", "small.txtpb").quality, QualityTier::Low);
    EXPECT_EQ(parseRig(kRig + "quality: ULTRA", "small.txtpb").quality, QualityTier::Ultra);
}

TEST(Rig, isMonoFromTheOriginUnlessItSaysOtherwise) {
    const Rig mono = parseRig(kRig, "small.txtpb");
    EXPECT_EQ(mono.stereo.mode, StereoMode::Mono);
    EXPECT_EQ(mono.stereo.eyeSeparationMetres, 0.063);
    EXPECT_EQ(mono.sweetSpotMetres, glm::dvec3(0));
    EXPECT_FALSE(mono.channels[0].display.stereo);

    std::string text = kRig +
                       "stereo { mode: INTERLACED eye_separation_m: 0.07 swap_eyes: true }\n"
                       "sweet_spot { x_m: 0.5 y_m: -0.25 z_m: 1 }";
    text.replace(text.find("mode: WINDOW"), 12, "mode: WINDOW stereo: ANAGLYPH swap_eyes: false");
    const Rig rig = parseRig(text, "small.txtpb");
    EXPECT_EQ(rig.stereo.mode, StereoMode::Interlaced);
    EXPECT_EQ(rig.stereo.eyeSeparationMetres, 0.07);
    EXPECT_TRUE(rig.stereo.swapEyes);
    EXPECT_EQ(rig.sweetSpotMetres, glm::dvec3(0.5, -0.25, 1));
    EXPECT_EQ(rig.channels[1].display.stereo, StereoMode::Anaglyph);
    EXPECT_EQ(rig.channels[1].display.swapEyes, false);
    EXPECT_FALSE(rig.channels[0].display.stereo);
}

TEST(Rig, everyModeOfStereoIsReadAndNamed) {
    for (const std::string mode :
         {"MONO", "QUAD_BUFFER", "TOP_BOTTOM", "INTERLACED", "ANAGLYPH", "SIDE_BY_SIDE"}) {
        std::string text = kRig + "stereo { mode: " + mode + " }";
        text.replace(text.find("width_px: 321"), 13, "width_px: 320");
        text.replace(text.find("height_px: 241"), 14, "height_px: 240");
        EXPECT_EQ(nameOf(parseRig(text, "small.txtpb").stereo.mode), mode);
    }
}

TEST(Rig, hasADeskOnlyWhereItNamesOne) {
    EXPECT_FALSE(parseRig(kRig, "small.txtpb").cues.osc);
    EXPECT_FALSE(parseRig(kRig + "cues {}", "small.txtpb").cues.osc);
    const Rig rig = parseRig(kRig + R"(cues { osc {
        listen: "udp://[fd00:0::1]:7500" from: "fd00:0::2" from: "192.168.7.40"
        send_to: "udp://[fd00::3]:53001" } })",
                             "small.txtpb");
    ASSERT_TRUE(rig.cues.osc);
    EXPECT_EQ(rig.cues.osc->listen, (UdpAddress{"fd00::1", 7500}));
    EXPECT_EQ(rig.cues.osc->from, (std::vector<std::string>{"fd00::2", "192.168.7.40"}));
    EXPECT_EQ(rig.cues.osc->sendTo, (std::vector<UdpAddress>{{"fd00::3", 53001}}));
    EXPECT_EQ(textOf(rig.cues.osc->listen), "udp://[fd00::1]:7500");
}

TEST(Rig, aLightingDeskDrivesWhatItNames) {
    const Rig rig = parseRig(kRig + "cues { art_net { universe: 0 black: 512 } }", "small.txtpb");
    ASSERT_TRUE(rig.cues.dmx);
    EXPECT_FALSE(rig.cues.osc);
    EXPECT_EQ(rig.cues.dmx->universe, 0U);
    EXPECT_FALSE(rig.cues.dmx->brightness);
    EXPECT_EQ(rig.cues.dmx->black, 512U);
    const auto why = [](const std::string& artNet) -> std::string {
        try {
            static_cast<void>(parseRig(kRig + "cues { art_net { " + artNet + " } }", "bad.txtpb"));
        } catch (const Error& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(why("universe: 1 brightness: 1 black: 2"), "accepted");
    EXPECT_THAT(why("brightness: 1"), testing::HasSubstr("universe"));
    EXPECT_THAT(why("universe: 1"), testing::HasSubstr("give brightness, black or both"));
    EXPECT_THAT(why("universe: 1 brightness: 513"), testing::HasSubstr("512"));
    EXPECT_THAT(why("universe: 1 brightness: 7 black: 7"), testing::HasSubstr("one of its own"));
}

TEST(Rig, aDeskThatCannotBeHeardIsRefusedAtItsPlace) {
    const auto why = [](const std::string& osc) -> std::string {
        try {
            static_cast<void>(parseRig(kRig + "cues { osc { " + osc + " } }", "bad.txtpb"));
        } catch (const Error& error) {
            return error.what();
        }
        return "accepted";
    };
    const std::string from = " from: \"127.0.0.1\"";
    EXPECT_EQ(why("listen: \"udp://127.0.0.1:7500\"" + from), "accepted");
    for (const std::string listen : {"7500",
                                     "127.0.0.1:7500",
                                     "tcp://127.0.0.1:7500",
                                     "udp://0.0.0.0:7500",
                                     "udp://[::]:7500",
                                     "udp://*:7500",
                                     "udp://localhost:7500",
                                     "udp://224.0.0.1:7500",
                                     "udp://127.0.0.1",
                                     "udp://127.0.0.1:0",
                                     "udp://127.0.0.1:65536",
                                     "udp://127.0.0.1:75x",
                                     "udp://::1:7500",
                                     "udp://[127.0.0.1]:7500"})
        EXPECT_EQ(
            why("listen: \"" + listen + "\"" + from),
            "bad.txtpb:27:14: listen \"" + listen +
                "\" is no address of one machine: write udp://192.168.7.1:PORT; names are not "
                "looked up");
    EXPECT_THAT(why("listen: \"udp://127.0.0.1:7500\""), testing::HasSubstr("from"));
    EXPECT_THAT(why("listen: \"udp://127.0.0.1:7500\"" + from + " from: \"127.0.0.1:1\""),
                testing::HasSubstr("bad.txtpb:27:63: from \"127.0.0.1:1\" is no number"));
    EXPECT_THAT(why("listen: \"udp://127.0.0.1:7500\"" + from + " send_to: \"desk:1\""),
                testing::HasSubstr("send_to \"desk:1\" is no address"));
    EXPECT_THAT(why("listen: \"udp://127.0.0.1:7500\"" + from + " send_to: \"udp://[::1]:1\""),
                testing::HasSubstr("is of another version than listen"));
    EXPECT_THAT(why(from), testing::HasSubstr("listen"));
}

TEST(Rig, theRigsThatComeWithAquaramaAreValid) {
    for (const std::string name : {"theatre", "touring", "desk", "desk_stereo"}) {
        const Rig rig = readRig(AQUARAMA_SOURCE_DIR "/config/" + name + ".txtpb");
        EXPECT_EQ(rig.name, name);
        EXPECT_EQ(rig.channels.size(), 3U);
    }
}

struct Mistake {
    std::string name;
    std::string good, bad;  // `good` is replaced by `bad` in kRig
    std::string at;   // the error points to the first of this in the mistake's line or after it
    std::string why;  // and says this
};

std::ostream& operator<<(std::ostream& out, const Mistake& mistake) {
    return out << mistake.name;
}

// file:line:column of a position in a text, by counting: nothing of the parser is used.
std::string placeOf(const std::string& text, std::size_t position) {
    const auto line =
        std::count(text.begin(), text.begin() + static_cast<long>(position), '\n') + 1;
    const std::size_t before = position == 0 ? std::string::npos : text.rfind('\n', position - 1);
    const std::size_t start = before == std::string::npos ? 0 : before + 1;
    return "bad.txtpb:" + std::to_string(line) + ":" + std::to_string(position - start + 1) + ": ";
}

class BadRig : public testing::TestWithParam<Mistake> {};

TEST_P(BadRig, isRefusedInOneLineThatNamesThePlace) {
    const Mistake& mistake = GetParam();
    const std::size_t start = kRig.find(mistake.good);
    ASSERT_NE(start, std::string::npos);
    std::string text = kRig;
    text.replace(start, mistake.good.size(), mistake.bad);
    const std::size_t wrong =
        mistake.at.empty() ? 0 : text.find(mistake.at, kRig.rfind('\n', start) + 1);
    ASSERT_NE(wrong, std::string::npos);
    try {
        (void)parseRig(text, "bad.txtpb");
        FAIL() << "accepted";
    } catch (const Error& error) {
        const std::string said = error.what();
        EXPECT_THAT(said, testing::StartsWith(placeOf(text, wrong)));
        EXPECT_THAT(said, testing::HasSubstr(mistake.why));
        EXPECT_EQ(said.find('\n'), std::string::npos);
    }
}

// `at` empty: the whole file, 1:1.
INSTANTIATE_TEST_SUITE_P(
    Rig,
    BadRig,
    testing::Values(
        Mistake{"unknownField", "radius_m: 2", "radius_m: 2 colour: 3", ": 3", "colour"},
        Mistake{"brokenText", "panorama {", "panorama {{", "{ width", "Expected"},
        Mistake{"unclosedBrace",
                "7401\"\n}",
                "7401\"",
                "{ refresh_hz: 50 m",
                "no field named \"timing\""},
        Mistake{"wrongType", "radius_m: 2", "radius_m: \"2\"", "\"2\"", "Expected"},
        Mistake{"fieldTwice", "radius_m: 2", "radius_m: 2 radius_m: 3", ": 3", "multiple times"},
        Mistake{"missingName", "name: \"small\"", "", "", "lacks name"},
        Mistake{"missingScreen",
                "screen { radius_m: 2 arc_deg: 90 height_m: 1 }",
                "",
                "",
                "lacks screen"},
        Mistake{"missingRadius", "screen { radius_m: 2", "screen { ", "screen", "lacks radius_m"},
        Mistake{"missingFocal",
                " focal_x_px: 300 focal_y_px: 310",
                " focal_x_px: 300",
                "projector",
                "lacks focal_y_px"},
        Mistake{"noChannels",
                kRig.substr(kRig.find("channels")),
                "",
                "",
                "the file lacks channels: give 1 to 64"},
        Mistake{"radiusZero", "radius_m: 2", "radius_m: 0", "radius_m", "must be from"},
        Mistake{"radiusNan", "radius_m: 2", "radius_m: nan", "radius_m", "must be from"},
        Mistake{"arcNegative", "arc_deg: 90", "arc_deg: -90", "arc_deg", "must be from"},
        Mistake{"arcPastAlmostRound", "arc_deg: 90", "arc_deg: 301", "arc_deg", "must be from"},
        Mistake{"heightInfinite", "height_m: 1", "height_m: inf", "height_m", "must be from"},
        Mistake{"windowOfNoWidth", "width_px: 320", "width_px: 0", "width_px", "must be from"},
        Mistake{"windowOfNoHeight", "height_px: 241", "height_px: 0", "height_px", "must be from"},
        Mistake{"panoramaTooLarge", "width_px: 640", "width_px: 99999", "width_px", "must be from"},
        Mistake{"focalZero", "focal_y_px: 310", "focal_y_px: 0", "focal_y_px", "must be from"},
        Mistake{"qualityUnspecified",
                "scene: \"sea.txtpb\"",
                "scene: \"sea.txtpb\" quality: QUALITY_UNSPECIFIED",
                "quality",
                "MEASURED, LOW, MEDIUM, HIGH or ULTRA"},
        Mistake{"noScene", "scene: \"sea.txtpb\"", "", "", "lacks scene"},
        Mistake{"sceneOfNoName", "\"sea.txtpb\"", "\"\"", "scene", "is empty"},
        Mistake{"theCastOfOlderRigs",
                "scene: \"sea.txtpb\"",
                "cast { fish: 1 }",
                "{ fish: 1 }",
                "cast"},
        Mistake{"idTaken", "id: 5", "id: 4", "id: 4", "taken"},
        Mistake{"nameTaken", "name: \"right\"", "name: \"left\"", "name", "taken"},
        Mistake{"nameWithSlash", "name: \"right\"", "name: \"../x\"", "name", "also names files"},
        Mistake{"connectorTaken",
                "mode: WINDOW",
                "mode: FULLSCREEN connector: \"HDMI-2\"",
                "connector",
                "\"HDMI-2\" already"},
        Mistake{"monitorsCounted",
                "connector: \"HDMI-A-2\"",
                "monitor: 1",
                "monitor",
                "name the connector, as connector: \"HDMI-1\"; this machine has "},
        Mistake{"bindAnywhere",
                "tcp://127.0.0.1:7400",
                "tcp://*:7400",
                "control: ",
                "one network card"},
        Mistake{"bindToNetwork",
                "tcp://127.0.0.1:7401",
                "tcp://192.168.1.7:7401",
                "state: ",
                "one host"},
        Mistake{"depotOnAPortOfOthers",
                "state: \"tcp://127.0.0.1:7401\"",
                "state: \"tcp://127.0.0.1:7401\" depot: \"tcp://127.0.0.1:7400\"",
                "depot: ",
                "a port of its own"},
        Mistake{"depotElsewhere",
                "state: \"tcp://127.0.0.1:7401\"",
                "state: \"tcp://127.0.0.1:7401\" depot: \"tcp://192.168.1.7:7403\"",
                "depot: ",
                "the host of control"},
        Mistake{"noScheme", "tcp://127.0.0.1:7400", "127.0.0.1:7400", "control: ", "no address"},
        Mistake{"noPort", "tcp://127.0.0.1:7400", "tcp://127.0.0.1", "control: ", "no address"},
        Mistake{"portWord", "tcp://127.0.0.1:7400", "tcp://127.0.0.1:x", "control: ", "port"},
        Mistake{
            "portTooHigh", "tcp://127.0.0.1:7400", "tcp://127.0.0.1:70000", "control: ", "port"},
        Mistake{
            "equalPorts", "tcp://127.0.0.1:7401", "tcp://localhost:7400", "state: ", "one port"},
        Mistake{"unknownDevice", "device:2", "radeon", "device: ", "unknown device"},
        Mistake{"deviceWithoutNumber", "device:2", "device:", "device: ", "unknown device"},
        Mistake{"unknownMode", "mode: WINDOW", "mode: TILED", "window_x_px", "TILED"},
        Mistake{"noMode", "mode: WINDOW ", "", "display", "lacks mode"},
        Mistake{
            "unspecifiedMode", "mode: WINDOW", "mode: MODE_UNSPECIFIED", "mode", "write WINDOW"},
        Mistake{"unknownStereo",
                "device: \"device:2\"",
                "stereo: MODE_UNSPECIFIED",
                "stereo: ",
                "SIDE_BY_SIDE"},
        Mistake{"oddHalves",
                "scene: \"sea.txtpb\"",
                "scene: \"sea.txtpb\" stereo { mode: TOP_BOTTOM }",
                "height_px: 241",
                "is odd"},
        Mistake{"impatientMembership",
                "membership_s: 0.5",
                "membership_s: 0.01",
                "membership_s",
                "shorter"}),
    [](const auto& test) { return test.param.name; });

// The small rig with something before its channels.
std::string rigWith(const std::string& line) {
    std::string text = kRig;
    return text.insert(text.find("scene:"), line + "\n");
}

// What is said of the small rig with this in it.
std::string saidOf(const std::string& text) {
    try {
        static_cast<void>(parseRig(kRig + text, "bad.txtpb"));
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Rig, letsVisitorsTakePartWhereItSaysHowPhonesReachIt) {
    EXPECT_FALSE(parseRig(kRig, "small.txtpb").guests);
    const Rig rig = parseRig(
        kRig + "guests { address: \"http://192.168.20.1:7490\" corner: UPPER_RIGHT height: 0.2 }",
        "small.txtpb");
    ASSERT_TRUE(rig.guests);
    EXPECT_EQ(rig.guests->host, "192.168.20.1");
    EXPECT_EQ(rig.guests->port, 7490);
    EXPECT_EQ(rig.guests->channel, rig.channels.front().name);
    EXPECT_EQ(rig.guests->corner, Guests::Corner::UpperRight);
    EXPECT_EQ(rig.guests->height, 0.2);
    const Rig six = parseRig(kRig + "guests { address: \"http://[FD00:0::1]:7490\" }", "six.txtpb");
    EXPECT_EQ(six.guests->host, "fd00::1") << "as browsers write it";
    EXPECT_EQ(six.guests->port, 7490);
    for (const std::string address : {"192.168.20.1:7490",
                                      "https://192.168.20.1:7490",
                                      "http://192.168.20.1",
                                      "http://:7490",
                                      "http://192.168.20.1:0",
                                      "http://192.168.20.1:70000",
                                      "http://192.168.20.1:74x",
                                      "http://wall.example:7490",
                                      "http://0.0.0.0:7490",
                                      "http://[::]:7490",
                                      "http://[fe80::1]:7490",
                                      "http://fd00::1:7490",
                                      "http://[192.168.20.1]:7490"})
        EXPECT_THAT(saidOf("guests { address: \"" + address + "\" }"),
                    testing::AllOf(testing::StartsWith("bad.txtpb:"),
                                   testing::HasSubstr("names are not looked up")))
            << address;
    EXPECT_THAT(saidOf("guests { address: \"http://10.0.0.1:80\" channel: \"attic\" }"),
                testing::HasSubstr("no channel \"attic\""));
}

TEST(Rig, namesTheSurfaceThatATrackerWatches) {
    EXPECT_FALSE(parseRig(kRig, "small.txtpb").touch);
    const std::string corners =
        " top_left { x_m: -2 y_m: 1 z_m: -3 } top_right { x_m: 2 y_m: 1 z_m: -3 }";
    const std::string touch = "touch { listen: \"udp://127.0.0.1:3333\"" + corners;
    const Rig rig =
        parseRig(kRig + touch + " bottom_left { x_m: -2 y_m: -1 z_m: -3 } }", "small.txtpb");
    ASSERT_TRUE(rig.touch);
    EXPECT_EQ(rig.touch->listen, (UdpAddress{"127.0.0.1", 3333}));
    EXPECT_EQ(rig.touch->from, std::vector<std::string>{"127.0.0.1"});
    EXPECT_EQ(rig.touch->bottomLeft, glm::dvec3(-2, -1, -3));
    EXPECT_THAT(saidOf(touch + " bottom_left { x_m: 0 y_m: 1 z_m: -3 } }"),
                testing::HasSubstr("lie on one line"));
    EXPECT_THAT(saidOf(touch + " bottom_left { x_m: 0 y_m: 0.9 z_m: -3 } }"),
                testing::HasSubstr("or nearly"))
        << "of 4 m, 5 cm aside";
    EXPECT_THAT(saidOf(touch + " bottom_left { x_m: -2 y_m: 1.01 z_m: -3 } }"),
                testing::HasSubstr("or nearly"))
        << "a centimetre high";
    EXPECT_THAT(saidOf(touch + " }"), testing::HasSubstr("bottom_left"));
    EXPECT_THAT(
        saidOf("touch { listen: \"3333\"" + corners + " bottom_left { x_m: -2 y_m: -1 z_m: -3 } }"),
        testing::HasSubstr("no address of one machine"));
}

// A tracker of people watches the floor, below the viewer's eye.
TEST(Rig, theCornersOfPeopleLieOnTheFloor) {
    const auto corners = [](double height, double farHeight) {
        const std::string y = std::to_string(height);
        return "touch { listen: \"udp://127.0.0.1:3333\" top_left { x_m: -2 z_m: -2 y_m: " + y +
               "} top_right { x_m: 2 z_m: -2 y_m: " + y +
               "} bottom_left { x_m: -2 z_m: 0 y_m: " + std::to_string(farHeight) + "} ";
    };
    const Rig rig = parseRig(kRig + corners(-1.6, -1.6) + "people { } }", "small.txtpb");
    EXPECT_EQ(rig.touch->peopleReachMetres, 2.5);
    EXPECT_FALSE(
        parseRig(kRig + corners(-1.6, -1.6) + "}", "small.txtpb").touch->peopleReachMetres);
    EXPECT_EQ(saidOf(corners(-1.6, -1.2) + "people { reach_m: 4 } }"), "accepted")
        << "a floor that rises";
    for (const std::string& wrong : {corners(1.6, 1.6), corners(-1.6, -0.2)})
        EXPECT_THAT(saidOf(wrong + "people { reach_m: 4 } }"), testing::HasSubstr("on the floor"));
    EXPECT_THAT(saidOf(corners(-1.6, -1.6) + "people { reach_m: 0 } }"),
                testing::HasSubstr("reach_m"));
}

TEST(Rig, aCalibrationIsTheWallFileOfAllItsChannels) {
    const Rig rig = parseRig(rigWith("calibration: \"walls/hall.mpcdi\""), "small.txtpb");
    ASSERT_EQ(rig.channels.size(), 2U);
    for (const Channel& channel : rig.channels) {
        ASSERT_TRUE(channel.wallFile);
        EXPECT_EQ(channel.wallFile->file, "walls/hall.mpcdi");
        EXPECT_EQ(channel.wallFile->region, channel.name);
        EXPECT_GT(channel.projector.focalPixels.x, 0) << "where the next calibration begins";
    }
    EXPECT_EQ(rig.files.count("walls/hall.mpcdi"), 1U);
}

TEST(Rig, aWallFileOfItsOwnGoesBeforeTheCalibration) {
    std::string text = rigWith("calibration: \"hall.mpcdi\"");
    text.insert(text.find("  projector"), "  wall_file { file: \"own.mpcdi\" region: \"A\" }\n");
    const Rig rig = parseRig(text, "small.txtpb");
    EXPECT_EQ(rig.channels[0].wallFile->file, "own.mpcdi");
    EXPECT_EQ(rig.channels[0].wallFile->region, "A");
    EXPECT_EQ(rig.channels[1].wallFile->file, "hall.mpcdi");
}

TEST(Rig, asHungItNeedsNoCalibration) {
    const std::string path = testing::TempDir() + "/as_hung.txtpb";
    std::ofstream(path) << rigWith("calibration: \"is_not_there.mpcdi\"");
    EXPECT_THROW((void)readRig(path), Error);
    const Rig rig = readRigAsHung(path);
    EXPECT_FALSE(rig.channels[0].wallFile);
    EXPECT_TRUE(rig.files.empty());
}

TEST(Rig, aFileThatIsNotThereIsRefusedByName) {
    for (const std::string path : {"config/none.txtpb", "config"}) try {
            (void)readRig(path);
            ADD_FAILURE() << path << " was read";
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), testing::StartsWith(path + ": "));
        }
}

}  // namespace
}  // namespace aquarama::config
