// SPDX-License-Identifier: Apache-2.0
// Each routine of movement in its scene, with what it must achieve there.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "common/place/obstacles.h"
#include "master/behaviour/home.h"
#include "master/behaviour/routines.h"
#include "tests/master/world/captured_fish.h"
#include "tests/master/world/school_shape.h"

namespace aquarama::world {
namespace {

constexpr int kSecond = 60;  // ticks

// A figure for docs/routines.md.
void print(const char* what, double figure) {
    std::cout << what << ": " << figure << "\n";
}

void advance(World& world, int ticks) {
    for (int i = 0; i < ticks; ++i) world.advance();
}

float distanceBetween(const World& world, std::uint32_t a, std::uint32_t b) {
    return place::lengthOf(world.view().position(a) - world.view().position(b));
}

// On the reef of seed 2 nothing lies in their way, nor would it within four minutes.
TEST(AvoidObstacle, noFishEntersRockOrSand) {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        World world(optionsOfScene("routines/avoid_obstacle", seed));
        bool avoided = false;
        for (int i = 0; i < 60 * kSecond; ++i) {
            world.advance();
            for (std::uint32_t fish = 0; fish < world.view().size(); ++fish) {
                const glm::vec3 at = world.view().position(fish);
                for (const place::Rock& rock : world.surroundings().obstacles.rocks)
                    ASSERT_GT(place::lengthOf(at - rock.centre), rock.radiusMetres)
                        << fish << " " << i;
                ASSERT_GT(at.y, place::floorHeight({seed}, {at.x, at.z}) + 0.1F);
                avoided |= world.minds()[fish].intention == fish::Intention::AvoidObstacle;
            }
        }
        EXPECT_EQ(avoided, seed != 2) << "what was in their way: seed " << seed;
    }
}

// Two that swim at each other, each a hand's breadth off the other's line at most.
TEST(AvoidFish, twoThatMeetHeadOnPassWithoutTouching) {
    for (const float aside : {-0.05F, 0.0F, 0.03F, 0.1F}) {
        WorldOptions options = optionsOfScene("routines/avoid_fish");
        options.cast.resize(2);
        for (WorldSpecies& one : options.cast) {
            one.fish = 1;
            one.habits.paces = {0, 1, 0, 0};
            one.start->radiusMetres = 0;
            one.start->centre.x *= 0.4F;  // near enough to have no time for other ideas
        }
        options.cast[0].start->centre.z += aside;
        World world(options);
        float nearest = 99;
        for (int i = 0; i < 12 * kSecond; ++i) {
            world.advance();
            nearest = std::min(nearest, distanceBetween(world, 0, 1));
        }
        // Each is a sixth of its length wide at most.
        const float widths = (world.view().fish[0].length + world.view().fish[1].length) / 6;
        EXPECT_GT(nearest, 0.5F * widths + 0.05F) << aside;
        EXPECT_LT(nearest, 2.0F) << "they do meet";
    }
}

// A shark that is not hungry swims at the scad.
WorldOptions scadBeforeAShark(std::uint32_t scad) {
    WorldOptions options = optionsOfScene("routines/escape");
    options.cast[0].fish = scad;
    options.cast[0].start->centre = {-1.2F, -9, -5};
    options.cast[1].start->hunger = 0;
    options.cast[1].habits.hunger.digestionPerSecond = 1e-6F;
    options.cast[1].habits.paces = {0, 1, 0, 0};
    return options;
}

// A shark that is not hungry frightens only near by, which takes it up to 14 s: a distance some
// seconds after the start would tell nothing of the flight.
TEST(Escape, theDistanceToThePredatorGrows) {
    World world(scadBeforeAShark(1));
    world.advance();
    const auto flees = [&] { return world.minds()[0].intention == fish::Intention::Escape; };
    int waited = 0;
    for (; waited < 20 * kSecond && !flees(); ++waited) world.advance();
    EXPECT_TRUE(flees()) << "it has come near by then";
    const float before = distanceBetween(world, 0, 1);
    advance(world, 5 * kSecond);
    print("gained within 5 s of flight, m", double{distanceBetween(world, 0, 1) - before});
    EXPECT_GT(distanceBetween(world, 0, 1), before + 0.5F) << "metres";
}

// Scattered over six metres, 40 scad are one school again in 20 seconds and swim one way in 40.
TEST(SchoolRoutine, reformsAfterItWasScattered) {
    for (const std::uint32_t seed : {1U, 2U}) {
        World world(optionsOfScene("routines/school", seed));
        advance(world, kSecond);
        EXPECT_LT(shapeOf(world.view()).largestGroup, 0.6) << "it was one from the start";
        int seconds = 1;
        for (; seconds < 20 && shapeOf(world.view()).largestGroup <= 0.9; ++seconds)
            advance(world, kSecond);
        print("one school again after, s", seconds);
        EXPECT_LT(seconds, 20) << seed;
        advance(world, (20 - seconds) * kSecond);
        double polarised = 0;
        double spacing = 0;
        advance(world, 20 * kSecond);
        for (int second = 0; second < 20; ++second) {
            advance(world, kSecond);
            const SchoolShape shape = shapeOf(world.view());
            polarised += shape.polarisation / 20;
            spacing += shape.nearestNeighbour / 20;
        }
        print("polarisation", polarised);
        print("nearest neighbour, body lengths", spacing);
        EXPECT_GT(polarised, 0.65) << "Tunstrom et al. 2013";
        EXPECT_GT(spacing, 0.5) << "Partridge 1980, Pitcher & Parrish 1993";
        EXPECT_LT(spacing, 1.5);
    }
}

TEST(SchoolRoutine, splitsRoundTheSubmarineAndIsOneSchoolAgain) {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        World world(optionsOfScene("routines/submarine", seed));
        const surroundings::Submarine& submarine = world.surroundings().submarine;
        const std::size_t fish = world.view().size();
        std::vector<char> side(fish);  // by which it passed
        std::size_t passed = 0;
        int apart = 0;  // ticks after 9 of 10 have passed until they are one
        for (int i = 0; i < 60 * kSecond; ++i) {
            world.advance();
            for (std::size_t one = 0; one < fish; ++one) {
                const glm::vec3 from = world.view().position(one) - submarine.position;
                ASSERT_GT(place::lengthOf(from), submarine.radiusMetres) << seed << " tick " << i;
                if (side[one] != 0 || from.z < 0) continue;
                side[one] = from.x < 0 ? 'l' : 'r';
                ++passed;
            }
            if (passed * 10 < fish * 9) continue;
            if (shapeOf(world.view()).largestGroup > 0.95) break;
            ++apart;
        }
        print("to the left", static_cast<double>(std::ranges::count(side, 'l')));
        print("to the right", static_cast<double>(std::ranges::count(side, 'r')));
        print("seconds apart", apart / 60.0);
        EXPECT_GT(std::ranges::count(side, 'l'), static_cast<long>(fish) / 10) << seed;
        EXPECT_GT(std::ranges::count(side, 'r'), static_cast<long>(fish) / 10) << seed;
        EXPECT_LT(apart, 8 * kSecond) << "seed " << seed;
    }
}

