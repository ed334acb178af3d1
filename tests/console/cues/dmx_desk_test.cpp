// SPDX-License-Identifier: Apache-2.0
// A lighting desk whose universe is a list of frames.
#include "console/cues/dmx_desk.h"

#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/wire/wanted_show.h"

namespace aquarama::console {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// What the universe has, as a test sets it.
struct Universe {
    std::optional<DmxFrame> next;
    bool isThere = true;
};

class Source final : public DmxSource {
  public:
    explicit Source(Universe& universe) : universe_{universe} {}
    std::optional<DmxFrame> hear() override {
        if (!universe_.isThere) throw Error("olad does not answer");
        return std::exchange(universe_.next, {});
    }

  private:
    Universe& universe_;
};

class LightingDesk : public testing::Test {
  protected:
    void send(const DmxFrame& frame) {
        universe.next = frame;
        pass(0.1);
    }
    void pass(double seconds) {
        const double until = now + seconds;
        for (; now < until - 1e-6; now += 0.1) desk.tick(now);
    }
    std::vector<std::string> takeOrders() { return std::exchange(orders, {}); }

    Universe universe;
    std::vector<std::string> orders;
    double now = 0;
    int opened = 0;
    DmxDesk desk{{.universe = 4, .brightness = 1, .black = 3},
                 [this](const std::string& who, const v1::Order& order) {
                     orders.push_back(who + ": " + wire::textOf(order.show()));
                     return v1::OrderReply{};
                 },
                 [this](std::uint32_t number) -> std::unique_ptr<DmxSource> {
                     EXPECT_EQ(number, 4U);
                     ++opened;
                     if (!universe.isThere) throw Error("olad does not answer");
                     return std::make_unique<Source>(universe);
                 }};
};

TEST_F(LightingDesk, changesOfItsChannelsAreOrders) {
    send({0, 7, 255});
    EXPECT_THAT(takeOrders(), IsEmpty()) << "what it begins with changes nothing";
    send({0, 9, 255});
    EXPECT_THAT(takeOrders(), IsEmpty()) << "a channel that drives nothing";
    send({255, 9, 0});
    EXPECT_THAT(takeOrders(), ElementsAre("DMX universe 4: black off, brightness 1.00"));
    send({51, 9, 127});
    EXPECT_THAT(takeOrders(), ElementsAre("DMX universe 4: brightness 0.20"));
    send({51, 9, 128});
    EXPECT_THAT(takeOrders(), ElementsAre("DMX universe 4: black on"));
    send({51, 9, 128});
    pass(5);
    EXPECT_THAT(takeOrders(), IsEmpty());
}

TEST_F(LightingDesk, aShortFrameDrivesWhatItHas) {
    send({10});
    send({20});
    EXPECT_THAT(takeOrders(), ElementsAre("DMX universe 4: brightness 0.08"));
    send({});
    send({20, 0, 200});
    EXPECT_THAT(takeOrders(), IsEmpty()) << "black is heard for the first time";
}

TEST_F(LightingDesk, silenceIsAProblemAndChangesNothing) {
    pass(9);
    EXPECT_EQ(desk.problem(), "");
    pass(2);
    EXPECT_THAT(desk.problem(), HasSubstr("no DMX in universe 4 for 10 s"));
    send({10, 0, 0});
    EXPECT_EQ(desk.problem(), "");
    send({20, 0, 0});
    EXPECT_EQ(takeOrders().size(), 1U);
    pass(11);
    EXPECT_THAT(desk.problem(), HasSubstr("stays as it is"));
    EXPECT_THAT(takeOrders(), IsEmpty());
    send({30, 0, 0});
    EXPECT_THAT(takeOrders(), ElementsAre("DMX universe 4: brightness 0.12"));
}

TEST_F(LightingDesk, oladIsLookedForOnceASecond) {
    universe.isThere = false;
    pass(3);
    EXPECT_EQ(opened, 3);
    EXPECT_EQ(desk.problem(), "olad does not answer");
    universe.isThere = true;
    pass(1);
    EXPECT_EQ(desk.problem(), "");
    send({10, 0, 0});
    universe.isThere = false;
    pass(0.1);
    EXPECT_EQ(desk.problem(), "olad does not answer");
    universe.isThere = true;
    pass(1);
    send({11, 0, 0});
    EXPECT_THAT(takeOrders(), ElementsAre("DMX universe 4: brightness 0.04"))
        << "what has changed meanwhile counts";
}

}  // namespace
}  // namespace aquarama::console
