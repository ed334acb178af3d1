// SPDX-License-Identifier: Apache-2.0
// A cue releases a shark that patrols: it comes before the wall, hunts there, and patrols again.
#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "tests/master/world/captured_fish.h"

namespace aquarama::world {
namespace {

constexpr int kSeeds = 10;
constexpr int kTicksASecond = 60;
// Seen on the wall: nearer than half of what is seen through this water, and within 45 degrees of
// ahead.
constexpr float kNearMetres = 6;
constexpr float kAheadCosine = 0.7071F;

std::uint32_t placeOf(const std::string& species, const WorldOptions& options) {
    const auto found = std::ranges::find(options.cast, species, &WorldSpecies::name);
    return static_cast<std::uint32_t>(found - options.cast.begin());
}

// A world in which a shark may be released, and what is seen of it.
class Hall {
  public:
    explicit Hall(const WorldOptions& options)
        : world{options}, shark{placeOf("blacktip_reef_shark", options)} {}

    // Returns the fish that comes.
    std::uint32_t release() {
        world.apply(ReleaseHunter{shark});
        return world.environment().released->fish.back().fish;
    }
    void pass(int seconds) {
        for (int tick = 0; tick < seconds * kTicksASecond; ++tick) world.advance();
    }
    [[nodiscard]] const fish::SpeciesParameters& sharks() const {
        return world.speciesParameters()[shark];
    }
    [[nodiscard]] bool isBeforeTheWall(std::uint32_t fish) const {
        const surroundings::Vessel& vessel = world.pilot().vessel;
        const glm::vec3 right = surroundings::rightOf(vessel.attitude);
        const glm::vec3 from = world.view().position(fish) - vessel.position;
        const float distance = place::lengthOf(from);
        return distance < kNearMetres &&
               place::dot(from, {right.z, 0, -right.x}) > kAheadCosine * distance;
    }
    [[nodiscard]] bool hunts(std::uint32_t fish) const {
        return world.minds()[fish].intention == fish::Intention::Eat;
    }
    [[nodiscard]] int fleeing() const {
        int count = 0;
        for (std::size_t fish = 0; fish < world.traits().size(); ++fish) {
            const fish::Intention intention = world.minds()[fish].intention;
            count += intention == fish::Intention::Escape || intention == fish::Intention::Hide;
        }
        return count;
    }

    World world;
    std::uint32_t shark;  // its species' place in the cast
};

// What was seen in the half minute after the cue; seconds are -1 where it was never.
struct Seen {
    double cameAfter = -1;
    double huntedAfter = -1;
    // Fish that flee or hide, in the mean: in ten seconds before the cue, and from when the shark
    // is seen.
    double fledBefore = 0;
    double fled = 0;
};

Seen seenIn(const WorldOptions& options) {
    constexpr int kBefore = 10 * 60;
    constexpr int kAfter = 30 * 60;
    Hall hall(options);
    Seen seen;
    hall.pass(3);
    for (int tick = 0; tick < kBefore; ++tick) {
        hall.world.advance();
        seen.fledBefore += static_cast<double>(hall.fleeing()) / kBefore;
    }
    const std::uint32_t comes = hall.release();
    int ticksSeen = 0;
    for (int tick = 1; tick <= kAfter; ++tick) {
        hall.world.advance();
        const double seconds = static_cast<double>(tick) / kTicksASecond;
        if (seen.cameAfter < 0 && hall.isBeforeTheWall(comes)) seen.cameAfter = seconds;
        if (seen.huntedAfter < 0 && hall.hunts(comes)) seen.huntedAfter = seconds;
        if (seen.cameAfter < 0) continue;
        seen.fled += hall.fleeing();
        ++ticksSeen;
    }
    seen.fled /= std::max(ticksSeen, 1);
    return seen;
}

class ReleasedShark : public ::testing::TestWithParam<std::string> {};

TEST_P(ReleasedShark, isSeenOnTheWallWithin20SecondsAndPreyFlees) {
    int hunted = 0;
    double fled = 0;
    double fledBefore = 0;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
        const Seen seen = seenIn(optionsOfScene(GetParam(), seed));
        std::cout << GetParam() << ", seed " << seed << ": seen after " << seen.cameAfter
                  << " s, hunts after " << seen.huntedAfter << " s, " << seen.fled
                  << " fish flee or hide, " << seen.fledBefore << " before the cue\n";
        EXPECT_GE(seen.cameAfter, 0) << "seed " << seed;
        EXPECT_LE(seen.cameAfter, 20) << "seed " << seed;
        fled += seen.fled;
        fledBefore += seen.fledBefore;
        hunted += seen.huntedAfter >= 0 ? 1 : 0;
    }
    EXPECT_GE(hunted, kSeeds / 2) << "the others swim past";
    EXPECT_GT(fled, fledBefore);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ReleasedShark, ::testing::Values("reef", "bait_ball"));

TEST(Release, theSameCueMakesTheSameWorldAndIsPartOfItsHash) {
    Hall one(optionsOfScene("reef"));
    Hall other(optionsOfScene("reef"));
    Hall without(optionsOfScene("reef"));
    for (Hall* hall : {&one, &other, &without}) hall->pass(2);
    ASSERT_EQ(one.world.hash(), without.world.hash());
    EXPECT_EQ(one.release(), other.release());
    EXPECT_NE(one.world.hash(), without.world.hash());
    for (Hall* hall : {&one, &other}) hall->pass(30);
    EXPECT_EQ(one.world.hash(), other.world.hash());
}

TEST(Release, aSecondCueBringsAnother) {
    Hall hall(optionsOfScene("bait_ball"));
    hall.pass(1);
    const std::uint32_t sharks = hall.sharks().last - hall.sharks().first;
    for (std::uint32_t cue = 1; cue <= sharks + 1; ++cue) {
        static_cast<void>(hall.release());
        EXPECT_EQ(hall.world.environment().released->fish.size(), std::min(cue, sharks));
    }
}

TEST(Release, isOfNoEffectOnOtherSpecies) {
    const WorldOptions options = optionsOfScene("reef");
    World world(options);
    const std::uint64_t before = world.hash();
    for (const char* species : {"bigeye_scad", "coral_grouper", "trumpetfish"})
        world.apply(ReleaseHunter{placeOf(species, options)});
    world.apply(ReleaseHunter{4000});
    EXPECT_EQ(world.hash(), before);
}

}  // namespace
}  // namespace aquarama::world