// The mean of four schools.
TEST(SchoolRoutine, anAlarmedSchoolClosesUp) {
    WorldOptions options = scadBeforeAShark(40);
    options.cast[0].start->radiusMetres = 0.9;
    WorldOptions calm = options;
    calm.cast.pop_back();
    options.cast[1].start->centre = {3, -9, -8.5F};  // seen, and not near
    options.cast[1].habits.paces = {1, 0, 0, 0};
    options.cast[0].habits.fear.metres *= 2;  // it hunts nobody, which is half as frightening
    double close = 0;
    double wide = 0;
    for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) {
        options.seed = calm.seed = seed;
        World alarmed(options);
        World atEase(calm);
        advance(alarmed, 2 * kSecond);
        advance(atEase, 2 * kSecond);
        for (int second = 0; second < 10; ++second) {
            advance(alarmed, kSecond);
            advance(atEase, kSecond);
            close += shapeOf(alarmed.view(), 0, 40).nearestNeighbour / 40;
            wide += shapeOf(atEase.view(), 0, 40).nearestNeighbour / 40;
        }
    }
    print("nearest neighbour alarmed, body lengths", close);
    print("nearest neighbour at ease, body lengths", wide);
    EXPECT_LT(close, 0.9 * wide) << "body lengths";
}

