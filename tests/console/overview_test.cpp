// SPDX-License-Identifier: Apache-2.0
#include "console/overview.h"

#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "tests/console/parts.h"
#include "tests/support/state_packet.h"

namespace aquarama::console {
namespace {

constexpr const char* kBuild = "0.1.0 abc";

v1::StatusReply statusWith(v1::NodeCondition condition) {
    v1::StatusReply status;
    status.set_pace(v1::PACE_LIVE);
    status.set_frame(1'000'000'000'000);
    wire::Show show;
    show.scene = "reef";
    show.black = true;
    *status.mutable_show() = test::messageOf(show);
    v1::NodeStatus& node = *status.add_nodes();
    node.set_name("left");
    node.set_condition(condition);
    node.set_late(0);
    node.mutable_report()->set_build(kBuild);
    return status;
}

browser::Wall heardWall(v1::NodeCondition condition) {
    browser::Wall wall = wallOf(statusWith(condition), 7);
    wall.set_heard_s(100);
    return wall;
}

TEST(Overview, aWallInStepHasNoFaults) {
    EXPECT_TRUE(faultsOf(heardWall(v1::NODE_IN_STEP), kBuild, 101).empty());
}

TEST(Overview, aNodeThatIsNotInStepIsAFaultWithItsCause) {
    for (const auto condition : {v1::NODE_ABSENT, v1::NODE_PREPARING, v1::NODE_LATE}) {
        const auto faults = faultsOf(heardWall(condition), kBuild, 101);
        ASSERT_EQ(faults.size(), 1U);
        EXPECT_TRUE(faults[0].text.starts_with("node left is ")) << faults[0].text;
        EXPECT_GT(faults[0].text.size(), std::string("node left is preparing: ").size());
    }
}

TEST(Overview, aMasterThatIsSilentIsOneFaultWhateverItsNodesWere) {
    const auto faults = faultsOf(heardWall(v1::NODE_ABSENT), kBuild, 104);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].key, "master");
}

TEST(Overview, anotherBuildHotCardsAndOtherFishAreFaults) {
    v1::StatusReply status = statusWith(v1::NODE_IN_STEP);
    status.mutable_nodes(0)->mutable_report()->set_gpu_celsius(90);
    status.mutable_nodes(0)->set_hash_mismatches(1);
    browser::Wall wall = wallOf(status, 7);
    wall.set_heard_s(100);
    EXPECT_EQ(faultsOf(wall, "0.2.0 def", 101).size(), 3U);
}

TEST(Overview, theStatusIsPassedOnAsItCameWithACauseForEachNode) {
    v1::StatusReply status = statusWith(v1::NODE_IN_STEP);
    v1::NodeStatus& absent = *status.add_nodes();
    absent.set_name("right");
    absent.set_condition(v1::NODE_ABSENT);
    absent.set_machine("pit");
    const browser::Wall wall = wallOf(status, 7);
    EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(wall.status(), status));
    EXPECT_EQ(wall.run(), 7U);
    ASSERT_EQ(wall.causes_size(), 2);
    EXPECT_EQ(wall.causes(0), "");
    EXPECT_EQ(wall.causes(1), "nothing is heard of machine pit");
}

TEST(Overview, aWallIsInStepWhereTheMasterAnswersAndAllNodesAre) {
    browser::Wall wall = heardWall(v1::NODE_IN_STEP);
    EXPECT_TRUE(isInStep(wall));
    wall.set_heard(false);
    EXPECT_FALSE(isInStep(wall));
    for (const auto condition : {v1::NODE_ABSENT, v1::NODE_PREPARING, v1::NODE_LATE})
        EXPECT_FALSE(isInStep(heardWall(condition)));
}

TEST(Overview, numbersThatAreZeroAndLargeOnesReachTheBrowser) {
    browser::ToBrowser message;
    *message.mutable_wall() = heardWall(v1::NODE_IN_STEP);
    const std::string json = jsonOf(message);
    EXPECT_NE(json.find(R"("frame":"1000000000000")"), std::string::npos) << json;
    EXPECT_NE(json.find(R"("black":true)"), std::string::npos);
    EXPECT_NE(json.find(R"("late":"0")"), std::string::npos);
    EXPECT_NE(json.find(R"("condition":"NODE_IN_STEP")"), std::string::npos);
    EXPECT_NE(json.find(R"("causes":[""])"), std::string::npos);
}

