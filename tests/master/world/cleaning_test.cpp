// SPDX-License-Identifier: Apache-2.0
// The station of a cleaner: clients come, wait their turn, pose and leave; the cleaner goes from
// one to the next.
#include "master/behaviour/cleaning.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "master/behaviour/home.h"
#include "master/behaviour/routines.h"
#include "master/behaviour/think.h"
#include "tests/master/behaviour/fish_in_mind.h"
#include "tests/master/world/reef_water.h"

namespace aquarama::world {
namespace {

using behaviour::CleanStage;
using behaviour::VisitStage;

// Clownfish that clean: no species of its own is needed to see how a station works.
WorldSpecies cleaners(std::uint32_t fish) {
    WorldSpecies cleaners = capturedSpecies(test::castMember("clownfish"), fish);
    cleaners.name = "cleaner";
    cleaners.habits.home = {.kind = config::HomeKind::Place,
                            .radiusMetres = 0.5,
                            .leashMetres = 1.5,
                            .onTheReef = true,
                            .site = config::SiteKind::Cleaning,
                            .group = fish};
    cleaners.habits.cleans = config::Cleans{.inspectSeconds = 12};
    return cleaners;
}

WorldOptions station(std::uint32_t seed, std::uint32_t clients) {
    return reefWater(seed,
                     {{.kind = config::SiteKind::Cleaning, .xz = kRightHead}},
                     {capturedSpecies(test::castMember("parrotfish"), clients), cleaners(1)});
}

// What happens at the station, tick by tick.
class Observed {
  public:
    explicit Observed(const WorldOptions& options)
        : world_(options),
          clients_(options.cast.front().fish),
          station_(behaviour::homeOf(world_.speciesParameters()[1], clients_)),
          stage_(clients_, -1),
          posed_(clients_, 0) {}

    void runMinutes(int minutes) {
        for (int tick = 0; tick < minutes * 3600; ++tick) {
            world_.advance();
            std::size_t there = 0;
            for (std::uint32_t fish = 0; fish < clients_; ++fish) there += observe(fish) ? 1U : 0U;
            most = std::max(most, there);
            sum += there;
            ++ticks;
            observeCleaner();
        }
    }

    int visits = 0;  // that reached a pose
    int chases = 0;
    int bites = 0;
    int inspections = 0;
    std::vector<double> posedSeconds;
    std::vector<float> poseMetres;        // from the station
    std::vector<float> afterwardsMetres;  // 20 s after a pose
    std::vector<float> tilts;             // sines
    std::vector<float> mouths;            // of those that pose, in 1/255
    std::uint64_t inspected = 0;          // ticks with a client
    std::size_t most = 0;                 // clients at the station at a time
    std::uint64_t sum = 0, ticks = 0;

  private:
    // Whether the fish is a client near the station.
    bool observe(std::uint32_t fish) {
        const fish::Mind& mind = world_.minds()[fish];
        const bool visiting = fish::aimOf(mind).intention == fish::Intention::Visit;
        const int stage = visiting ? mind.stage : -1;
        const float metres = place::lengthOf(world_.view().position(fish) - station_);
        if (stage == int(VisitStage::Pose)) {
            if (stage_[fish] != stage) ++visits;
            // Making way for another interrupts a pose, and its time stands still.
            const bool isPosing = mind.intention == fish::Intention::Visit;
            posed_[fish] += isPosing ? 1 : 0;
            if (isPosing && posed_[fish] % 60 == 0 && posed_[fish] > 180) {
                poseMetres.push_back(metres);
                tilts.push_back(std::abs(world_.view().heading(fish).y));
                mouths.push_back(world_.states().mouth[fish]);
            }
        } else if (posed_[fish] > 0) {
            posedSeconds.push_back(static_cast<double>(posed_[fish]) / 60);
            posed_[fish] = 0;
            left_[world_.tick().value + 20 * 60] = fish;
        }
        if (stage == int(VisitStage::Chase) && stage_[fish] != stage) ++chases;
        if (const auto it = left_.find(world_.tick().value);
            it != left_.end() && it->second == fish)
            afterwardsMetres.push_back(metres);
        stage_[fish] = stage;
        return visiting && metres < 1.5F;
    }

    void observeCleaner() {
        const fish::Mind& mind = world_.minds()[clients_];
        const bool cleans = fish::aimOf(mind).intention == fish::Intention::Clean &&
                            fish::aimOf(mind).target != fish::kNobody;
        const int stage = cleans ? mind.stage : -1;
        if (cleans && cleaner_ < 0) ++inspections;
        if (stage == int(CleanStage::Bite) && cleaner_ != stage) ++bites;
        inspected += cleans ? 1U : 0U;
        cleaner_ = stage;
    }