TEST(Leave, fishInTheDarkAndColdRiseToWaterThatSuits) {
    World world(optionsOfScene("routines/leave"));
    advance(world, kSecond);
    const auto suits = [&](std::uint32_t fish) {
        const config::Habits& habits = world.speciesParameters()[0].habits;
        const surroundings::Surroundings& around = world.surroundings();
        const float y = world.view().fish[fish].position.y;
        const float light = surroundings::lightAt(around.climate, around.daylight, y);
        const float celsius = surroundings::celsiusAt(around.climate, y);
        constexpr float kNearly = 0.05F;  // at the edge of what suits a fish stops
        return light >= static_cast<float>(habits.comfort.light.least) - kNearly &&
               celsius >= static_cast<float>(habits.comfort.waterCelsius.least) - kNearly;
    };
    const std::uint32_t fish = 3;
    for (std::uint32_t i = 0; i < fish; ++i) EXPECT_FALSE(suits(i)) << "there was no need";
    // They rise by a few centimetres a second, slowly on slopes: 120 s are too few for 8 m.
    advance(world, 240 * kSecond);
    for (std::uint32_t i = 0; i < fish; ++i)
        EXPECT_TRUE(suits(i)) << world.view().fish[i].position.y;
}

WorldOptions one(const std::string& species) {
    WorldOptions options = optionsOfScene("reef_1998");
    std::erase_if(options.cast, [&](const WorldSpecies& each) { return each.name != species; });
    options.scene.plankton = 0;
    return options;
}

TEST(Wander, eachPaceHasItsShareOfTheTime) {
    const WorldOptions options = one("parrotfish");
    const World world(options);
    const fish::SpeciesParameters& parameters = world.speciesParameters()[0];
    const config::Paces& paces = options.cast[0].habits.paces;
    int slow = 0;
    int hovers = 0;
    constexpr int kSpells = 4000;
    for (int i = 0; i < kSpells; ++i) {
        const float pace =
            behaviour::paceOf(parameters, 1, 0, {static_cast<std::uint64_t>(i) * 5 * kSecond});
        slow += pace == parameters.slow ? 1 : 0;
        hovers += pace < 0.25F * parameters.slow ? 1 : 0;
    }
    EXPECT_NEAR(slow / double{kSpells}, paces.slow, 0.03);
    EXPECT_NEAR(hovers / double{kSpells}, paces.hover, 0.03);
}

TEST(Wander, oneWithoutAHomeVisitsAllItsWater) {
    World world(one("parrotfish"));
    glm::vec3 least{99};
    glm::vec3 most{-99};
    for (int i = 0; i < 300 * kSecond; ++i) {
        world.advance();
        least = glm::min(least, world.view().position(0));
        most = glm::max(most, world.view().position(0));
    }
    EXPECT_GT(most.x - least.x, 5.0F);
    EXPECT_GT(most.z - least.z, 3.0F);
}

TEST(Wander, oneWithAHomeStaysWithinItsLeash) {
    WorldOptions options = one("clownfish");
    const config::Home& home = options.cast[0].habits.home;
    ASSERT_EQ(home.kind, config::HomeKind::Place);
    World world(options);
    const glm::vec3 place = behaviour::homeOf(world.speciesParameters()[0], 0);
    float farthest = 0;
    for (int i = 0; i < 180 * kSecond; ++i) {
        world.advance();
        farthest = std::max(farthest, place::lengthOf(world.view().position(0) - place));
    }
    EXPECT_LT(farthest, static_cast<float>(home.leashMetres) + 0.3F) << "room of a turn";
}

TEST(Wander, thoseThatLiveInPairsKeepNearEachOther) {
    World world(one("moorish_idol"));
    ASSERT_EQ(world.view().size(), 2U);
    advance(world, 30 * kSecond);
    double apart = 0;
    for (int second = 0; second < 120; ++second) {
        advance(world, kSecond);
        apart += double{distanceBetween(world, 0, 1) / world.view().fish[0].length} / 120;
    }
    EXPECT_LT(apart, 6) << "body lengths; they like to be 2.5 apart";
    EXPECT_GT(apart, 1);
}