TEST(Overview, aMasterThatPreparesIsNoFault) {
    browser::Wall wall;
    wall.set_heard(false);
    EXPECT_EQ(faultsOf(wall, kBuild, 100).size(), 1U) << "no show runs";
    wall.set_preparing("the master prepares: capturing 3 of 7 species, 20 %");
    EXPECT_TRUE(faultsOf(wall, kBuild, 100).empty());
    wall.set_preparing("");
    wall.set_heard_s(90);
    EXPECT_EQ(faultsOf(wall, kBuild, 100).size(), 1U) << "it has died";
}

TEST(Overview, whatABrowserMayNotSayIsRefused) {
    EXPECT_TRUE(readBrowser(R"({"command":{"id":"7","run":"1","order":{"show":{"black":true}}}})"));
    EXPECT_TRUE(readBrowser(R"({"alive":{}})"));
    const std::string deep(20'000, '[');
    for (const std::string& text :
         {std::string("{"),
          std::string("[]"),
          std::string(R"({"command":{"id":-1}})"),
          std::string(R"({"command":{"id":1e99}})"),
          std::string(R"({"nothing":1})"),
          std::string(R"({"command":{"order":{"show":{"quality":"BEST"}}}})"),
          std::string(R"({"command":{"runDoctor":true,"mind":1}})"),
          R"({"look":{"topics":)" + deep,
          std::string(70'000, ' ')})
        EXPECT_FALSE(readBrowser(text)) << text.substr(0, 60);
    std::string many = R"({"look":{"topics":["a")";
    for (int i = 0; i < 64; ++i) many += R"(,"a")";
    EXPECT_FALSE(readBrowser(many + "]}}"));
}

TEST(Overview, anOrderOfAProgramIsReadWholeOrRefused) {
    const auto order = readOrder(R"({"show":{"black":true,"brightness":0.5}})");
    ASSERT_TRUE(order);
    EXPECT_EQ(order->show().brightness(), 0.5);
    EXPECT_EQ(order->request(), 0U);
    for (const std::string& text : {std::string("{"),
                                    std::string("[]"),
                                    std::string(R"({"show":{"dark":true}})"),
                                    std::string(R"({"show":{"black":[]}})"),
                                    std::string(R"({"command":{}})"),
                                    std::string(70'000, ' ')})
        EXPECT_FALSE(readOrder(text)) << text.substr(0, 60);
}

// A value of a series, in ms; below 0 where nothing was heard.
double valueAt(const browser::Series& series, std::size_t i) {
    const auto byte = [&](std::size_t at) {
        return static_cast<unsigned char>(series.values()[2 * i + at]);
    };
    const int value = byte(0) + 256 * byte(1);
    return value == 65535 ? -1 : value / 100.0;
}

TEST(Overview, ringsKeepTenMinutesByTenthsOfASecondAndADayByTheLargestOfEachMinute) {
    FigureRings rings;
    browser::Wall wall = heardWall(v1::NODE_IN_STEP);
    for (int tenth = 1; tenth <= 1500 * 600; ++tenth) {
        const int minute = tenth / 600;
        wall.mutable_status()->set_frame_peak_ms(
            static_cast<float>(tenth % 600 == 300 ? 2 + minute % 500 : 1));
        rings.add(wall);
    }
    const browser::History history = rings.history();
    EXPECT_EQ(history.tenths(), 900'000U);
    EXPECT_EQ(history.minutes(), 1500U);
    ASSERT_EQ(history.ten_minutes_size(), 3);  // frame, node left, skew
    EXPECT_EQ(history.ten_minutes(0).values().size(), 2 * 6000U);
    ASSERT_EQ(history.day(0).values().size(), 2 * 1440U);
    EXPECT_EQ(valueAt(history.day(0), 1439), 2 + 1499 % 500);
    EXPECT_EQ(valueAt(history.ten_minutes(0), 5999), 1);
}

TEST(Overview, aMasterThatIsSilentLeavesPlacesEmptyAndTheLastSecondIsTheEndOfAll) {
    FigureRings rings;
    browser::Wall wall = heardWall(v1::NODE_IN_STEP);
    wall.mutable_status()->set_frame_peak_ms(700);  // more than fits
    for (int tenth = 0; tenth < 50; ++tenth) rings.add(wall);
    wall.set_heard(false);
    for (int tenth = 0; tenth < 7; ++tenth) rings.add(wall);
    const browser::Series all = rings.history().ten_minutes(0);
    const browser::Series last = rings.lastSecond().ten_minutes(0);
    EXPECT_EQ(valueAt(all, 49), 655.34);
    EXPECT_EQ(valueAt(all, 50), -1);
    ASSERT_GE(last.values().size(), 2 * 10U);
    EXPECT_EQ(all.values().substr(all.values().size() - last.values().size()), last.values());
}

TEST(Overview, whatChangesIsSaidInWords) {
    browser::Wall before = heardWall(v1::NODE_IN_STEP);
    browser::Wall after = heardWall(v1::NODE_LATE);
    after.mutable_status()->mutable_show()->set_black(false);
    EXPECT_EQ(changesOf(before, after),
              (std::vector<std::string>{"light again", "node left is late"}));
    EXPECT_TRUE(changesOf(before, before).empty());
    before = after;
    after.mutable_status()->set_day(v1::WantedShow::DUSK);
    EXPECT_EQ(changesOf(before, after), std::vector<std::string>{"day dusk"});
}

v1::JournalStatus& journalOf(browser::Wall& wall) {
    return *wall.mutable_status()->mutable_journal();
}

// A show that is recorded keeps no journal on purpose.
TEST(Overview, aJournalThatIsNotWrittenIsAFaultWithItsReason) {
    browser::Wall wall = heardWall(v1::NODE_IN_STEP);
    journalOf(wall).set_condition(v1::JournalStatus::WRITTEN);
    EXPECT_TRUE(faultsOf(wall, kBuild, 101).empty());
    journalOf(wall).set_condition(v1::JournalStatus::NOT_KEPT);
    EXPECT_TRUE(faultsOf(wall, kBuild, 101).empty());
    journalOf(wall).set_reason("no space left");
    for (const auto condition :
         {v1::JournalStatus::WAITING, v1::JournalStatus::PAUSED, v1::JournalStatus::REFUSED}) {
        journalOf(wall).set_condition(condition);
        const auto faults = faultsOf(wall, kBuild, 101);
        ASSERT_EQ(faults.size(), 1U);
        EXPECT_EQ(faults[0].key, "journal");
        EXPECT_TRUE(faults[0].text.ends_with("no space left")) << faults[0].text;
    }
}

TEST(Overview, aWorldThatGoesOnAndInputsThatTheDiskDidNotHaveAreSaid) {
    const browser::Wall before = heardWall(v1::NODE_IN_STEP);
    browser::Wall after = wallOf(statusWith(v1::NODE_IN_STEP), 8);
    journalOf(after).set_went_on_tick(900);
    journalOf(after).set_away_s(2);
    EXPECT_EQ(changesOf(before, after),
              (std::vector<std::string>{"the show has begun: scene reef",
                                        "the world goes on from 0:00:15, away for 2 s"}));
    EXPECT_TRUE(changesOf(after, after).empty());
    browser::Wall late = after;
    journalOf(late).set_late_inputs(3);
    journalOf(late).set_late_spells(1);
    EXPECT_EQ(changesOf(after, late),
              std::vector<std::string>{"what visitors do takes effect before the journal's disk "
                                       "has it: 3 inputs so far"});
    browser::Wall later = late;
    journalOf(later).set_late_inputs(60);
    EXPECT_TRUE(changesOf(late, later).empty()) << "once a minute at most";
}

TEST(Overview, thatNobodyWouldTakeOverIsAFaultAndEachChangeOfMasterIsSaid) {
    browser::Wall wall = heardWall(v1::NODE_IN_STEP);
    EXPECT_TRUE(faultsOf(wall, kBuild, 101).empty()) << "the rig has no standby";
    v1::StandbyStatus& standby = *wall.mutable_status()->mutable_standby();
    standby.set_master("main");
    const auto faults = faultsOf(wall, kBuild, 101);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].key, "standby");
    browser::Wall after = wall;
    after.mutable_status()->mutable_standby()->set_machine("spare");
    EXPECT_TRUE(faultsOf(after, kBuild, 101).empty());
    EXPECT_EQ(changesOf(wall, after), std::vector<std::string>{"machine spare simulates along"});
    EXPECT_EQ(changesOf(after, wall),
              std::vector<std::string>{"machine spare is no standby any more"});
    browser::Wall takenOver = wallOf(statusWith(v1::NODE_IN_STEP), 8);
    takenOver.mutable_status()->mutable_standby()->set_master("spare");
    EXPECT_EQ(changesOf(after, takenOver),
              (std::vector<std::string>{"the show has begun: scene reef",
                                        "machine spare is the master"}));
}

// A wall with faders at these shares of 255.
browser::Wall wallAt(std::uint32_t brightness, std::uint32_t colour, const char* scene = "reef") {
    browser::Wall wall = heardWall(v1::NODE_IN_STEP);
    wall.set_heard(true);
    v1::Show& show = *wall.mutable_status()->mutable_show();
    show.set_black(false);
    show.set_brightness(brightness);
    show.set_colour_returned(colour);
    show.set_scene(scene);
    return wall;
}

TEST(Overview, aFaderIsToldOnceItRests) {
    FaderWatch faders;
    double now = 100;
    const auto told = [&](const browser::Wall& wall, int tenths) {
        std::string lines;
        for (int tenth = 0; tenth < tenths; ++tenth, now += 0.1)
            for (const std::string& line : faders.update(wall, now)) lines += line + "; ";
        return lines;
    };
    EXPECT_EQ(told(wallAt(255, 100), 30), "") << "as it was found";
    for (std::uint32_t value = 100; value <= 204; ++value)
        EXPECT_EQ(told(wallAt(255, value), 1), "") << "it moves";
    EXPECT_EQ(told(wallAt(255, 204), 30), "colour 0.80; ");
    EXPECT_EQ(told(wallAt(51, 204), 30), "brightness 0.20; ");
    browser::Wall black = wallAt(0, 204);
    black.mutable_status()->mutable_show()->set_black(true);
    EXPECT_EQ(told(black, 30), "") << "black is no fader";
    EXPECT_EQ(told(wallAt(30, 204), 2), "");
    EXPECT_EQ(told(wallAt(51, 204), 30), "") << "nor is light again";
    browser::Wall fading = wallAt(0, 204);
    fading.mutable_status()->set_change("the world of scene bait_ball is being made");
    EXPECT_EQ(told(fading, 30), "") << "nor is the way to another scene";
    EXPECT_EQ(told(wallAt(51, 90, "bait_ball"), 30), "") << "which has a colour of its own";
    EXPECT_EQ(told(wallAt(255, 90, "bait_ball"), 30), "brightness 1.00; ");
}

TEST(Overview, ofAProjectorWhatIsKnownToBeWrongIsAFault) {
    const auto faultOf = [](const std::string& reach, const std::string& power, bool wanted) {
        browser::ProjectorList list = test::projectorWith(reach, power);
        list.mutable_projectors(0)->set_wanted_power(wanted);
        const auto faults = faultsOf(list);
        return faults.empty() ? "" : faults[0].text.substr(0, faults[0].text.find(':'));
    };
    EXPECT_EQ(faultOf("answers", "on", true), "");
    EXPECT_EQ(faultOf("answers", "off", true), "projector left is off, and should be on");
    EXPECT_EQ(faultOf("answers", "on", false), "projector left is on, and should be off");
    EXPECT_EQ(faultOf("answers", "unknown", true), "");
    EXPECT_EQ(faultOf("answers", "unknown", false), "") << "unknown is neither";
    EXPECT_EQ(faultOf("not asked yet", "unknown", true), "");
    EXPECT_EQ(faultOf("no answer", "unknown", true), "projector left does not answer");
    EXPECT_EQ(faultOf("refuses the password", "unknown", true),
              "projector left refuses the password");
    EXPECT_EQ(faultOf("wants a password", "unknown", true), "projector left wants a password");
    browser::ProjectorList broken = test::projectorWith("answers", "on");
    broken.mutable_projectors(0)->add_problems("lamp: error");
    EXPECT_EQ(faultsOf(broken).at(0).text, "projector left: lamp: error");
}

TEST(Overview, whatProjectorsComeToIsToldOnceItHolds) {
    ProjectorBook book;
    const auto told = [&](const browser::ProjectorList& list, double from, double to) {
        std::string lines;
        for (double now = from; now < to; ++now)
            for (const auto& [who, what] : book.update(list, now))
                lines += who + ": " + what + "; ";
        return lines;
    };
    EXPECT_EQ(told(test::projectorWith("not asked yet", "unknown"), 0, 100), "");
    EXPECT_EQ(told(test::projectorWith("answers", "off"), 100, 200), "projector left: power off; ");
    EXPECT_EQ(told(test::projectorWith("answers", "unknown"), 200, 210), "") << "for a moment";
    EXPECT_EQ(told(test::projectorWith("answers", "off"), 210, 300), "");
    EXPECT_EQ(told(test::projectorWith("answers", "unknown"), 300, 400),
              "projector left: power unknown; ");
    browser::ProjectorList lit = test::projectorWith("answers", "on");
    EXPECT_EQ(told(lit, 400, 500), "projector left: power on, shutter unknown; ");
    lit.mutable_projectors(0)->set_shut(true);
    EXPECT_EQ(told(lit, 500, 600), "projector left: power on, shut; ");
    EXPECT_EQ(told(test::projectorWith("no answer", "unknown"), 600, 700),
              "projector left: no answer; ");
}

}  // namespace
}  // namespace aquarama::console
