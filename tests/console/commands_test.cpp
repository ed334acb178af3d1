// SPDX-License-Identifier: Apache-2.0
#include "console/commands.h"

#include <functional>
#include <future>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/console/parts.h"
#include "tests/support/await.h"

namespace aquarama::console {
namespace {

using ask::Outcome;
using browser::Command;
using test::Page;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Reply = v1::OrderReply;

const std::string kVersion = "2026-11-25T210301";

// A command of this number for the run that is heard.
Command command(std::uint64_t id, const std::function<void(Command&)>& what) {
    Command command;
    command.set_id(id);
    command.set_run(test::kRun);
    what(command);
    return command;
}

Command black(std::uint64_t id) {
    return command(id, [](Command& of) { of.mutable_order()->mutable_show()->set_black(true); });
}

Command scan(std::uint64_t id, const std::string& kind) {
    return command(id, [&](Command& of) { of.mutable_scan()->set_kind(kind); });
}

Command useCalibration(std::uint64_t id, const std::string& name) {
    return command(id, [&](Command& of) { of.set_use_calibration(name); });
}

Command assign(std::uint64_t id, const std::string& letter, const std::string& channel) {
    return command(id, [&](Command& of) {
        of.mutable_assign()->set_letter(letter);
        of.mutable_assign()->set_channel(channel);
        of.mutable_assign()->set_code("K7M4-QD9X");
    });
}

Command picture(std::uint64_t id, const std::string& bytes) {
    return command(id, [&](Command& of) {
        of.mutable_picture()->set_picture(bytes);
        of.mutable_picture()->set_aside(-1);
    });
}

Command decide(std::uint64_t id, std::uint32_t number, v1::Moderation::Verdict verdict) {
    return command(id, [&](Command& of) {
        of.mutable_order()->mutable_moderation()->set_number(number);
        of.mutable_order()->mutable_moderation()->set_verdict(verdict);
    });
}

// Commands of a desk whose master is heard, and whose errands never end before the test.
class DeskCommands : public testing::Test {
  protected:
    DeskCommands() {
        commands.reach(&master);
        parts.hearWall();
        for (Page* page : {&watcher, &operating, &crew}) parts.visitors.add(page->visitor);
    }
    ~DeskCommands() override { end.set_value(); }
    Reply give(Page& page, const Command& command) {
        return commands.carryOut(page.visitor.holder, &page.visitor, command);
    }
    // The page shows calibrations, and with them patterns of a scan.
    void look(Page& page) {
        browser::Look look;
        look.add_topics("calibrations");
        parts.visitors.takeLook(page.visitor, look);
    }
    // Hours that want the wall open at all times.
    void setHours() {
        parts.state.opening.setText(
            "zone: \"Europe/Berlin\"\nopen { days: [MONDAY, TUESDAY, WEDNESDAY, THURSDAY, FRIDAY, "
            "SATURDAY, SUNDAY] from: \"00:00\" to: \"24:00\" scene: \"reef\" }\n");
    }

