// SPDX-License-Identifier: Apache-2.0
// Turf is bitten off and grows again; a shoal goes from patch to patch; a loop is kept.
#include <algorithm>
#include <numeric>
#include <set>
#include <span>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "master/behaviour/loops.h"
#include "master/behaviour/patches.h"
#include "master/behaviour/routines.h"
#include "tests/master/world/grazing_world.h"

namespace aquarama::world {
namespace {

constexpr int kMinute = 60 * 60;

bool isBiting(const World& world, std::uint32_t fish) {
    const fish::Mind& mind = world.minds()[fish];
    return mind.intention == fish::Intention::Graze &&
           mind.stage == static_cast<std::uint8_t>(behaviour::GrazeStage::Bite);
}

glm::vec3 middleOf(const World& world) {
    glm::vec3 sum{};
    for (std::size_t fish = 0; fish < world.view().size(); ++fish)
        sum += world.view().position(fish);
    return sum / static_cast<float>(world.view().size());
}

float farthestFromMiddle(const World& world) {
    const glm::vec3 middle = middleOf(world);
    float farthest = 0;
    for (std::size_t fish = 0; fish < world.view().size(); ++fish)
        farthest = std::max(farthest, place::lengthOf(world.view().position(fish) - middle));
    return farthest;
}

TEST(Turf, APatchIsEmptyAfter150BitesAndFullAgainAfter200Seconds) {
    surroundings::Turf turf;
    turf.patches.resize(1);
    turf.fill = {surroundings::Turf::kFull};
    int bites = 0;
    while (surroundings::biteTurf(turf, 0)) ++bites;
    EXPECT_EQ(bites, 150);
    for (int tick = 0; tick < 200 * 60 - 1; ++tick) surroundings::growTurf(turf);
    EXPECT_LT(turf.shareOf(0), 1);
    surroundings::growTurf(turf);
    EXPECT_EQ(turf.shareOf(0), 1);
    surroundings::growTurf(turf);
    EXPECT_EQ(turf.shareOf(0), 1);
}

TEST(Turf, EveryPatchIsWithinReachAndItsSpotsAreOnItsBoulder) {
    const World world(optionsOfRoutine("loop", 3));
    const surroundings::Turf& turf = world.surroundings().turf;
    ASSERT_GT(turf.patches.size(), 5U);
    EXPECT_EQ(
        turf.patches.size(),
        std::ranges::count(world.surroundings().sites, config::SiteKind::Turf, &place::Site::kind))
        << "no site is out of reach";
    const place::Region& water = world.surroundings().obstacles.water;
    for (const surroundings::TurfPatch& patch : turf.patches) {
        const glm::vec3 from = patch.place - water.centre;
        EXPECT_LT(std::abs(from.x), water.halfExtent.x - 1);
        EXPECT_LT(std::abs(from.z), water.halfExtent.z - 1);
        for (const glm::vec3 spot : patch.spots) {
            EXPECT_NEAR(place::lengthOf(spot - patch.boulder), patch.surfaceMetres, 1e-4);
            EXPECT_LT(place::lengthOf(spot - patch.place), 1);
        }
    }
}

// Whether all that graze are at one patch, or on their way to it.
bool haveOnePatch(const World& world) {
    std::set<std::uint32_t> patches;
    for (std::uint32_t fish = 0; fish < world.view().size(); ++fish)
        if (world.minds()[fish].intention == fish::Intention::Graze)
            patches.insert(world.minds()[fish].target);
    return patches.size() <= 1;
}

TEST(Graze, AShoalStaysTogetherAndBitesAtSeveralPatchesNoseDown) {
    World world(optionsOfRoutine("graze", 1));
    std::set<std::uint32_t> bitten;
    double sines = 0;
    int biting = 0;
    int samples = 0;
    int together = 0;
    float least = 1;
    for (int tick = 0; tick < 6 * kMinute; ++tick) {
        world.advance();
        for (std::uint32_t fish = 0; fish < world.view().size(); ++fish) {
            if (!isBiting(world, fish)) continue;
            ++biting;
            sines += static_cast<double>(world.view().heading(fish).y);
            bitten.insert(world.minds()[fish].target);
            least = std::min(least, world.surroundings().turf.shareOf(world.minds()[fish].target));
        }
        if (tick < kMinute || tick % 60 != 0) continue;
        ++samples;
        together += farthestFromMiddle(world) < 3.0F && haveOnePatch(world) ? 1 : 0;
    }
    EXPECT_GE(bitten.size(), 3U);
    EXPECT_GT(world.counts().bites, 250U);
    EXPECT_LT(least, 0.75F) << "no patch got emptier";
    EXPECT_LT(sines / biting, -0.35) << "they do not bite nose down";
    EXPECT_GT(together, 0.8 * samples) << "the shoal falls apart";
}

TEST(Graze, BitesFeed) {
    WorldOptions options = optionsOfRoutine("graze", 1);
    options.cast[0].habits.graze->bitesPerParticle = 5;
    World world(options);
    const auto hunger = [&] {
        float sum = 0;
        for (std::uint32_t fish = 0; fish < 8; ++fish)
            sum += fish::innerHunger(world.speciesParameters()[0], world.minds()[fish]);
        return sum / 8;
    };
    for (int tick = 0; tick < 6 * kMinute; ++tick) world.advance();
    EXPECT_EQ(world.counts().meals, 0U) << "there is plankton";
    EXPECT_LT(hunger(), 0.5F);
}

TEST(Graze, ALoopIsRepeatedInItsOrder) {
    World world(optionsOfRoutine("loop", 1));
    const behaviour::Loop loop = behaviour::loopOf(world.surroundings().turf, 1, 0);
    ASSERT_GE(loop.count, 5U);
    std::uint32_t present = fish::kNobody;
    int steps = 0;
    int next = 0;
    for (int tick = 0; tick < 12 * kMinute; ++tick) {
        world.advance();
        const fish::Mind& mind = world.minds()[0];
        if (mind.intention != fish::Intention::Graze || mind.target == present) continue;
        const auto now = std::ranges::find(loop.all(), mind.target) - loop.all().begin();
        ASSERT_LT(now, static_cast<std::ptrdiff_t>(loop.count)) << "a patch off its loop";
        if (present != fish::kNobody) {
            const auto before = std::ranges::find(loop.all(), present) - loop.all().begin();
            const auto count = static_cast<std::ptrdiff_t>(loop.count);
            const auto step = (now - before + count) % count;
            EXPECT_LE(step, 2);
            ++steps;
            next += step == 1 ? 1 : 0;
        }
        present = mind.target;
    }
    EXPECT_GT(steps, static_cast<int>(loop.count)) << "it went less than one round";
    EXPECT_GT(next, 0.7 * steps);
    EXPECT_GT(world.counts().bites, 3U * static_cast<std::uint64_t>(steps) / 2);
    // A puff each 60 to 150 s.
    EXPECT_GE(world.counts().puffs, 4U);
    EXPECT_LE(world.counts().puffs, 13U);
}

}  // namespace
}  // namespace aquarama::world
