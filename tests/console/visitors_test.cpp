// SPDX-License-Identifier: Apache-2.0
#include "console/visitors.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/console/parts.h"

namespace aquarama::console {
namespace {

using test::Page;

browser::Look lookAt(const std::vector<std::string>& topics,
                     const std::vector<std::string>& channels = {},
                     std::uint32_t widthPixels = 320) {
    browser::Look look;
    for (const std::string& topic : topics) look.add_topics(topic);
    for (const std::string& channel : channels) look.add_channels(channel);
    look.set_width_px(widthPixels);
    return look;
}

v1::FramePicture picture(std::uint64_t number) {
    v1::FramePicture picture;
    picture.set_number(number);
    picture.set_frame(0x0102);
    picture.set_width_px(320);
    picture.set_height_px(180);
    picture.set_jpeg("a jpeg");
    return picture;
}

browser::PointAt place(const std::string& channel, float x) {
    browser::PointAt at;
    at.set_channel(channel);
    at.set_frame(9);
    at.set_x(x);
    at.set_y(0.5F);
    return at;
}

// Two pages of a desk: of a watcher and of somebody of the crew.
class DeskPages : public testing::Test {
  protected:
    DeskPages() {
        visitors.add(watcher.visitor);
        visitors.add(crew.visitor);
    }
    void pass(int ticks) {
        for (int tick = 0; tick < ticks; ++tick) visitors.tick();
    }

