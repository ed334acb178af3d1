// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/show_control.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;
using Phase = ShowControl::Phase;

constexpr net::Moment kStart{std::chrono::seconds(100)};

v1::WantedShow scene(const std::string& name) {
    v1::WantedShow change;
    change.set_scene(name);
    return change;
}

v1::WantedShow black(bool on) {
    v1::WantedShow change;
    change.set_black(on);
    return change;
}

v1::WantedShow brightness(double share) {
    v1::WantedShow change;
    change.set_brightness(share);
    return change;
}

// A control with its book.
struct Controlled {
    explicit Controlled(const v1::WantedShow& wanted) : control(wanted, {}, book) {}
    ask::OrderBook book;
    ShowControl control;
};

// A wall that shows the scene reef.
struct Reef : Controlled {
    Reef() : Controlled(scene("reef")) {}
};

// To the phase in which the next look is shown with the next frame.
void prepareAll(ShowControl& control) {
    control.made();
    control.prepared();
    control.blackShown();
}

TEST(ShowControl, blackFreezeAndPatternsHoldAtOnce) {
    Reef reef;
    ShowControl& control = reef.control;
    v1::WantedShow change;
    change.set_black(true);
    change.set_freeze(true);
    change.set_pattern(v1::WantedShow::GRID);
    EXPECT_EQ(control.set(1, change).outcome, Outcome::Done);
    EXPECT_EQ(control.phase(), Phase::Steady);
    EXPECT_TRUE(control.wanted().black());
    EXPECT_TRUE(control.wanted().freeze());
    EXPECT_EQ(control.wanted().pattern(), v1::WantedShow::GRID);
    EXPECT_EQ(control.look(), 1U);
    EXPECT_TRUE(wire::areSame(control.kept(), change));
}

v1::WantedShow colour(double share) {
    v1::WantedShow change;
    change.set_colour_returned(share);
    return change;
}

TEST(ShowControl, aColourHoldsAtOnceUntilASceneIsSet) {
    Reef reef;
    ShowControl& control = reef.control;
    EXPECT_FALSE(control.wanted().has_colour_returned()) << "the scene's own";
    EXPECT_EQ(control.set(1, colour(0.4)).outcome, Outcome::Done);
    EXPECT_EQ(control.wanted().colour_returned(), 0.4);
    EXPECT_EQ(control.version(), 2U);
    EXPECT_EQ(control.set(2, scene("lagoon")).outcome, Outcome::Waiting);
    EXPECT_EQ(control.set(3, colour(0.6)).outcome, Outcome::Done);
    EXPECT_EQ(control.wanted().colour_returned(), 0.6) << "of the scene that is still shown";
    prepareAll(control);
    control.switched();
    EXPECT_FALSE(control.wanted().has_colour_returned());
    EXPECT_TRUE(wire::areSame(control.kept(), scene("lagoon")));
    EXPECT_EQ(control.set(4, colour(1)).outcome, Outcome::Done);
    EXPECT_EQ(control.set(5, scene("lagoon")).outcome, Outcome::Done);
    EXPECT_FALSE(control.wanted().has_colour_returned()) << "the same scene again is as it came";
}

TEST(ShowControl, aSceneIsMadeThenBuiltThenShownAfterBlack) {
    Reef reef;
    ShowControl& control = reef.control;
    EXPECT_EQ(control.set(1, scene("lagoon")).outcome, Outcome::Waiting);
    EXPECT_EQ(control.phase(), Phase::Making);
    control.made();
    EXPECT_EQ(control.phase(), Phase::Preparing);
    EXPECT_EQ(control.wanted().scene(), "reef") << "until it is shown";
    EXPECT_TRUE(wire::areSame(control.kept(), {})) << "a scene that never comes on is not kept";
    control.prepared();
    EXPECT_EQ(control.phase(), Phase::Fading);
    EXPECT_EQ(control.set(1, scene("lagoon")).outcome, Outcome::Waiting);
    control.blackShown();
    EXPECT_EQ(control.phase(), Phase::Switching);
    control.switched();
    EXPECT_EQ(control.wanted().scene(), "lagoon");
    EXPECT_EQ(control.look(), 2U);
    EXPECT_EQ(control.set(1, scene("lagoon")).outcome, Outcome::Done);
    EXPECT_TRUE(wire::areSame(control.kept(), scene("lagoon")));
}

