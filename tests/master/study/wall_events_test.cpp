// SPDX-License-Identifier: Apache-2.0
#include "master/study/wall_events.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "master/behaviour/routines.h"
#include "master/study/wall_view.h"

namespace aquarama::study {
namespace {

using fish::Intention;

// A made-up world: fish of two species, of which the second hunts.
class MadeUp {
  public:
    MadeUp(std::uint32_t prey, std::uint32_t predators) : species_(2) {
        species_[0].kind = 0;
        species_[0].last = prey;
        species_[0].habits.role = config::Role::Prey;
        species_[1].kind = 1;
        species_[1].first = prey;
        species_[1].last = prey + predators;
        species_[1].habits.role = config::Role::Predator;
        view.resize(prey + predators);
        minds.resize(prey + predators);
        for (std::uint32_t fish = prey; fish < view.size(); ++fish) view.kind[fish] = 1;
        for (fish::VisibleFish& one : view.fish) one.length = 0.2F;
        watch_.emplace(now());
    }

    // So many seconds pass, in which the fish do as they do now.
    void pass(double seconds) {
        const auto looks = static_cast<int>(seconds * 60 / EventWatch::kTicksBetweenLooks);
        for (int look = 0; look < looks; ++look) {
            tick_.value += EventWatch::kTicksBetweenLooks;
            watch_->note(now(), sees());
            if (tick_.value % 60 == 0) watch_->noteSchools(now(), groupsOf(view), sees());
        }
    }
    // So many seconds with the fish's headings given by `headingAt` of each second.
    template <class HeadingAt>
    void turn(int seconds, const HeadingAt& headingAt) {
        for (int second = 0; second < seconds; ++second) {
            for (std::size_t fish = 0; fish < view.size(); ++fish)
                view.fish[fish].heading = headingAt(second, fish);
            tick_.value += 60;
            watch_->noteClouds(now(), sees());
        }
    }
    [[nodiscard]] fish::SpeciesParameters& species(std::size_t kind) { return species_[kind]; }
    // Begins anew, after changes of species.
    void watch() { watch_.emplace(now()); }
    void all(Intention intention) {
        for (std::size_t fish = 0; fish < minds.size(); ++fish) minds[fish].intention = intention;
    }
    // Numbers of the events of a kind, and of those in view.
    [[nodiscard]] std::ptrdiff_t count(WallEvent kind) const {
        return std::ranges::count(watch_->all(), kind, &NotedEvent::kind);
    }
    [[nodiscard]] std::ptrdiff_t inView(WallEvent kind) const {
        return std::ranges::count_if(watch_->all(), [&](const NotedEvent& event) {
            return event.kind == kind && event.isInView;
        });
    }
    [[nodiscard]] std::span<const NotedEvent> events() const { return watch_->all(); }

    fish::FishView view;
    fish::Minds minds;
    bool isInView = true;

  private:
    [[nodiscard]] WatchedFish now() const { return {view, minds, species_, tick_}; }
    [[nodiscard]] EventWatch::Sees sees() const {
        return [this](std::uint32_t) { return isInView; };
    }
    std::vector<fish::SpeciesParameters> species_;
    Tick tick_;
    std::optional<EventWatch> watch_;
};

TEST(WallEvents, everyKindHasItsName) {
    EXPECT_STREQ(nameOf(WallEvent::Flight), "flight");
    EXPECT_STREQ(nameOf(WallEvent::Meeting), "meeting of a school");
}

TEST(WallEvents, aFlightOfSeveralIsOneEventAndAnotherElsewhereIsASecond) {
    MadeUp world(4, 0);
    world.view.fish[3].position = {5, 0, 0};
    world.pass(1);
    EXPECT_TRUE(world.events().empty());
    world.minds[0].intention = Intention::Escape;
    world.pass(1);
    world.minds[1].intention = world.minds[2].intention = Intention::Escape;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Flight), 1);
    world.minds[3].intention = Intention::Escape;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Flight), 2);
    EXPECT_EQ(world.inView(WallEvent::Flight), 2);
}