    test::ConsoleParts parts;
    Visitors& visitors = parts.visitors;
    Page watcher{ConsoleRole::Watcher}, crew{ConsoleRole::Crew, "ben"};
};

TEST_F(DeskPages, drawingsAreSentToWhoLooksWhereTheyHaveChanged) {
    v1::DrawingsReply list;
    list.add_drawings()->set_number(12);
    list.mutable_drawings(0)->set_condition(v1::DrawingStatus::WAITING);
    visitors.takeLook(watcher.visitor, lookAt({"drawings"}));
    const auto before = watcher.outbox.count("drawings");
    parts.state.drawings.hear(list);
    visitors.heardDrawings();
    for (int second = 0; second < 3; ++second) visitors.everySecond();
    EXPECT_EQ(watcher.outbox.count("drawings"), before + 1);
    EXPECT_EQ(watcher.outbox.last("drawings").drawings().drawings(0).number(), 12U);
    EXPECT_EQ(crew.outbox.count("drawings"), 0) << "looks at another page";
    visitors.sendWall(0);
    EXPECT_EQ(crew.outbox.last("wall").wall().drawings_waiting(), 1U) << "every page has the badge";
}

TEST_F(DeskPages, aPageGetsAWholeSnapshotBeforeAllElse) {
    visitors.note("wall", "left is late");
    for (const Page* page : {&watcher, &crew}) {
        EXPECT_EQ(page->outbox.sent.at(0).first, "0") << "the topic that comes first";
        ASSERT_TRUE(page->outbox.sent.at(0).second.has_snapshot());
    }
    const browser::Snapshot snapshot = watcher.outbox.sent.at(0).second.snapshot();
    EXPECT_EQ(snapshot.build(), "build 1");
    EXPECT_EQ(snapshot.name(), "anna");
    EXPECT_EQ(snapshot.role(), static_cast<browser::Role>(ConsoleRole::Watcher));
    ASSERT_EQ(snapshot.channels_size(), 3);
    EXPECT_EQ(snapshot.channels(2).name(), "right");
    EXPECT_GT(snapshot.scenes_size(), 0);
}

TEST_F(DeskPages, anEventIsSentToEverybodyButThoseWhoHaveGone) {
    visitors.remove(crew.visitor);
    visitors.note("wall", "left is late");
    EXPECT_EQ(watcher.outbox.last("events").events().events(0).what(), "left is late");
    EXPECT_EQ(crew.outbox.count("events"), 0);
    EXPECT_EQ(visitors.count(), 1U);
}

TEST_F(DeskPages, aPageGetsWhatItShowsAtOnceAndNothingElse) {
    visitors.takeLook(watcher.visitor, lookAt({"doctor"}));
    EXPECT_EQ(watcher.outbox.count("doctor"), 1);
    EXPECT_EQ(watcher.outbox.count("log"), 0);
    visitors.takeLook(watcher.visitor, lookAt({"doctor"}));
    EXPECT_EQ(watcher.outbox.count("doctor"), 1) << "the same look said again";
    visitors.takeLook(watcher.visitor, lookAt({"doctor", "log"}));
    EXPECT_EQ(watcher.outbox.count("log"), 1);
    EXPECT_EQ(crew.outbox.sent.size(), 1U) << "the snapshot";
}

TEST_F(DeskPages, onlyTheCrewIsToldOfPeople) {
    for (Page* page : {&watcher, &crew}) visitors.takeLook(page->visitor, lookAt({"people"}));
    EXPECT_EQ(watcher.outbox.count("people"), 0);
    EXPECT_EQ(crew.outbox.count("people"), 1);
}

TEST_F(DeskPages, theWholeHistoryIsSentOnceThenTheLastSecond) {
    visitors.takeLook(watcher.visitor, lookAt({"history"}));
    for (int second = 0; second < 2; ++second) visitors.everySecond();
    EXPECT_EQ(watcher.outbox.count("history"), 1);
    EXPECT_EQ(watcher.outbox.count("history of a second"), 2);
    visitors.takeLook(watcher.visitor, lookAt({}));
    visitors.takeLook(watcher.visitor, lookAt({"history"}));
    EXPECT_EQ(watcher.outbox.count("history"), 2) << "the page was left meanwhile";
}

// A browser that sleeps costs nothing.
TEST_F(DeskPages, aLookIsForgottenAfterThreeSeconds) {
    visitors.takeLook(watcher.visitor, lookAt({"calibrations"}));
    pass(29);
    EXPECT_TRUE(visitors.isLookedAt("calibrations"));
    pass(1);
    EXPECT_FALSE(visitors.isLookedAt("calibrations"));
    visitors.takeLook(watcher.visitor, lookAt({"calibrations"}));
    EXPECT_TRUE(visitors.isLookedAt("calibrations"));
}

TEST_F(DeskPages, theConnectionsOfASessionThatEndsAreClosed) {
    visitors.sendAway("id of ben");
    EXPECT_FALSE(watcher.outbox.closed);
    EXPECT_EQ(crew.outbox.closed, kClosedUnpaired);
    watcher.visitor.holder.until = 1;  // a second of 1970
    visitors.everySecond();
    EXPECT_EQ(watcher.outbox.closed, kClosedUnpaired);
}

TEST_F(DeskPages, aPictureIsAskedForAtTheLargestWidthThatAPageWants) {
    visitors.takeLook(watcher.visitor, lookAt({}, {"left"}, 320));
    visitors.takeLook(crew.visitor, lookAt({}, {"left"}, 5000));
    pass(1);
    ASSERT_EQ(parts.nodes.pictures.size(), 1U) << "for both, and for no other channel";
    EXPECT_EQ(parts.nodes.pictures[0].channel, "left");
    EXPECT_EQ(parts.nodes.pictures[0].widthPixels, 960U) << "no page needs more";
    pass(9);
    EXPECT_EQ(parts.nodes.pictures.size(), 1U);
    pass(1);
    EXPECT_EQ(parts.nodes.pictures.size(), 2U) << "a second without an answer";
}

TEST_F(DeskPages, aPictureIsSentToThoseWhoLookInTheFormThatThePageReads) {
    visitors.takeLook(watcher.visitor, lookAt({}, {"middle"}));
    pass(1);
    visitors.heardPicture("middle", picture(parts.nodes.pictures.at(0).number));
    const std::string head{1, 0, 0, 0, 64, 1, '\xB4', 0, 2, 1, 0, 0, 0, 0, 0, 0};
    ASSERT_EQ(watcher.outbox.pictures.size(), 1U);
    EXPECT_EQ(watcher.outbox.pictures[0], head + "a jpeg");
    EXPECT_TRUE(crew.outbox.pictures.empty());
}

TEST_F(DeskPages, aPictureThatNobodyAskedForIsDropped) {
    visitors.takeLook(watcher.visitor, lookAt({}, {"left"}));
    pass(1);
    const std::uint64_t number = parts.nodes.pictures.at(0).number;
    visitors.heardPicture("left", picture(number + 1));
    visitors.heardPicture("right", picture(number));
    visitors.heardPicture("ceiling", picture(number));
    EXPECT_TRUE(watcher.outbox.pictures.empty());
}

TEST_F(DeskPages, aBrowserThatHasNotDrawnAPictureGetsTheNextAfterThreeSeconds) {
    visitors.takeLook(watcher.visitor, lookAt({}, {"left"}));
    pass(1);
    visitors.heardPicture("left", picture(parts.nodes.pictures.at(0).number));
    for (int second = 0; second < 2; ++second) {
        pass(10);
        visitors.takeLook(watcher.visitor, lookAt({}, {"left"}));
    }
    EXPECT_EQ(parts.nodes.pictures.size(), 1U);
    pass(10);
    EXPECT_EQ(parts.nodes.pictures.size(), 2U);
}

TEST_F(DeskPages, theFishAtAPlaceIsToldToTheOneWhoAsks) {
    visitors.askFish(watcher.visitor, place("left", 0.25F));
    ASSERT_EQ(parts.nodes.fish.size(), 1U);
    EXPECT_EQ(parts.nodes.fish[0].frame(), 9U);
    EXPECT_FLOAT_EQ(parts.nodes.fish[0].x(), 0.25F);
    v1::FishReply reply;
    reply.set_number(parts.nodes.fish[0].number());
    reply.set_frame(9);
    reply.set_fish(12);
    EXPECT_EQ(visitors.heardFish(reply), 12U);
    EXPECT_EQ(watcher.outbox.last("mind").mind().fish(), 12);
    EXPECT_EQ(crew.outbox.count("mind"), 0);
    EXPECT_FALSE(visitors.heardFish(reply)) << "said twice";
}

TEST_F(DeskPages, waterIsToldAsNoFish) {
    visitors.askFish(watcher.visitor, place("left", 0.25F));
    v1::FishReply reply;
    reply.set_number(parts.nodes.fish.at(0).number());
    EXPECT_FALSE(visitors.heardFish(reply));
    EXPECT_EQ(watcher.outbox.last("mind").mind().fish(), -1);
}

TEST_F(DeskPages, aPlaceOutsideOfAPictureIsAskedOfNobody) {
    for (const float x : {-0.1F, 1.1F, std::nanf("")})
        visitors.askFish(watcher.visitor, place("left", x));
    visitors.askFish(watcher.visitor, place("ceiling", 0.5F));
    EXPECT_TRUE(parts.nodes.fish.empty());
}

TEST_F(DeskPages, aFishIsToldToNobodyWhereThePageHasGone) {
    visitors.askFish(watcher.visitor, place("left", 0.25F));
    visitors.remove(watcher.visitor);
    v1::FishReply reply;
    reply.set_number(parts.nodes.fish.at(0).number());
    reply.set_fish(12);
    EXPECT_FALSE(visitors.heardFish(reply));
    EXPECT_EQ(watcher.outbox.count("mind"), 0);
}

TEST_F(DeskPages, ofManyQuestionsTheOldestIsForgotten) {
    for (int question = 0; question < 65; ++question)
        visitors.askFish(watcher.visitor, place("left", 0.5F));
    v1::FishReply reply;
    reply.set_fish(12);
    reply.set_number(parts.nodes.fish.at(0).number());
    EXPECT_FALSE(visitors.heardFish(reply));
    reply.set_number(parts.nodes.fish.at(1).number());
    EXPECT_TRUE(visitors.heardFish(reply));
}

TEST_F(DeskPages, aMindIsSentToThosePagesThatShowOne) {
    visitors.takeLook(crew.visitor, lookAt({"mind"}));
    v1::Explanation explanation;
    explanation.set_fish(5);
    explanation.set_tick(8);
    visitors.heardMind(explanation);
    EXPECT_EQ(crew.outbox.last("mind").mind().fish(), 5);
    EXPECT_EQ(watcher.outbox.count("mind"), 0);
}

}  // namespace
}  // namespace aquarama::console