    std::promise<void> end;
    std::shared_future<void> ended = end.get_future().share();
    test::ConsoleParts parts;
    test::ToldMaster master;
    Page watcher{ConsoleRole::Watcher, "wim"}, operating{ConsoleRole::Operator, "olga"},
        crew{ConsoleRole::Crew, "carl"};
    Errands errands{
        parts.state,
        {.askDoctor =
             [ended = ended](const std::string&) {
                 ended.wait_for(test::kPatience);
                 return browser::DoctorReport();
             },
         .calibrationsOf = {},
         .useCalibration =
             [ended = ended](const std::string&, const std::string&) {
                 ended.wait_for(test::kPatience);
                 return std::string();
             },
         .assignNode =
             [ended = ended](const Assignment&) {
                 ended.wait_for(test::kPatience);
                 return std::string();
             },
         .releasesOf = {},
         .changeRelease = [](const std::string&, const std::string&) { return std::string(); },
         .tourOf = {},
         .confirmStep = [](const std::string&,
                           const std::string&,
                           const std::string&) { return std::string(); }}};
    Commands commands{parts.state, parts.visitors, errands};
};

TEST_F(DeskCommands, eachNeedsItsRole) {
    const std::map<std::string, std::vector<std::function<void(Command&)>>> kinds{
        {"watcher",
         {[](Command& of) { of.set_run_doctor(true); },
          [](Command& of) { of.mutable_point_at(); },
          [](Command& of) { of.set_mind(3); }}},
        {"operator",
         {[](Command& of) { of.set_acknowledge("clock"); },
          [](Command& of) { of.set_hold_hours(1); },
          [](Command& of) { of.mutable_scan(); },
          [](Command& of) { of.mutable_picture(); },
          [](Command& of) {
              of.mutable_order()->mutable_moderation()->set_verdict(v1::Moderation::TAKE_DOWN);
          },
          [](Command& of) { of.mutable_order()->mutable_show()->set_black(true); },
          [](Command& of) { of.mutable_order()->mutable_restart()->set_channel("left"); }}},
        {"crew",
         {[](Command& of) { of.set_hours_text(""); },
          [](Command& of) { of.set_new_code(browser::WATCHER); },
          [](Command& of) { of.set_revoke("id of nobody"); },
          [](Command& of) { of.mutable_projector()->set_name("nobody"); },
          [](Command& of) { of.set_use_calibration(kVersion); },
          [](Command& of) { of.set_power("no word"); },
          [](Command& of) { of.mutable_assign(); },
          [](Command& of) { of.set_release("forward"); },
          [](Command& of) { of.mutable_confirm_step(); },
          [](Command& of) { of.mutable_order()->mutable_power()->set_channel("left"); }}}};
    std::uint64_t id = 0;
    for (const auto& [least, all] : kinds)
        for (const auto& what : all)
            for (Page* page : {&watcher, &operating, &crew}) {
                const bool isAllowed = page->visitor.holder.role >= *roleNamed(least);
                const Command given = command(++id, what);
                const std::string reason = give(*page, given).reason();
                EXPECT_EQ(reason != "only " + least + " may do this", isAllowed)
                    << given.DebugString() << reason;
            }
    EXPECT_EQ(parts.state.refused, 7U + 2 * 10U) << "in the foot of every page";
    EXPECT_THAT(parts.events(), Contains("wim: refused: it needs crew"));
}

TEST_F(DeskCommands, aNodeThatWaitsIsGivenAChannelAndTheCodeIsToldToNobody) {
    EXPECT_EQ(give(crew, assign(1, "B", "left")).reason(), "no node of this letter waits any more");
    parts.state.waiting = {{"B", "tcp://192.168.7.3:41234", std::string(40, 'n')}};
    EXPECT_EQ(give(crew, assign(2, "B", "nowhere")).reason(), "there is no such channel");
    EXPECT_EQ(give(crew, assign(3, "B", "left")).outcome(), Reply::WAITING);
    EXPECT_THAT(give(crew, assign(4, "B", "right")).reason(), HasSubstr("say it again"));
    commands.said(3, {});
    EXPECT_THAT(parts.events(), Contains("carl: node B gets the channel left"));
    for (const std::string& event : parts.events()) EXPECT_THAT(event, Not(HasSubstr("K7M4")));
}

TEST_F(DeskCommands, theDepotIsToldGoOrBackAndNothingElse) {
    const auto say = [&](std::uint64_t id, const std::string& word) {
        return give(crew, command(id, [&](Command& of) { of.set_release(word); }));
    };
    EXPECT_THAT(say(1, "--help").reason(), HasSubstr("\"go\" and \"back\" only"));
    EXPECT_EQ(say(2, "go").outcome(), Reply::WAITING);
    commands.said(2, {ask::Outcome::Refused, "not all machines have it"});
    EXPECT_THAT(parts.events(), Contains("carl: release: go, refused: not all machines have it"));
}

TEST_F(DeskCommands, aStepOfTheTourIsConfirmedAsItWasFound) {
    const auto confirm = [&](std::uint64_t id, const std::string& found) {
        return give(crew, command(id, [&](Command& of) {
                        of.mutable_confirm_step()->set_name("screen");
                        of.mutable_confirm_step()->set_found(found);
                    }));
    };
    EXPECT_THAT(confirm(1, "flat").reason(), HasSubstr("look again")) << "nobody has looked yet";
    browser::TourStep& step = *parts.state.tour.emplace().add_steps();
    step.set_name("screen");
    step.set_found("flat");
    EXPECT_THAT(confirm(2, "dome").reason(), HasSubstr("look again"));
    EXPECT_EQ(confirm(3, "flat").outcome(), Reply::WAITING);
    commands.said(3, {});
    EXPECT_THAT(parts.events(), Contains("carl: tour: screen is right"));
}

TEST_F(DeskCommands, whatIsNoCommandIsRefused) {
    EXPECT_THAT(give(crew, command(1, [](Command&) {})).reason(), HasSubstr("no command"));
    EXPECT_THAT(give(crew, black(0)).reason(), HasSubstr("no command"));
    EXPECT_EQ(give(crew, black(1)).outcome(), Reply::WAITING) << "its number is still free";
    EXPECT_EQ(parts.state.refused, 2U);
}

TEST_F(DeskCommands, stepsOfAFaderAreNoEventsUnlessTheyAreRefused) {
    const Holder desk{.id = {}, .hash = {}, .name = "OSC", .role = ConsoleRole::Operator};
    const auto dim = [](Command& of) { of.mutable_order()->mutable_show()->set_brightness(0.5); };
    for (const std::uint64_t id : {1, 2})
        static_cast<void>(commands.carryOut(desk, nullptr, command(id, dim)));
    static_cast<void>(commands.carryOut(desk, nullptr, black(3)));
    commands.said(1, {});
    commands.said(2, {Outcome::Refused, "a scan holds the wall"});
    commands.said(3, {});
    EXPECT_THAT(
        parts.events(),
        ElementsAre("OSC: black on", "OSC: brightness 0.50, refused: a scan holds the wall"));
    give(operating, command(4, dim));
    commands.said(4, {});
    EXPECT_EQ(parts.events().front(), "olga: brightness 0.50") << "people see what they did";
}

TEST_F(DeskCommands, anOrderIsGivenToTheMasterOnce) {
    EXPECT_EQ(give(operating, black(7)).outcome(), Reply::WAITING);
    EXPECT_EQ(give(operating, black(7)).outcome(), Reply::WAITING) << "said again";
    ASSERT_EQ(master.orders.size(), 1U);
    EXPECT_EQ(master.orders[0].request(), 7U);
    EXPECT_EQ(master.orders[0].run(), test::kRun);
    EXPECT_TRUE(master.orders[0].show().black());
    EXPECT_TRUE(parts.events().empty()) << "nothing has come of it yet";
}

TEST_F(DeskCommands, noOrderIsGivenToAMasterThatIsSilentOrAnother) {
    Command other = black(1);
    other.set_run(test::kRun + 1);
    EXPECT_THAT(give(operating, other).reason(), HasSubstr("the show was started again"));
    parts.state.wall.set_heard(false);
    EXPECT_EQ(give(operating, black(2)).reason(), "the master does not answer");
    EXPECT_TRUE(master.orders.empty());
}

// The wire has bounds; what a browser sends is held against them before it is passed on.
TEST_F(DeskCommands, anOrderThatIsNotWholeIsNotPassedOn) {
    const std::vector<std::function<void(Command&)>> wrong{
        [](Command& of) { of.mutable_order(); },
        [](Command& of) { of.mutable_order()->mutable_scan()->set_holder(5); },
        [](Command& of) {
            of.mutable_order()->mutable_show()->set_scene(std::string(10'000, 'x'));
        }};
    std::uint64_t id = 0;
    for (const auto& what : wrong)
        EXPECT_EQ(give(operating, command(++id, what)).reason(), "there is nothing of that name");
    EXPECT_TRUE(master.orders.empty());
}

TEST_F(DeskCommands, thePageIsToldWhatBecameOfItsOrder) {
    give(operating, black(7));
    commands.said(7, {Outcome::Waiting, "prepared by all nodes but left"});
    commands.said(7, {Outcome::Waiting, "prepared by all nodes but left"});
    EXPECT_EQ(operating.outbox.count("done 7"), 1) << "what is new";
    commands.said(7, {});
    EXPECT_EQ(operating.outbox.last("done 7").done().outcome(), Reply::DONE);
    EXPECT_EQ(give(operating, black(7)).outcome(), Reply::DONE);
    EXPECT_THAT(parts.events(), ElementsAre("olga: black on"));
    give(operating, black(8));
    commands.said(8, {Outcome::Refused, "a scan holds the wall"});
    EXPECT_EQ(parts.events().front(), "olga: black on, refused: a scan holds the wall");
    EXPECT_EQ(crew.outbox.count("done 7"), 0);
}

TEST_F(DeskCommands, anOrderOfAPageThatHasGoneIsAnEventAllTheSame) {
    give(operating, black(7));
    commands.forget(operating.visitor);
    commands.said(7, {});
    EXPECT_EQ(operating.outbox.count("done 7"), 0);
    EXPECT_THAT(parts.events(), ElementsAre("olga: black on"));
}

TEST_F(DeskCommands, aScanIsSaidAgainAsLongAsItsPageIsOpen) {
    look(operating);
    EXPECT_EQ(give(operating, scan(7, "white")).outcome(), Reply::WAITING);
    EXPECT_TRUE(operating.visitor.holdsScan);
    commands.keepScan();
    ASSERT_EQ(master.orders.size(), 2U);
    EXPECT_NE(master.orders[1].request(), 7U) << "nobody asks how that went";
    EXPECT_EQ(master.orders[1].scan().SerializeAsString(),
              master.orders[0].scan().SerializeAsString());
    for (int tick = 0; tick < 30; ++tick) parts.visitors.tick();
    commands.keepScan();
    EXPECT_EQ(master.orders.size(), 2U) << "the page is not shown any more";
    EXPECT_FALSE(operating.visitor.holdsScan);
}

TEST_F(DeskCommands, aScanEndsByItsPageByTheMasterOrWhenThePageGoes) {
    look(operating);
    const std::vector<std::function<void(std::uint64_t id)>> ways{
        [&](std::uint64_t id) { give(operating, scan(id + 1, "")); },
        [&](std::uint64_t id) {
            commands.said(id, {Outcome::Refused, "the wall is set black"});
        },
        [&](std::uint64_t) { commands.forget(operating.visitor); }};
    for (std::size_t way = 0; way < ways.size(); ++way) {
        const std::uint64_t id = 10 * (way + 1);
        EXPECT_EQ(give(operating, scan(id, "rows")).outcome(), Reply::WAITING);
        commands.keepScan();
        ways[way](id);
        const std::size_t before = master.orders.size();
        commands.keepScan();
        EXPECT_EQ(master.orders.size(), before) << way;
    }
}

TEST_F(DeskCommands, aScanNeedsAPageAndAPattern) {
    look(operating);
    EXPECT_EQ(commands.carryOut(crew.visitor.holder, nullptr, scan(1, "white")).outcome(),
              Reply::REFUSED);
    EXPECT_EQ(give(operating, scan(2, "plaid")).outcome(), Reply::REFUSED);
    EXPECT_EQ(give(operating,
                   command(3,
                           [](Command& of) {
                               of.mutable_scan()->set_kind("rows");
                               of.mutable_scan()->set_step(16);
                           }))
                  .outcome(),
              Reply::REFUSED);
    EXPECT_EQ(give(operating,
                   command(4,
                           [](Command& of) {
                               of.mutable_scan()->set_kind("rows");
                               of.mutable_scan()->set_channel("ceiling");
                           }))
                  .outcome(),
              Reply::REFUSED);
    EXPECT_TRUE(master.orders.empty());
}

TEST_F(DeskCommands, whatTheHoursWantIsOrderedUntilItIsAnswered) {
    setHours();
    commands.keepHours();
    commands.keepHours();
    ASSERT_EQ(master.orders.size(), 1U) << "its end is waited for";
    EXPECT_EQ(master.orders[0].show().scene(), "reef");
    EXPECT_FALSE(master.orders[0].show().black());
    commands.said(master.orders[0].request(), {Outcome::Lost, ""});
    commands.keepHours();
    ASSERT_EQ(master.orders.size(), 2U) << "it did not arrive";
    EXPECT_TRUE(parts.events().empty());
    commands.said(master.orders[1].request(), {});
    commands.keepHours();
    EXPECT_EQ(master.orders.size(), 2U);
    EXPECT_THAT(parts.events(), ElementsAre("schedule: opened reef"));
}

TEST_F(DeskCommands, whatTheMasterRefusesTheHoursIsNotSaidAgain) {
    setHours();
    commands.keepHours();
    commands.said(master.orders.at(0).request(), {Outcome::Refused, "no such scene"});
    commands.keepHours();
    EXPECT_EQ(master.orders.size(), 1U);
    EXPECT_THAT(parts.events(), ElementsAre("schedule: opened reef, refused: no such scene"));
}

TEST_F(DeskCommands, theHoursRestByAWrongClockAndWithoutAMaster) {
    setHours();
    parts.state.wall.set_heard(false);
    commands.keepHours();
    EXPECT_TRUE(master.orders.empty());
    parts.hearWall();
    parts.state.doubtOfClock = "the clock is before the date of this program";
    commands.keepHours();
    EXPECT_TRUE(master.orders.empty());
    parts.state.doubtOfClock.clear();
    commands.keepHours();
    EXPECT_EQ(master.orders.size(), 1U);
}

// A desk of a rig with drawings, whose pictures are read when the test says so.
class DrawnCommands : public DeskCommands {
  protected:
    DrawnCommands() {
        parts.state.wall.mutable_status()->set_drawings_version(1);
        parts.state.wall.mutable_status()->set_drawings(true);
        commands.readBy([this](const std::string& bytes, auto done) {
            if (isFull) return false;
            reading[bytes] = done;
            return true;
        });
    }
    bool isFull = false;
    std::map<std::string, std::function<void(const ask::DrawingOutcome&)>> reading;
};

TEST_F(DrawnCommands, aPictureIsReadAndItsDrawingOffered) {
    EXPECT_EQ(give(operating, picture(7, "jpeg")).outcome(), Reply::WAITING);
    EXPECT_EQ(give(operating, picture(7, "jpeg")).outcome(), Reply::WAITING) << "said again";
    EXPECT_TRUE(master.orders.empty()) << "it is being read";
    reading.at("jpeg")(ask::ReadDrawing{.species = "clownfish", .skin = "png"});
    ASSERT_EQ(master.orders.size(), 1U);
    EXPECT_EQ(master.orders[0].request(), 7U);
    EXPECT_EQ(master.orders[0].drawing().species(), "clownfish");
    EXPECT_EQ(master.orders[0].drawing().skin(), "png");
    EXPECT_EQ(master.orders[0].drawing().aside(), -1);
    commands.said(7, {Outcome::Done, "drawing 12"});
    EXPECT_EQ(operating.outbox.last("done 7").done().reason(), "drawing 12");
    EXPECT_THAT(parts.events(), ElementsAre("olga: picture of a sheet: drawing 12"));
    EXPECT_EQ(commands.answerTo(7)->outcome, Outcome::Done);
}

TEST_F(DrawnCommands, aPictureOfNoSheetIsRefusedWithItsReason) {
    Command given = picture(7, "jpeg");
    given.mutable_picture()->set_name("scan\n1.jpg");
    static_cast<void>(commands.carryOut(operating.visitor.holder, nullptr, given));
    reading.at("jpeg")(ask::DrawingRefused{"no_sheet"});
    EXPECT_TRUE(master.orders.empty());
    const Reply told = operating.outbox.last("done 7").done();
    EXPECT_EQ(told.outcome(), Reply::REFUSED) << "a page of the same session is told";
    EXPECT_EQ(told.reason(), "no sheet is in the picture");
    EXPECT_EQ(crew.outbox.count("done 7"), 0);
    ASSERT_EQ(parts.events().size(), 1U);
    EXPECT_EQ(parts.events()[0].find('\n'), std::string::npos);
    EXPECT_THAT(parts.events()[0], HasSubstr(", refused: no sheet is in the picture"));
}

TEST_F(DrawnCommands, aSkinThatIsTooLargeIsNotPassedOn) {
    give(operating, picture(7, "jpeg"));
    reading.at("jpeg")(ask::ReadDrawing{.species = "clownfish",
                                        .skin = std::string(wire::kMostSkinBytes + 1, 'x')});
    EXPECT_TRUE(master.orders.empty());
    EXPECT_EQ(operating.outbox.last("done 7").done().reason(), "the drawing is too large");
}

TEST_F(DrawnCommands, noPictureIsReadInVain) {
    auto why = [&, id = std::uint64_t{0}]() mutable {
        return give(operating, picture(++id, "jpeg")).reason();
    };
    isFull = true;
    EXPECT_THAT(why(), HasSubstr("too many pictures wait"));
    isFull = false;
    v1::DrawingsReply many;
    for (int i = 0; i < wire::kMostDrawings; ++i) many.add_drawings()->set_number(i + 1);
    parts.state.drawings.hear(many);
    EXPECT_THAT(why(), HasSubstr("no room"));
    parts.state.drawings.clear();
    parts.state.wall.mutable_status()->set_drawings(false);
    EXPECT_THAT(why(), HasSubstr("drawings are off"));
    parts.state.wall.mutable_status()->clear_drawings_version();
    EXPECT_EQ(why(), "the rig has no drawings");
    parts.state.wall.set_heard(false);
    EXPECT_EQ(why(), "the master does not answer");
    commands.readBy({});
    EXPECT_THAT(why(), HasSubstr("is not installed"));
    EXPECT_TRUE(reading.empty());
}

TEST_F(DrawnCommands, aVerdictIsAnEvent) {
    give(operating, decide(1, 12, v1::Moderation::LET_IN));
    give(operating, decide(2, 0, v1::Moderation::END_DAY));
    commands.said(1, {});
    commands.said(2, {Outcome::Refused, "the rig has no drawings"});
    EXPECT_THAT(parts.events(),
                ElementsAre("olga: the day of drawings ended, refused: the rig has no drawings",
                            "olga: drawing 12 let in"));
}

// The hours close the wall, and the day of drawings ends once, whatever is lost meanwhile.
TEST_F(DrawnCommands, theDayEndsOnceWhenTheHoursCloseTheWall) {
    setHours();
    commands.keepHours();
    commands.said(master.orders.at(0).request(), {});
    commands.keepDay();
    EXPECT_EQ(master.orders.size(), 1U) << "the wall is open";
    parts.state.opening.setText("zone: \"UTC\"\n");  // closed at all times
    commands.keepHours();
    commands.keepDay();
    ASSERT_EQ(master.orders.size(), 2U);
    EXPECT_TRUE(master.orders[1].show().black()) << "black first";
    commands.said(master.orders[1].request(), {});
    for (int second = 0; second < 3; ++second) commands.keepDay();
    ASSERT_EQ(master.orders.size(), 3U);
    EXPECT_EQ(master.orders[2].moderation().verdict(), v1::Moderation::END_DAY);
    EXPECT_EQ(master.orders[2].moderation().number(), 0U);
    commands.said(master.orders[2].request(), {Outcome::Lost, ""});
    commands.keepDay();
    ASSERT_EQ(master.orders.size(), 4U) << "it did not arrive";
    commands.said(master.orders[3].request(), {});
    for (int second = 0; second < 3; ++second) {
        commands.keepHours();
        commands.keepDay();
    }
    EXPECT_EQ(master.orders.size(), 4U);
    EXPECT_THAT(parts.events().front(), HasSubstr("schedule: the drawings of the day"));
    EXPECT_EQ(parts.events().size(), 3U) << "opened, closed, the day ended";
}

TEST_F(DrawnCommands, whereThereAreNoDrawingsNoDayEnds) {
    setHours();
    commands.keepHours();
    commands.said(master.orders.at(0).request(), {});
    parts.state.opening.setText("zone: \"UTC\"\n");
    commands.keepHours();
    commands.said(master.orders.at(1).request(), {});
    parts.state.wall.mutable_status()->clear_drawings_version();
    commands.keepDay();
    EXPECT_EQ(master.orders.size(), 2U);
    EXPECT_FALSE(parts.state.opening.isDayToEnd());
}

TEST_F(DeskCommands, oneCalibrationAtATimeIsPutInPlace) {
    EXPECT_EQ(give(crew, useCalibration(1, "--help")).outcome(), Reply::REFUSED);
    EXPECT_EQ(give(crew, useCalibration(2, "../hall.mpcdi")).outcome(), Reply::REFUSED);
    EXPECT_EQ(give(crew, useCalibration(3, kVersion)).outcome(), Reply::WAITING);
    EXPECT_THAT(give(crew, useCalibration(4, kVersion)).reason(), HasSubstr("say it again"));
    commands.said(3, {Outcome::Refused, "it fits no channel"});
    EXPECT_EQ(crew.outbox.last("done 3").done().reason(), "it fits no channel");
    EXPECT_THAT(parts.events(),
                ElementsAre("carl: calibration " + kVersion + ", refused: it fits no channel"));
}

TEST_F(DeskCommands, aMindIsAskedOfTheMaster) {
    EXPECT_EQ(give(watcher, command(1, [](Command& of) { of.set_mind(12); })).outcome(),
              Reply::DONE);
    EXPECT_THAT(master.fish, ElementsAre(12U));
}

TEST_F(DeskCommands, theConsolesMachineIsSwitchedWhereItTakesTheWord) {
    const auto reboot = [](Command& of) { of.set_power("reboot"); };
    EXPECT_EQ(give(crew, command(1, reboot)).outcome(), Reply::REFUSED);
    EXPECT_TRUE(parts.events().empty());
    std::filesystem::create_directories(parts.powerFolder());
    EXPECT_EQ(give(crew, command(2, reboot)).outcome(), Reply::DONE);
    EXPECT_FALSE(std::filesystem::is_empty(parts.powerFolder()));
    EXPECT_THAT(parts.events(), ElementsAre("carl: machine: reboot"));
}

TEST_F(DeskCommands, aBrowserThatIsSentAwayIsDisconnected) {
    EXPECT_EQ(give(crew, command(1, [](Command& of) { of.set_revoke("id of olga"); })).outcome(),
              Reply::DONE);
    EXPECT_EQ(operating.outbox.closed, kClosedUnpaired);
    EXPECT_FALSE(watcher.outbox.closed);
    EXPECT_THAT(parts.events(), ElementsAre("carl: sent a browser away"));
}

}  // namespace
}  // namespace aquarama::console