TEST(WallEvents, aFlightThatGoesOnStaysOneEventAndALaterOneIsNew) {
    MadeUp world(2, 0);
    world.minds[0].intention = Intention::Escape;
    world.pass(10);
    world.minds[1].intention = Intention::Escape;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Flight), 1) << "the first one still flees";
    world.all(Intention::Wander);
    world.pass(2);
    world.minds[1].intention = Intention::Escape;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Flight), 1) << "two seconds are no pause";
    world.all(Intention::Wander);
    world.pass(4);
    world.minds[1].intention = Intention::Escape;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Flight), 2);
}

TEST(WallEvents, whatIsOutOfViewIsNotedAsSuch) {
    MadeUp world(2, 0);
    world.isInView = false;
    world.minds[0].intention = Intention::Escape;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Flight), 1);
    EXPECT_EQ(world.inView(WallEvent::Flight), 0);
    world.isInView = true;
    world.minds[1].intention = Intention::Escape;
    world.pass(1);
    EXPECT_EQ(world.inView(WallEvent::Flight), 1) << "one of it is seen";
    EXPECT_EQ(world.count(WallEvent::Flight), 1);
}

TEST(WallEvents, aFastStartOfOneWhoFleesIsPartOfTheFlight) {
    MadeUp world(2, 0);
    world.view.fish[1].position = {5, 0, 0};
    world.minds[0].intention = Intention::Escape;
    world.view.signs[0] = fish::kStartled;
    world.pass(0.2);
    EXPECT_EQ(world.count(WallEvent::FastStart), 0);
    world.view.signs[1] = fish::kStartled;
    world.pass(0.2);
    EXPECT_EQ(world.count(WallEvent::FastStart), 1) << "far from the flight";
}

TEST(WallEvents, aHuntIsOfPredatorsAndLastsThroughAnInterruption) {
    MadeUp world(2, 1);
    world.all(Intention::Eat);
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Chase), 1) << "prey that eats hunts nobody";
    world.minds[2].intention = Intention::AvoidObstacle;
    world.minds[2].remembered = Intention::Eat;
    world.pass(10);
    world.minds[2].intention = Intention::Eat;
    world.minds[2].remembered = Intention::Wander;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Chase), 1);
}

TEST(WallEvents, aCourtshipIsOneEventOfItsPair) {
    MadeUp world(2, 0);
    world.minds[0].intention = Intention::Mate;
    world.pass(5);
    world.minds[1].intention = Intention::Mate;
    world.pass(5);
    EXPECT_EQ(world.count(WallEvent::Courtship), 1);
}

TEST(WallEvents, fiveThatGoForFoodWithinASecondAreARush) {
    MadeUp slow(5, 0);
    for (std::size_t fish = 0; fish < 5; ++fish) {
        slow.minds[fish].intention = Intention::Eat;
        slow.pass(0.4);
    }
    EXPECT_EQ(slow.count(WallEvent::FeedingRush), 0) << "one after another";
    MadeUp quick(5, 0);
    for (std::size_t fish = 0; fish < 4; ++fish) quick.minds[fish].intention = Intention::Eat;
    quick.pass(0.4);
    EXPECT_EQ(quick.count(WallEvent::FeedingRush), 0) << "four";
    quick.minds[4].intention = Intention::Eat;
    quick.pass(0.4);
    EXPECT_EQ(quick.count(WallEvent::FeedingRush), 1);
}

TEST(WallEvents, whoIsAwayDoesNothing) {
    MadeUp world(1, 0);
    world.view.signs[0] = fish::kAway;
    world.minds[0].intention = Intention::Escape;
    world.pass(1);
    EXPECT_TRUE(world.events().empty());
}

// Twenty in two halves, a given way apart.
void part(MadeUp& world, float metres) {
    for (std::size_t fish = 0; fish < 20; ++fish)
        world.view.fish[fish].position = {fish < 10 ? 0 : metres, 0, 0};
}

TEST(WallEvents, aSchoolThatPartsForThreeSecondsHasSplitAndMeetsAgain) {
    MadeUp world(20, 0);
    for (std::size_t fish = 0; fish < 20; ++fish) world.view.signs[fish] = fish::kSchooling;
    part(world, 0.5F);
    world.pass(5);
    part(world, 3);
    world.pass(2);
    part(world, 0.5F);
    world.pass(5);
    EXPECT_TRUE(world.events().empty()) << "two seconds apart are no split";
    part(world, 3);
    world.pass(4);
    EXPECT_EQ(world.count(WallEvent::Split), 1);
    part(world, 0.5F);
    world.pass(4);
    EXPECT_EQ(world.count(WallEvent::Split), 1);
    EXPECT_EQ(world.count(WallEvent::Meeting), 1);
    EXPECT_EQ(world.inView(WallEvent::Meeting), 1);
}

