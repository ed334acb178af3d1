// SPDX-License-Identifier: Apache-2.0
// The light of sun and sky over a day.
#include "render_node/scene/day_light.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/place/day.h"

namespace aquarama::scene {
namespace {

constexpr config::Day kDay{.lengthSeconds = 1200, .startsAt = 0.5, .night = 0.5};

DayLight at(double timeOfDay) {
    return dayLightAt(static_cast<float>(timeOfDay), place::daylightAt(kDay, timeOfDay));
}

float differenceOf(const DayLight& a, const DayLight& b) {
    float most = std::abs(a.lamp - b.lamp);
    for (int i = 0; i < 3; ++i)
        most = std::max({most, std::abs(a.sun[i] - b.sun[i]), std::abs(a.sky[i] - b.sky[i])});
    return most;
}

TEST(DayLight, isExactlyOneAtNoon) {
    for (const double time : {0.4375, 0.45, 0.5, 0.5624}) {
        EXPECT_EQ(at(time).sun, glm::vec3(1.0F)) << time;
        EXPECT_EQ(at(time).sky, glm::vec3(1.0F)) << time;
        EXPECT_EQ(at(time).lamp, 1.0F) << time;
    }
}

// In a frame of a day of 1200 s, in which 30 frames are shown a second, nobody sees a step of a
// five-hundredth of the light.
TEST(DayLight, changesWithoutAJumpAlsoAtMidnight) {
    constexpr int kFrames = 36'000;
    DayLight before = at(0);
    for (int frame = 1; frame <= kFrames; ++frame) {
        const DayLight now = at(static_cast<double>(frame) / kFrames);
        ASSERT_LT(differenceOf(before, now), 0.002F) << frame;
        before = now;
    }
    EXPECT_EQ(differenceOf(dayLightAt(0.0F, 0.5F), dayLightAt(1.0F, 0.5F)), 0.0F);
}

TEST(DayLight, theMiddlesOfThePhasesAreToldApart) {
    for (std::size_t a = 0; a < place::kDayPhases; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const auto middle = [](std::size_t phase) {
                const double begin = place::beginOf(static_cast<place::DayPhase>(phase));
                double end =
                    place::beginOf(static_cast<place::DayPhase>((phase + 1) % place::kDayPhases));
                if (end < begin) end += 1;
                const double time = 0.5 * (begin + end);
                return time >= 1 ? time - 1 : time;
            };
            EXPECT_GT(differenceOf(at(middle(a)), at(middle(b))), 0.1F) << a << ' ' << b;
        }
}

TEST(DayLight, isNeverDark) {
    for (double time = 0; time < 1; time += 0.001) {
        EXPECT_GT(at(time).sky.b, 0.35F) << time;
        EXPECT_GT(dayLightAt(static_cast<float>(time), 0.0F).sky.b, 0.15F) << time;
    }
}

}  // namespace
}  // namespace aquarama::scene