    World world_;
    std::uint32_t clients_;
    glm::vec3 station_;
    std::vector<int> stage_;
    std::vector<int> posed_;
    std::map<std::uint64_t, std::uint32_t> left_;
    int cleaner_ = -1;
};

float median(std::vector<float> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

TEST(Cleaning, clientsComePoseTiltedAndLeave) {
    Observed seen(station(1, 4));
    seen.runMinutes(12);
    std::cout << seen.visits << " poses, " << median(seen.poseMetres) << " m off, tilt "
              << median(seen.tilts) << ", 20 s later " << median(seen.afterwardsMetres)
              << " m off\n";
    EXPECT_GE(seen.visits, 6) << "of four clients in 12 minutes";
    EXPECT_LT(median(seen.poseMetres), 0.6F);
    EXPECT_GT(median(seen.tilts), 0.15F);
    EXPECT_GE(median(seen.mouths), 110) << "a client holds its mouth open";
    for (const double lasts : seen.posedSeconds) EXPECT_LT(lasts, 21);
    EXPECT_GT(median(seen.afterwardsMetres), 1.5F);
}

TEST(Cleaning, theQueueIsShort) {
    Observed seen(station(3, 16));
    seen.runMinutes(12);
    const double mean = static_cast<double>(seen.sum) / static_cast<double>(seen.ticks);
    std::cout << "clients at the station: " << mean << " in the mean, " << seen.most
              << " at most\n";
    EXPECT_LE(seen.most, behaviour::kMostClients + 1) << "one may come as another does";
    EXPECT_GT(mean, 0.2);
}

TEST(Cleaning, theCleanerIsWithAClientForAGoodPartOfTheDayAndSometimesBites) {
    Observed seen(station(4, 8));
    seen.runMinutes(30);
    const double share = static_cast<double>(seen.inspected) / static_cast<double>(seen.ticks);
    std::cout << seen.inspections << " inspections, " << 100 * share << " % of the time, "
              << seen.bites << " bites, " << seen.chases << " chases\n";
    EXPECT_GE(seen.inspections, 30);
    EXPECT_GT(share, 0.1);
    EXPECT_LT(share, 0.7);
    EXPECT_GE(seen.bites, seen.inspections / 15);
    EXPECT_LE(seen.bites, seen.inspections / 3);
    EXPECT_GE(seen.chases, (seen.bites + 1) / 2) << "a client that leaves meanwhile chases nobody";
}

TEST(Cleaning, preyAndSmallFishDoNotGoToCleaners) {
    behaviour::FishInMind pacifist(config::Role::Pacifist);
    behaviour::FishInMind prey(config::Role::Prey);
    EXPECT_TRUE(behaviour::goesToCleaners(pacifist.parameters, 0.2F));
    EXPECT_FALSE(behaviour::goesToCleaners(pacifist.parameters, 0.1F));
    EXPECT_FALSE(behaviour::goesToCleaners(prey.parameters, 0.2F));
    pacifist.parameters.habits.cleans = config::Cleans{};
    EXPECT_FALSE(behaviour::goesToCleaners(pacifist.parameters, 0.2F));
}

TEST(Cleaning, aClientGoesOnceItWantsToAndStaysUntilItLeaves) {
    behaviour::FishInMind client(config::Role::Pacifist);
    client.senses.length = 0.2F;
    client.senses.cleaning.cleaner = {.object = 7, .offset = {1, 0, 0}, .distance = 1};
    client.senses.cleaning.urge = 0.9F;
    EXPECT_EQ(client.think(), fish::Intention::Wander);
    client.senses.cleaning.urge = 1;
    client.feelings.hunger = 1;
    client.showFood(5);
    EXPECT_EQ(client.think(), fish::Intention::Visit) << "before its meal";
    EXPECT_EQ(client.mind.target, 7U);
    client.threaten(9);
    EXPECT_EQ(client.think(), fish::Intention::AvoidFish);
    client.clearTheWay();
    client.mind.stage = static_cast<std::uint8_t>(VisitStage::Pose);
    EXPECT_EQ(client.think(), fish::Intention::Visit) << "it resumes its visit";
    EXPECT_EQ(client.mind.stage, static_cast<std::uint8_t>(VisitStage::Pose));
    client.senses.cleaning.urge = 0;
    EXPECT_EQ(client.think(), fish::Intention::Eat) << "it has left";
}

TEST(Cleaning, aPredatorOnAHuntDoesNotGo) {
    behaviour::FishInMind hunter(config::Role::Predator);
    hunter.senses.length = 1;
    hunter.feelings.hunger = 1;
    hunter.showPrey(3);
    EXPECT_EQ(hunter.think(), fish::Intention::Eat);
    hunter.senses.cleaning.cleaner = {.object = 7, .offset = {1, 0, 0}, .distance = 1};
    hunter.senses.cleaning.urge = 2;
    EXPECT_EQ(hunter.think(), fish::Intention::Eat);
    EXPECT_EQ(hunter.rule(behaviour::PriorityRule::Cleaning).verdict, behaviour::Verdict::Yields);
}

TEST(Cleaning, aPredatorWithACleanerIsFearedLess) {
    behaviour::FishInMind one;
    one.parameters.habits.fear.metres = 1;
    one.senses.length = 0.2F;
    one.senses.predators[0] = {.object = 40, .offset = {2, 0, 0}, .distance = 2};
    one.senses.predatorCount = 1;
    const float fear = behaviour::feel(one.parameters, one.mind, one.senses).fear;
    one.senses.predators[0].heeded = 0.3F;
    EXPECT_NEAR(behaviour::feel(one.parameters, one.mind, one.senses).fear, 0.3F * fear, 1e-6F);
}

}  // namespace
}  // namespace aquarama::world