TEST(WallEvents, fishThatDoNotSchoolDoNotSplit) {
    MadeUp world(20, 0);
    part(world, 0.5F);
    world.pass(5);
    part(world, 3);
    world.pass(5);
    EXPECT_TRUE(world.events().empty());
}

TEST(WallEvents, aPartIsATenthOfThoseWhoAreThereAndThreeAtLeast) {
    fish::FishView view;
    view.resize(40);
    std::vector<std::uint32_t> groups(40, 0);
    for (std::size_t fish = 30; fish < 34; ++fish) groups[fish] = 30;  // a tenth
    for (std::size_t fish = 34; fish < 37; ++fish) groups[fish] = 34;  // fewer
    EXPECT_EQ(partsOf(view, 0, 40, groups), 2U);
    for (std::size_t fish = 0; fish < 27; ++fish) groups[fish] = fish::kNobody;
    groups[27] = groups[28] = groups[29] = 27;
    groups[37] = groups[38] = groups[39] = 37;
    EXPECT_EQ(partsOf(view, 0, 40, groups), 4U) << "of thirteen: 3, 4, 3 and 3";
}

TEST(WallEvents, threeThatHideNearByAreADiveAndFewerAreNone) {
    MadeUp world(4, 0);
    world.view.fish[3].position = {5, 0, 0};
    world.minds[0].intention = world.minds[1].intention = world.minds[3].intention =
        Intention::Hide;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Dive), 0) << "two, and one elsewhere";
    world.minds[2].intention = Intention::Hide;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Dive), 1);
    EXPECT_EQ(world.count(WallEvent::Flight), 0);
}

TEST(WallEvents, aFastStartIntoADiveBelongsToIt) {
    MadeUp world(3, 0);
    world.all(Intention::Hide);
    for (std::uint8_t& signs : world.view.signs) signs = fish::kStartled;
    world.pass(0.2);
    EXPECT_EQ(world.count(WallEvent::Dive), 1);
    EXPECT_EQ(world.count(WallEvent::FastStart), 0);
}

TEST(WallEvents, aCleaningBeginsWhereACleanerIsBesideItsClient) {
    MadeUp world(3, 0);
    world.view.fish[1].position = {0.5F, 0, 0};
    world.minds[0].intention = Intention::Clean;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Cleaning), 0) << "nobody to clean";
    world.minds[0].target = 1;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Cleaning), 0) << "on its way";
    world.view.fish[1].position = {0.15F, 0, 0};
    world.pass(5);
    EXPECT_EQ(world.count(WallEvent::Cleaning), 1);
    world.minds[0].target = fish::kNobody;
    world.pass(4);
    world.minds[0].target = 2;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Cleaning), 2);
}

// Fish of one shoal at their patch, or on the way to it.
void graze(MadeUp& world, behaviour::GrazeStage stage) {
    world.all(Intention::Graze);
    for (std::size_t fish = 0; fish < world.minds.size(); ++fish) {
        world.minds[fish].target = world.view.patch[fish] = 0;
        world.minds[fish].stage = static_cast<std::uint8_t>(stage);
    }
}

TEST(WallEvents, aShoalMakesOneStopAtEachPatchAndOneFishOnItsRoundToo) {
    for (const std::uint32_t fish : {4U, 1U}) {
        MadeUp world(fish, 0);
        world.species(0).habits.graze = config::Graze{
            .manner = fish == 1 ? config::GrazeManner::Loop : config::GrazeManner::Shoal};
        graze(world, behaviour::GrazeStage::Travel);
        world.pass(5);
        EXPECT_EQ(world.count(WallEvent::GrazeStop), 0);
        graze(world, behaviour::GrazeStage::Settle);
        world.pass(2);
        graze(world, behaviour::GrazeStage::Bite);
        world.pass(5);
        EXPECT_EQ(world.count(WallEvent::GrazeStop), 1);
        graze(world, behaviour::GrazeStage::Travel);
        world.pass(5);
        graze(world, behaviour::GrazeStage::Bite);
        world.pass(1);
        EXPECT_EQ(world.count(WallEvent::GrazeStop), 2);
    }
}

