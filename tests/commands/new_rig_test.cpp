// SPDX-License-Identifier: Apache-2.0
#include "commands/new_rig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "common/base/log.h"
#include "common/config/rig.h"
#include "common/wall/wall.h"

namespace aquarama {
namespace {

using testing::HasSubstr;

NewRigWishes wishes(WallKind kind, int count) {
    NewRigWishes wanted;
    wanted.kind = kind;
    wanted.count = count;
    wanted.windows = true;
    wanted.scene = "reef.txtpb";
    return wanted;
}

// The monitor of a television of 55 inches that says so.
machine::Connector television(const std::string& connector) {
    return {connector, {"TV", {1920, 1080}, 60, {1.21, 0.68}}};
}

// As `aquarama check` does. Why it is no rig; empty where it is good.
std::string faultOf(const RigPlan& plan) try {
    const std::string text = textOf(plan);
    wall::checkGeometry(config::parseRig(text, "new.txtpb"), "new.txtpb");
    return {};
} catch (const Error& problem) {
    return std::string(problem.what()) + "\n" + textOf(plan);
}

config::Rig rigOf(const RigPlan& plan) {
    return config::parseRig(textOf(plan), "new.txtpb");
}

// A hall's measures at random, within what people build.
class Measures {
  public:
    double between(double least, double most) {
        return std::uniform_real_distribution(least, most)(random_);
    }
    int whole(int least, int most) { return std::uniform_int_distribution(least, most)(random_); }
    glm::ivec2 size() {
        constexpr std::array<glm::ivec2, 5> kSizes{
            {{1920, 1080}, {1400, 1050}, {1920, 1200}, {3840, 2160}, {1280, 800}}};
        return kSizes.at(static_cast<std::size_t>(whole(0, 4)));
    }

  private:
    std::mt19937 random_{18};
};

TEST(NewRig, everyRowOrArcOfTelevisionsBeforeAnEyeIsGood) {
    Measures measures;
    for (int i = 0; i < 60; ++i) {
        NewRigWishes wanted = wishes(WallKind::Televisions, measures.whole(1, 6));
        wanted.diagonalInches = measures.between(24, 98);
        wanted.bezel = measures.between(0, 0.03);
        // All of them together reach round by less than half a turn.
        wanted.angle = measures.between(0, 150.0 / *wanted.count);
        wanted.distance = measures.between(1, 4);
        wanted.sizePixels = measures.size();
        EXPECT_EQ(faultOf(planOf(wanted, {}, "new")), "");
    }
}

TEST(NewRig, everyCurvedScreenIsGood) {
    Measures measures;
    for (int i = 0; i < 30; ++i) {
        NewRigWishes wanted = wishes(WallKind::Cylinder, measures.whole(1, 6));
        wanted.radius = measures.between(1.5, 8);
        wanted.arc = measures.between(20, std::min(270.0, 75.0 * *wanted.count));
        wanted.height = *wanted.radius * measures.between(0.3, 1);
        wanted.throwRatio = measures.between(0.5, 2.5);
        wanted.sizePixels = measures.size();
        EXPECT_EQ(faultOf(planOf(wanted, {}, "new")), "");
    }
}

TEST(NewRig, everyFlatWallIsGood) {
    Measures measures;
    for (int i = 0; i < 30; ++i) {
        NewRigWishes wanted = wishes(WallKind::Flat, measures.whole(1, 6));
        wanted.width = measures.between(1, 15);
        wanted.height = measures.between(1, 3);
        wanted.distance = *wanted.width * measures.between(0.4, 2);
        wanted.throwRatio = measures.between(0.3, 2.5);
        wanted.mount = measures.between(-2, 3);
        wanted.sizePixels = measures.size();
        EXPECT_EQ(faultOf(planOf(wanted, {}, "new")), "");
    }
}

TEST(NewRig, neighbouringTelevisionsTouchAndTheMiddleIsStraightAhead) {
    for (const int count : {2, 3, 4, 5}) {
        NewRigWishes wanted = wishes(WallKind::Televisions, count);
        wanted.angle = 35;
        wanted.bezel = 0.02;
        wanted.distance = 2;
        const config::Rig rig = rigOf(planOf(wanted, {}, "new"));
        glm::dvec3 middle(0);
        for (std::size_t i = 0; i + 1 < rig.channels.size(); ++i) {
            const auto edge = [&](std::size_t index, double side) {
                const config::Panel& panel = *rig.channels[index].panel;
                const double yaw = panel.yawPitchRollRadians.x;
                return panel.positionMetres + side * (panel.sizeMetres.x / 2 + panel.bezelMetres) *
                                                  glm::dvec3(std::cos(yaw), 0, -std::sin(yaw));
            };
            EXPECT_LT(glm::distance(edge(i, 1), edge(i + 1, -1)), 0.001);
            if (2 * (i + 1) == rig.channels.size()) middle = edge(i, 1);
        }
        if (count % 2 == 1)
            middle = rig.channels[static_cast<std::size_t>(count / 2)].panel->positionMetres;
        EXPECT_LT(glm::distance(middle, glm::dvec3(0, 0, -2)), 0.001);
    }
}

TEST(NewRig, takesWhatMonitorsSayOfThemselvesButNotALaptopsPanel) {
    NewRigWishes wanted = wishes(WallKind::Televisions, 3);
    wanted.windows = false;
    wanted.count.reset();
    machine::Connector liar = television("HDMI-3");
    liar.monitor.sizeMetres = {1.60, 0.16};  // believed by nobody
    const RigPlan plan = planOf(wanted,
                                {television("DP-1"),
                                 television("HDMI-1"),
                                 liar,
                                 {"eDP-1", {"", {2560, 1600}, 60, {0.3, 0.19}}}},
                                "school");
    ASSERT_EQ(plan.channels.size(), 3U);
    EXPECT_EQ(plan.channels[0].name, "left");
    EXPECT_EQ(plan.channels[1].connector, "HDMI-1");
    EXPECT_EQ(plan.channels[0].sizeMetres, glm::dvec2(1.21, 0.68));
    EXPECT_NEAR(plan.channels[2].sizeMetres.x, 1.2176, 0.001) << "of 55 inches";
    EXPECT_EQ(usualDiagonal({liar, television("DP-1")}), 55);
    EXPECT_EQ(usualDiagonal({{"DP-1", {"", {1920, 1080}, 60, {0.71, 0.40}}}}), 32);
    EXPECT_EQ(usualDiagonal({liar}), kDiagonalInches);
    const config::Rig rig = rigOf(plan);
    EXPECT_EQ(rig.name, "school");
    EXPECT_EQ(rig.channels[2].display.connector, "HDMI-3");
    EXPECT_EQ(rig.channels[2].display.mode, config::DisplayMode::Fullscreen);
    EXPECT_EQ(faultOf(plan), "");
    const std::vector<machine::Connector> laptop{{"eDP-1", {"", {2560, 1600}, 60, {}}}};
    EXPECT_EQ(wallMonitors(laptop).size(), 1U) << "where there is nothing else";
}

TEST(NewRig, tooFewMonitorsAreNamed) {
    NewRigWishes wanted = wishes(WallKind::Flat, 3);
    wanted.windows = false;
    try {
        (void)planOf(wanted, {television("DP-1")}, "new");
        FAIL() << "three channels came of one monitor";
    } catch (const Error& problem) {
        EXPECT_THAT(problem.what(), HasSubstr("3 monitors are needed, this machine has DP-1"));
    }
}

}  // namespace
}  // namespace aquarama
