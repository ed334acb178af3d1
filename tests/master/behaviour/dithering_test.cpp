// SPDX-License-Identifier: Apache-2.0
// A fish amid stimuli that waver about every threshold does not dither.
#include <cstdio>

#include <gtest/gtest.h>

#include "common/base/hash.h"
#include "common/place/place.h"
#include "tests/master/behaviour/fish_in_mind.h"

namespace aquarama::behaviour {
namespace {

constexpr int kMinutes = 20;
constexpr int kThoughtsAMinute = 450;

// About a mean, as wide as `swing`, slow waves with a tremor of every thought on them.
float wavering(std::uint32_t stream, int thought, float mean, float swing) {
    const float seconds = static_cast<float>(thought) / 7.5F;
    const float wave = place::valueNoise(stream, {seconds * 0.1F, 0.5F});
    const float tremor = signedUnitOf(hashOf(stream, static_cast<std::uint32_t>(thought))) * 0.1F;
    return std::max(0.0F, mean + swing * (wave + tremor));
}

void waver(FishInMind& fish, int thought) {
    fish.feelings.hunger = wavering(1, thought, 0.25F, 0.3F);
    fish.feelings.libido = wavering(2, thought, 0.25F, 0.3F);
    fish.senses.urgency = wavering(3, thought, 0.4F, 1.0F);
    fish.senses.climate.discomfort = wavering(4, thought, 0.1F, 0.2F) - 0.1F;
    fish.senses.climate.betterUp = 1;
    const float fear = wavering(5, thought, 0.1F, 0.5F);
    fish.calm();
    if (fear > 0) fish.frighten(std::min(1.0F, fear), 0.9F * fear);
    // Another particle about every five seconds, the same mate.
    fish.showFood(static_cast<std::uint32_t>(thought / 37));
    fish.showMate(3);
}

struct Count {
    double intentions = 0, aims = 0;  // changes a minute
};

Count changesOf(FishInMind fish) {
    Count count;
    for (int thought = 0; thought < kMinutes * kThoughtsAMinute; ++thought) {
        waver(fish, thought);
        const fish::Intention before = fish.mind.intention;
        const fish::Intention about = fish::aimOf(fish.mind).intention;
        fish.think();
        count.intentions += fish.mind.intention != before ? 1.0 / kMinutes : 0;
        count.aims += fish::aimOf(fish.mind).intention != about ? 1.0 / kMinutes : 0;
    }
    return count;
}

// What a mind without persistence would do: the first cause in the order of priorities.
double changesWithoutPersistence(FishInMind fish) {
    double changes = 0;
    fish::Intention before = fish::Intention::Wander;
    for (int thought = 0; thought < kMinutes * kThoughtsAMinute; ++thought) {
        waver(fish, thought);
        const fish::Mind fresh{.likes = fish.mind.likes};
        const fish::Intention now =
            decide(fish.parameters, fresh, fish.senses, fish.feelings).intention;
        changes += now != before ? 1.0 / kMinutes : 0;
        before = now;
    }
    return changes;
}

TEST(Dithering, noFishChangesItsMindMoreThanEveryFewSeconds) {
    for (const config::Role role : {config::Role::Prey, config::Role::Pacifist}) {
        const FishInMind fish(role);
        const Count count = changesOf(fish);
        const double bare = changesWithoutPersistence(fish);
        std::printf("%d: %.1f intentions and %.1f aims a minute; without persistence %.1f\n",
                    static_cast<int>(role),
                    count.intentions,
                    count.aims,
                    bare);
        EXPECT_GT(count.intentions, 4) << "it still heeds what happens";
        EXPECT_LT(count.intentions, 25);
        EXPECT_LT(count.aims, 15);
        EXPECT_LT(count.intentions, 0.5 * bare);
    }
}

}  // namespace
}  // namespace aquarama::behaviour