TEST(WallEvents, twoThatGrazeAreNoShoal) {
    MadeUp world(2, 0);
    world.species(0).habits.graze = config::Graze{};
    graze(world, behaviour::GrazeStage::Bite);
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::GrazeStop), 0);
}

TEST(WallEvents, aChargeIsOneEventAndSoIsTheFlightOfWhoIsCharged) {
    MadeUp world(2, 1);
    world.species(0).huntedBy = 2;
    world.minds[0].intention = Intention::Charge;
    world.minds[0].target = 1;
    world.view.signs[0] = fish::kStartled;
    world.minds[1].intention = Intention::Escape;
    world.minds[1].target = 0;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Charge), 1);
    EXPECT_EQ(world.events().size(), 1U);
    world.minds[1].target = 2;
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Flight), 1) << "from a hunter";
}

TEST(WallEvents, aFishThatRidesBesideAnotherOfTheRightSpeciesShadowsIt) {
    MadeUp world(2, 1);
    world.species(1).shadows = 1;
    for (fish::VisibleFish& one : world.view.fish) {
        one.heading = {1, 0, 0};
        one.speed = 0.3F;
    }
    world.view.fish[1].position = {0, 0.2F, 0};
    world.view.fish[2].position = {3, 0, 0};
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Shadowing), 0) << "far off, and those who shadow nobody";
    world.view.fish[2].position = {0, 0.3F, 0};
    world.view.fish[2].heading = {0, 0, 1};
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Shadowing), 0) << "it crosses";
    world.view.fish[2].heading = {1, 0, 0};
    world.pass(1);
    EXPECT_EQ(world.count(WallEvent::Shadowing), 1);
}

TEST(WallEvents, aCloudThatTurnsRoundFlipsOnceHoweverSlowly) {
    MadeUp world(6, 0);
    world.species(0).habits.cloud = config::Cloud{};
    world.all(Intention::Hover);
    world.watch();
    const auto ahead = [](int, std::size_t) { return glm::vec3{1, 0, 0}; };
    const auto back = [](int, std::size_t) { return glm::vec3{-1, 0, 0}; };
    const auto everywhere = [](int, std::size_t fish) {
        return glm::vec3{fish % 2 == 0 ? -1 : 1, 0, 0};
    };
    world.turn(5, ahead);
    world.turn(10, everywhere);
    world.turn(2, back);
    world.turn(5, ahead);
    EXPECT_TRUE(world.events().empty()) << "two seconds are no flip";
    // Half a turn in 40 s, in steps of a few degrees.
    world.turn(40, [](int second, std::size_t) {
        const float x = 1 - static_cast<float>(second) / 20;
        return glm::vec3{x, 0, std::sqrt(1 - x * x)};
    });
    world.turn(20, back);
    EXPECT_EQ(world.count(WallEvent::Flip), 1);
    world.turn(3, ahead);
    EXPECT_EQ(world.count(WallEvent::Flip), 2);
    EXPECT_EQ(world.inView(WallEvent::Flip), 2);
}

TEST(WallEvents, onlyFishThatHoverAreACloud) {
    MadeUp world(6, 0);
    world.watch();
    world.all(Intention::Hover);
    world.turn(5, [](int, std::size_t) { return glm::vec3{1, 0, 0}; });
    world.turn(5, [](int, std::size_t) { return glm::vec3{-1, 0, 0}; });
    EXPECT_TRUE(world.events().empty()) << "its species keeps no cloud";
    world.species(0).habits.cloud = config::Cloud{};
    world.watch();
    world.all(Intention::Rest);
    world.turn(5, [](int, std::size_t) { return glm::vec3{1, 0, 0}; });
    world.turn(5, [](int, std::size_t) { return glm::vec3{-1, 0, 0}; });
    EXPECT_TRUE(world.events().empty()) << "it rests";
}

}  // namespace
}  // namespace aquarama::study