// Half a second to black and half a second back, whatever the times of the frames.
TEST(ShowControl, fadesInHalfASecond) {
    Reef reef;
    ShowControl& control = reef.control;
    EXPECT_EQ(control.brightness(kStart), 1);
    static_cast<void>(control.set(1, scene("lagoon")));
    EXPECT_EQ(control.brightness(kStart + milliseconds(100)), 1) << "while it is prepared";
    control.made();
    control.prepared();
    EXPECT_NEAR(control.brightness(kStart + milliseconds(350)), 0.5, 1e-5);
    EXPECT_EQ(control.brightness(kStart + milliseconds(700)), 0);
    control.blackShown();
    EXPECT_EQ(control.brightness(kStart + milliseconds(900)), 0);
    control.switched();
    EXPECT_EQ(control.brightness(kStart + milliseconds(1000)), 0) << "the first of the new scene";
    EXPECT_NEAR(control.brightness(kStart + milliseconds(1100)), 0.2, 1e-5);
    EXPECT_EQ(control.brightness(kStart + milliseconds(1500)), 1);
}

TEST(ShowControl, lightComesToWhatIsWantedAsFastAsToBlack) {
    Reef reef;
    ShowControl& control = reef.control;
    EXPECT_EQ(control.brightness(kStart), 1);
    EXPECT_EQ(control.set(1, brightness(0.5)).outcome, Outcome::Done);
    EXPECT_NEAR(control.brightness(kStart + milliseconds(100)), 0.8, 1e-5);
    EXPECT_EQ(control.brightness(kStart + milliseconds(400)), 0.5F);
    static_cast<void>(control.set(2, black(true)));
    EXPECT_EQ(control.brightness(kStart + milliseconds(700)), 0);
    static_cast<void>(control.set(3, black(false)));
    EXPECT_EQ(control.brightness(kStart + milliseconds(1100)), 0.5F) << "no more than was wanted";
    static_cast<void>(control.set(4, scene("lagoon")));
    static_cast<void>(control.set(5, brightness(0.25)));
    prepareAll(control);
    control.switched();
    EXPECT_EQ(control.wanted().brightness(), 0.25) << "another scene does not change it";
    v1::WantedShow kept = scene("lagoon");
    kept.set_black(false);
    kept.set_brightness(0.25);
    EXPECT_TRUE(wire::areSame(control.kept(), kept));
}

TEST(ShowControl, aShowThatWasDimmedBeginsSo) {
    Controlled wall(brightness(0.25));
    EXPECT_EQ(wall.control.brightness(kStart), 0.25F);
}

TEST(ShowControl, blackStaysBlackThroughAChangeOfScene) {
    v1::WantedShow dark = scene("reef");
    dark.set_black(true);
    Controlled wall(dark);
    ShowControl& control = wall.control;
    EXPECT_EQ(control.brightness(kStart), 0);
    static_cast<void>(control.set(1, scene("lagoon")));
    prepareAll(control);
    control.switched();
    EXPECT_EQ(control.brightness(kStart + std::chrono::seconds(9)), 0);
    static_cast<void>(control.set(2, black(false)));
    EXPECT_EQ(control.brightness(kStart + std::chrono::seconds(10)), 1);
}

// What was set while a scene is prepared is not undone by it.
TEST(ShowControl, blackThatIsSetWhileASceneIsPreparedStays) {
    Reef reef;
    ShowControl& control = reef.control;
    static_cast<void>(control.set(1, scene("lagoon")));
    EXPECT_EQ(control.set(2, black(true)).outcome, Outcome::Done);
    prepareAll(control);
    control.switched();
    EXPECT_TRUE(control.wanted().black());
}

TEST(ShowControl, aSecondSceneIsRefusedUntilTheFirstIsShown) {
    Reef reef;
    ShowControl& control = reef.control;
    static_cast<void>(control.set(1, scene("lagoon")));
    EXPECT_EQ(control.set(2, scene("pond")).outcome, Outcome::Refused);
    prepareAll(control);
    control.switched();
    EXPECT_EQ(control.set(2, scene("pond")).outcome, Outcome::Refused) << "the same answer again";
    EXPECT_EQ(control.set(3, scene("pond")).outcome, Outcome::Waiting);
}

