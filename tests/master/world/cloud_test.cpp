// SPDX-License-Identifier: Apache-2.0
// Life over a home: a cloud stays above it, faces the current and picks; it dives from a shark that
// comes near, hides and returns.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "master/behaviour/home.h"
#include "tests/master/world/few_fish.h"

namespace aquarama::world {
namespace {

constexpr std::uint32_t kFish = 24;
constexpr std::uint32_t kShark = kFish;

// Small captured fish that live in a cloud over a branching coral.
WorldSpecies cloud(std::uint32_t fish) {
    WorldSpecies species{.tables = capturedTables("clownfish"),
                         .fish = fish,
                         .size = {.meanMetres = 0.08F,
                                  .deviationMetres = 0.01F,
                                  .leastMetres = 0.06F,
                                  .mostMetres = 0.1F}};
    species.name = "cloud";
    config::Habits& habits = species.habits;
    habits.role = config::Role::Prey;
    habits.home = {.kind = config::HomeKind::Place,
                   .radiusMetres = 0.8,
                   .leashMetres = 2,
                   .onTheReef = true,
                   .site = config::SiteKind::Branching,
                   .group = fish};
    habits.cloud = config::Cloud{.heightMetres = 1.2, .pickSeconds = 3};
    habits.hidesIn = {config::SiteKind::Branching};
    habits.visionBodyLengths = 40;
    habits.smellBodyLengths = 40;
    return species;
}

WorldOptions headWithACloud(std::uint32_t seed, bool flows = true) {
    WorldOptions options = openWater(seed, {cloud(kFish)});
    options.scene.heads = {{.xz = {0, -4}, .radiusMetres = 0.8F, .heightMetres = 1.7F}};
    options.scene.sites = {{.kind = config::SiteKind::Branching, .xz = glm::vec2{0, -4}}};
    options.scene.water = {.centre = {0, -5.75F, -4}, .halfExtent = {6, 2.4F, 5}};
    if (flows) options.scene.current = {.tideMetresPerSecond = 0.05, .tideSeconds = 600};
    return options;
}

glm::vec3 offHome(const World& world, std::uint32_t fish) {
    return world.view().position(fish) - behaviour::homeOf(world.speciesParameters()[0], fish);
}

void pass(World& world, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 60); ++i) world.advance();
}

TEST(Cloud, staysAboveItsHomeAndWithinItsRange) {
    World world(headWithACloud(1));
    pass(world, 20);
    double within = 0;
    double samples = 0;
    for (int second = 0; second < 120; ++second) {
        pass(world, 1);
        for (std::uint32_t fish = 0; fish < kFish; ++fish, ++samples) {
            const glm::vec3 off = offHome(world, fish);
            const float aside = std::sqrt(off.x * off.x + off.z * off.z);
            within += aside < 1.6F && off.y > -0.3F && off.y < 2 ? 1 : 0;
        }
    }
    EXPECT_GT(within / samples, 0.97);
}

TEST(Cloud, theLargerFishStandHigher) {
    World world(headWithACloud(2));
    pass(world, 20);
    // Correlation of the length with the mean height.
    std::vector<double> length(kFish);
    std::vector<double> height(kFish);
    for (int second = 0; second < 90; ++second) {
        pass(world, 1);
        for (std::uint32_t fish = 0; fish < kFish; ++fish) {
            length[fish] = static_cast<double>(world.view().fish[fish].length);
            height[fish] += static_cast<double>(offHome(world, fish).y) / 90;
        }
    }
    double meanLength = 0;
    double meanHeight = 0;
    for (std::uint32_t fish = 0; fish < kFish; ++fish) {
        meanLength += length[fish] / kFish;
        meanHeight += height[fish] / kFish;
    }
    double both = 0;
    double ofLength = 0;
    double ofHeight = 0;
    for (std::uint32_t fish = 0; fish < kFish; ++fish) {
        const double a = length[fish] - meanLength;
        const double b = height[fish] - meanHeight;
        both += a * b;
        ofLength += a * a;
        ofHeight += b * b;
    }
    EXPECT_GT(both / std::sqrt(ofLength * ofHeight), 0.5);
}

// Mean cosine between where the fish look and where the current comes from.
double facing(World& world, double seconds) {
    double sum = 0;
    double count = 0;
    for (int second = 0; second < static_cast<int>(seconds); ++second) {
        pass(world, 1);
        const glm::vec3 against =
            place::directionOf(-world.surroundings().openCurrent, glm::vec3{1, 0, 0});
        for (std::uint32_t fish = 0; fish < kFish; ++fish, ++count)
            sum += static_cast<double>(place::dot(world.view().heading(fish), against));
    }
    return sum / count;
}

TEST(Cloud, facesTheCurrentAndTurnsWithTheTide) {
    World world(headWithACloud(3));
    pass(world, 110);
    EXPECT_GT(facing(world, 60), 0.5) << "at the strongest of the tide, 150 s";
    pass(world, 240);
    EXPECT_LT(world.surroundings().openCurrent.x, -0.04F);
    EXPECT_GT(facing(world, 60), 0.5) << "it has turned";
    World still(headWithACloud(3, false));
    pass(still, 110);
    EXPECT_LT(std::abs(facing(still, 60)), 0.35) << "in still water they look anywhere";
}

TEST(Cloud, divesFromASharkHidesAndReturns) {
    WorldOptions options = headWithACloud(4);
    WorldSpecies hunter = sharks(1);
    hunter.habits.hunts = {"cloud"};
    // A hungry shark before the crown.
    hunter.start = config::Start{.centre = {-3.2F, -6.2F, -4}, .radiusMetres = 0.1, .hunger = 1};
    hunter.habits.hunt.restByDaySeconds = 60;
    options.cast.push_back(hunter);
    World world(options);
    std::uint32_t mostHidden = 0;
    std::uint32_t fewestAfterwards = kFish;
    bool dived = false;
    for (int i = 0; i < 120 * 60; ++i) {
        world.advance();
        std::uint32_t hidden = 0;
        for (std::uint32_t fish = 0; fish < kFish; ++fish) {
            hidden += world.minds()[fish].intention == fish::Intention::Hide ? 1 : 0;
            dived = dived || world.view().shows(fish, fish::kDiving);
        }
        mostHidden = std::max(mostHidden, hidden);
        if (mostHidden >= kFish / 2) fewestAfterwards = std::min(fewestAfterwards, hidden);
    }
    EXPECT_TRUE(dived);
    EXPECT_GE(mostHidden, kFish / 2) << "the cloud went into the coral";
    EXPECT_LE(fewestAfterwards, kFish / 8) << "and came out again";
}

TEST(Cloud, nobodyIsInTheBoulders) {
    World world(headWithACloud(5));
    for (int second = 0; second < 60; ++second) {
        pass(world, 1);
        for (std::uint32_t fish = 0; fish < kFish; ++fish)
            for (const place::Rock& rock : world.surroundings().obstacles.rocks)
                EXPECT_GT(place::lengthOf(world.view().position(fish) - rock.centre),
                          0.8F * rock.radiusMetres);
    }
}

}  // namespace
}  // namespace aquarama::world