// The reef of the paper, ten minutes of it, as its species live.
TEST(Reef, nobodyLeavesTheWaterOrEntersTerrainOrSubmarine) {
    WorldOptions options = optionsOfScene("reef_1998");
    options.scene.tour.reset();
    World world(options);
    const place::Obstacles& obstacles = world.surroundings().obstacles;
    const surroundings::Submarine& submarine = world.surroundings().submarine;
    float outside = -99;  // metres
    float aboveSand = 99;
    float aboveRock = 99;  // from the rocks' balls
    float fromSubmarine = 99;
    for (int i = 0; i < 600 * kSecond; ++i) {
        world.advance();
        if (i % 4 != 0) continue;
        for (std::uint32_t fish = 0; fish < world.view().size(); ++fish) {
            if (world.view().shows(fish, fish::kAway)) continue;
            const glm::vec3 at = world.view().position(fish);
            const glm::vec3 out =
                glm::abs(at - obstacles.water.centre) - obstacles.water.halfExtent;
            outside = std::max({outside, out.x, out.y, out.z});
            aboveSand = std::min(aboveSand, at.y - place::floorHeight({1}, {at.x, at.z}));
            fromSubmarine = std::min(fromSubmarine, place::lengthOf(at - submarine.position));
            for (const place::Rock& rock : obstacles.rocks)
                aboveRock =
                    std::min(aboveRock, place::lengthOf(at - rock.centre) - rock.radiusMetres);
        }
    }
    print("outside the water, m", double{outside});
    print("above the sand, m", double{aboveSand});
    print("from a rock's ball, m", double{aboveRock});
    print("from the submarine's eye, m", double{fromSubmarine});
    EXPECT_LT(outside, 0.6F) << "half the circle that the shark turns in";
    EXPECT_GT(aboveSand, 0.1F);
    EXPECT_GT(aboveRock, 0.0F);
    EXPECT_GT(fromSubmarine, submarine.radiusMetres);
}

// It goes through their midst at half a metre a second, and they feel it come.
TEST(Reef, allMakeWayForASubmarineOnItsTour) {
    World world(optionsOfScene("reef_1998"));
    const surroundings::Submarine& submarine = world.surroundings().submarine;
    float nearest = 99;
    float farthest = 0;
    for (int i = 0; i < 400 * kSecond; ++i) {
        world.advance();
        farthest = std::max(farthest, place::lengthOf(submarine.position - place::kEyePosition));
        for (std::uint32_t fish = 0; i % 4 == 0 && fish < world.view().size(); ++fish)
            if (!world.view().shows(fish, fish::kAway))
                nearest = std::min(
                    nearest, place::lengthOf(world.view().position(fish) - submarine.position));
    }
    print("from the touring submarine's eye, m", double{nearest});
    EXPECT_GT(farthest, 4) << "it went through";
    EXPECT_GT(nearest, 0.65F) << "its hull of half a metre, and half a fish";
}

// Three hundred scad and three sharks that are not hungry.
TEST(BaitBall, millsOpensBeforeASharkAndClosesBehindIt) {
    WorldOptions options = optionsOfScene("bait_ball");
    options.scene.plankton = 0;
    options.cast[1].habits.hunger.digestionPerSecond = 1e-6F;
    options.cast[1].habits.paces = {0, 0, 1, 0};
    options.cast[1].start = config::Start{.centre = {4.5F, -11, -7}, .radiusMetres = 1.5};
    World world(options);
    const std::uint32_t scad = options.cast[0].fish;
    advance(world, 20 * kSecond);
    double rotation = 0;
    double spacing = 0;
    int longestOpen = 0;  // seconds of a rotation below the threshold
    int open = 0;
    std::vector<float> hollows;  // nearest scad to a shark within the ball
    constexpr int kSeconds = 90;
    for (int second = 0; second < kSeconds; ++second) {
        advance(world, kSecond);
        const SchoolShape shape = shapeOf(world.view(), 0, scad);
        rotation += shape.rotation / kSeconds;
        spacing += shape.nearestNeighbour / kSeconds;
        open = shape.rotation < 0.65 ? open + 1 : 0;
        longestOpen = std::max(longestOpen, open);
        for (std::uint32_t shark = scad; shark < world.view().size(); ++shark) {
            const glm::vec3 at = world.view().position(shark);
            if (place::lengthOf(at - shape.centre) > 2 * world.environment().schoolRadiusMetres)
                continue;
            float nearest = 99;
            for (std::uint32_t fish = 0; fish < scad; ++fish)
                nearest = std::min(nearest, distanceBetween(world, shark, fish));
            hollows.push_back(nearest);
        }
    }
    print("rotation order", rotation);
    print("nearest neighbour, body lengths", spacing);
    print("longest with a rotation order below 0.65, s", longestOpen);
    EXPECT_GT(rotation, 0.65) << "Tunstrom et al. 2013";
    EXPECT_GT(spacing, 0.4);
    EXPECT_LT(spacing, 0.95);
    EXPECT_LT(longestOpen, 12) << "seconds";
    ASSERT_FALSE(hollows.empty()) << "no shark passed";
    std::ranges::sort(hollows);
    print("median from a shark in the ball to the nearest scad, m",
          double{hollows[hollows.size() / 2]});
    EXPECT_GT(hollows[hollows.size() / 2], 0.6F) << "metres";
}

}  // namespace
}  // namespace aquarama::world