TEST(ShowControl, aChangeThatFailsLeavesTheWallAsItWas) {
    Reef reef;
    ShowControl& control = reef.control;
    static_cast<void>(control.set(1, scene("pond")));
    control.fail("there is no such scene");
    EXPECT_EQ(control.phase(), Phase::Steady);
    EXPECT_EQ(control.wanted().scene(), "reef");
    EXPECT_EQ(control.look(), 1U);
    const Answer answer = control.set(1, scene("pond"));
    EXPECT_EQ(answer.outcome, Outcome::Refused);
    EXPECT_EQ(answer.reason, "there is no such scene");
    static_cast<void>(control.set(2, scene("lagoon")));
    EXPECT_EQ(control.nextLook(), 3U) << "a node may have built look 2, which was given up";
}

// A packet that was delayed must not undo what somebody else has set since.
TEST(ShowControl, aRequestThatIsSaidAgainIsNotDoneAgain) {
    Reef reef;
    ShowControl& control = reef.control;
    static_cast<void>(control.set(1, black(true)));
    static_cast<void>(control.set(2, black(false)));
    EXPECT_EQ(control.set(1, black(true)).outcome, Outcome::Done);
    EXPECT_FALSE(control.wanted().black());
    EXPECT_EQ(control.version(), 3U);
}

// A wall that began with a pattern has built no world.
TEST(ShowControl, aWorldIsBuiltBeforeItReplacesAPattern) {
    v1::WantedShow grid = scene("reef");
    grid.set_pattern(v1::WantedShow::GRID);
    Controlled wall(grid);
    ShowControl& control = wall.control;
    v1::WantedShow world;
    world.set_pattern(v1::WantedShow::WORLD);
    EXPECT_EQ(control.set(1, world).outcome, Outcome::Waiting);
    EXPECT_EQ(control.phase(), Phase::Preparing);
    EXPECT_EQ(control.wanted().pattern(), v1::WantedShow::GRID);
    EXPECT_TRUE(control.nextHasWorld());
    control.prepared();
    EXPECT_EQ(control.phase(), Phase::Switching) << "the same scene needs no black";
    control.switched();
    EXPECT_EQ(control.wanted().pattern(), v1::WantedShow::WORLD);
}

TEST(KeptShow, isReadAsItWasWritten) {
    const std::filesystem::path file = testing::TempDir() + "aquarama_kept_show.txtpb";
    v1::WantedShow kept;
    for (const bool on : {false, true}) {
        wire::keepShow(file, kept);
        EXPECT_TRUE(wire::areSame(wire::readKeptShow(file), kept));
        kept.set_scene("lagoon");
        kept.set_quality(on ? v1::WantedShow::HIGH : v1::WantedShow::AUTO);
        kept.set_pattern(v1::WantedShow::GREY);
        kept.set_black(on);
        kept.set_freeze(on);
    }
    wire::keepShow(file, kept);
    EXPECT_TRUE(wire::areSame(wire::readKeptShow(file), kept));
    std::ofstream(file) << "version: 1 colour: 3";
    EXPECT_THROW(static_cast<void>(wire::readKeptShow(file)), Error);
    std::filesystem::remove(file);
    EXPECT_TRUE(wire::areSame(wire::readKeptShow(file), {}));
}

// The laptop of a crew may die in the middle of a scan.
TEST(ScanHold, endsWhenItsHolderFallsSilent) {
    using std::chrono::seconds;
    ScanHold hold;
    const config::ScanPattern pattern{.number = 3};
    EXPECT_FALSE(hold.expires(kStart));
    EXPECT_TRUE(hold.hold(7, pattern, Frame{40}, kStart));
    EXPECT_TRUE(hold.hold(7, pattern, Frame{80}, kStart + seconds(2)));
    EXPECT_EQ(hold.first(), Frame{40}) << "the same, said again";
    EXPECT_FALSE(hold.hold(8, pattern, Frame{80}, kStart + seconds(2)));
    EXPECT_FALSE(hold.expires(kStart + seconds(5)));
    EXPECT_EQ(hold.pattern(), pattern);
    EXPECT_TRUE(hold.expires(kStart + seconds(6)));
    EXPECT_FALSE(hold.pattern());
    EXPECT_EQ(hold.changes(), 2U);
    EXPECT_TRUE(hold.hold(8, pattern, Frame{90}, kStart + seconds(6)));
    EXPECT_EQ(hold.first(), Frame{90});
}

}  // namespace
}  // namespace aquarama::conductor
