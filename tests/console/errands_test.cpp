// SPDX-License-Identifier: Apache-2.0
#include "console/errands.h"

#include <atomic>
#include <future>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/console/parts.h"
#include "tests/support/await.h"

namespace aquarama::console {
namespace {

// Errands that end when a test lets them.
class HeldErrands : public testing::Test {
  protected:
    ~HeldErrands() override { letGo(); }
    ErrandWork work() {
        return {.askDoctor =
                    [this](const std::string&) {
                        hold(doctors);
                        browser::DoctorReport report;
                        report.set_problem("found " + std::to_string(doctors));
                        return report;
                    },
                .calibrationsOf =
                    [this](const std::string& rig) {
                        hold(readings);
                        browser::Calibrations list;
                        list.set_file("of " + rig);
                        return list;
                    },
                .useCalibration =
                    [this](const std::string&, const std::string& name) {
                        hold(uses);
                        return name == "good" ? std::string() : name + " fits no channel";
                    },
                .assignNode =
                    [](const Assignment& assignment) {
                        return "no node waits for " + assignment.channel;
                    },
                .releasesOf =
                    [this](const std::string&) {
                        ++asked;
                        browser::Releases releases;
                        releases.set_stable("1.4." + std::to_string(asked));
                        return releases;
                    },
                .changeRelease = [](const std::string&,
                                    const std::string& word) { return "no " + word; },
                .tourOf =
                    [this](const std::string&) {
                        hold(tours);
                        browser::Tour tour;
                        tour.set_seconds(tours);
                        return tour;
                    },
                .confirmStep =
                    [](const std::string&, const std::string& step, const std::string& found) {
                        return step + " has not found " + found;
                    }};
    }
    void hold(std::atomic<int>& count) {
        ++count;
        ended.wait_for(test::kPatience);
    }
    void letGo() {
        if (!std::exchange(isLetGo, true)) end.set_value();
    }

    bool isLetGo = false;
    std::promise<void> end;
    const std::shared_future<void> ended = end.get_future().share();
    std::atomic<int> doctors = 0, readings = 0, uses = 0, asked = 0, tours = 0;
    test::ConsoleParts parts;
    Errands errands{parts.state, work()};
};

TEST_F(HeldErrands, theDoctorRunsOnceAtATimeAndIsShownWhenItHasEnded) {
    errands.runDoctor();
    errands.runDoctor();
    EXPECT_FALSE(errands.hear());
    EXPECT_TRUE(parts.state.doctor.running());
    EXPECT_EQ(parts.state.doctor.problem(), "");
    letGo();
    ASSERT_TRUE(test::comesTrue([&] {
        static_cast<void>(errands.hear());
        return !parts.state.doctor.running();
    }));
    EXPECT_EQ(parts.state.doctor.problem(), "found 1");
    EXPECT_EQ(doctors, 1);
}

TEST_F(HeldErrands, calibrationsAreReadEveryFiveSeconds) {
    letGo();
    errands.wantCalibrations(7);
    ASSERT_TRUE(test::comesTrue([&] {
        static_cast<void>(errands.hear());
        return parts.state.calibrations.has_value();
    }));
    EXPECT_EQ(parts.state.calibrations->file(), "of " + parts.rigFile);
    errands.wantCalibrations(56);
    EXPECT_EQ(readings, 1);
    errands.wantCalibrations(57);
    EXPECT_TRUE(test::comesTrue([&] { return readings == 2; }));
}

TEST_F(HeldErrands, oneCalibrationAtATimeIsPutInPlace) {
    EXPECT_TRUE(errands.use("bad", 7));
    EXPECT_FALSE(errands.use("good", 8));
    EXPECT_FALSE(errands.hear());
    letGo();
    std::optional<Errands::Ended> used;
    ASSERT_TRUE(test::comesTrue([&] { return (used = errands.hear()).has_value(); }));
    EXPECT_EQ(used->command, 7U);
    EXPECT_EQ(used->refusal, "bad fits no channel");
    EXPECT_EQ(uses, 1);
    EXPECT_FALSE(errands.hear()) << "it is told once";
    EXPECT_TRUE(errands.use("good", 9));
    ASSERT_TRUE(test::comesTrue([&] { return (used = errands.hear()).has_value(); }));
    EXPECT_EQ(used->command, 9U);
    EXPECT_EQ(used->refusal, "");
}

TEST_F(HeldErrands, aNodeIsGivenAChannelWhereNoCalibrationIsPutInPlace) {
    Assignment assignment;
    assignment.channel = "left";
    ASSERT_TRUE(errands.use("good", 7));
    EXPECT_FALSE(errands.assign(assignment, 8));
    letGo();
    ASSERT_TRUE(test::comesTrue([&] { return errands.hear().has_value(); }));
    EXPECT_TRUE(errands.assign(assignment, 9));
    std::optional<Errands::Ended> told;
    ASSERT_TRUE(test::comesTrue([&] { return (told = errands.hear()).has_value(); }));
    EXPECT_EQ(told->command, 9U);
    EXPECT_EQ(told->refusal, "no node waits for left");
}

// While somebody looks; and at once after the crew has said a word.
TEST_F(HeldErrands, theDepotIsAskedEveryTwoSeconds) {
    const auto stable = [&] {
        static_cast<void>(errands.hear());
        return parts.state.releases ? parts.state.releases->stable() : "";
    };
    errands.wantReleases(5);
    EXPECT_TRUE(test::comesTrue([&] { return stable() == "1.4.1"; }));
    errands.wantReleases(24);
    EXPECT_EQ(asked, 1);
    errands.wantReleases(25);
    EXPECT_TRUE(test::comesTrue([&] { return stable() == "1.4.2"; }));
    EXPECT_TRUE(errands.change("go", 7));
    std::optional<Errands::Ended> told;
    ASSERT_TRUE(test::comesTrue([&] { return (told = errands.hear()).has_value(); }));
    EXPECT_EQ(told->refusal, "no go");
    errands.wantReleases(26);
    EXPECT_TRUE(test::comesTrue([&] { return stable() == "1.4.3"; }));
}

// The pause is between the end of a look and the next; none after a word of the crew.
TEST_F(HeldErrands, theHallIsLookedAtEveryFiveSeconds) {
    const auto seconds = [&] {
        static_cast<void>(errands.hear());
        return parts.state.tour ? parts.state.tour->seconds() : 0;
    };
    errands.wantTour(0);
    errands.wantTour(400);
    EXPECT_EQ(seconds(), 0);
    letGo();
    EXPECT_TRUE(test::comesTrue([&] { return seconds() == 1; }));
    errands.wantTour(449);
    EXPECT_EQ(tours, 1);
    errands.wantTour(450);
    EXPECT_TRUE(test::comesTrue([&] { return seconds() == 2; }));
    browser::ConfirmStep step;
    step.set_name("screen");
    step.set_found("flat");
    EXPECT_TRUE(errands.confirm(step, 7));
    std::optional<Errands::Ended> told;
    ASSERT_TRUE(test::comesTrue([&] { return (told = errands.hear()).has_value(); }));
    EXPECT_EQ(told->refusal, "screen has not found flat");
    errands.wantTour(451);
    EXPECT_TRUE(test::comesTrue([&] { return seconds() == 3; }));
}

TEST(TourOfHall, isReadAsTheCommandSaysIt) {
    const browser::Tour tour = tourIn(
        R"({"seconds":61.5,"steps":[{"name":"screen","state":"confirm","found":"flat","todo":"look",)"
        R"("seconds":60},{"name":"hours","state":"done","found":"open","todo":"","seconds":1.5}]})");
    EXPECT_FALSE(tour.has_problem());
    EXPECT_EQ(tour.seconds(), 61.5);
    ASSERT_EQ(tour.steps_size(), 2);
    EXPECT_EQ(tour.steps(0).name() + " " + tour.steps(0).state(), "screen confirm");
    EXPECT_EQ(tour.steps(0).found() + " " + tour.steps(0).todo(), "flat look");
    EXPECT_EQ(tour.steps(1).seconds(), 1.5);
    for (const char* bad : {"", "[]", "{}", R"({"seconds":1,"steps":[{"name":"screen"}]})"}) {
        EXPECT_EQ(tourIn(bad).problem(), "the steps cannot be read") << bad;
        EXPECT_EQ(tourIn(bad).steps_size(), 0) << bad;
    }
}

TEST(ReleasesOfHall, areReadAsTheDepotSaysThem) {
    const browser::Releases releases = releasesIn(
        R"({"phase":"copying","stable":{"version":"1.3.0","serial":5},)"
        R"("candidate":{"version":"1.4.0","serial":9},"before":null,"ready":true,)"
        R"("reason":"","waiting_for":"the hours","machines":[{"name":"main",)"
        R"("runs":{"version":"1.3.0","serial":5},"silent_s":0.4,"frames":7,"problem":""},)"
        R"({"name":"left-pc","runs":null,"silent_s":1e9,"frames":0,"problem":"its disk is full"},3]})");
    EXPECT_FALSE(releases.has_problem());
    EXPECT_EQ(releases.phase(), "copying");
    EXPECT_EQ(releases.stable() + " " + releases.candidate() + releases.before(), "1.3.0 1.4.0");
    EXPECT_TRUE(releases.ready());
    ASSERT_EQ(releases.machines_size(), 2);
    EXPECT_EQ(releases.machines(0).runs(), "1.3.0");
    EXPECT_EQ(releases.machines(1).runs(), "");
    EXPECT_EQ(releases.machines(1).problem(), "its disk is full");
    EXPECT_EQ(releasesIn("no depot").problem(), "the depot's answer cannot be read");
    EXPECT_EQ(releasesIn("{}").machines_size(), 0);
}

// The list of a page names the one that is in place now.
TEST_F(HeldErrands, calibrationsAreReadAtOnceWhenAnotherIsInPlace) {
    letGo();
    errands.wantCalibrations(100);
    ASSERT_TRUE(test::comesTrue([&] {
        static_cast<void>(errands.hear());
        return parts.state.calibrations.has_value();
    }));
    ASSERT_TRUE(errands.use("good", 7));
    ASSERT_TRUE(test::comesTrue([&] { return errands.hear().has_value(); }));
    errands.wantCalibrations(101);
    EXPECT_TRUE(test::comesTrue([&] { return readings == 2; }));
}

}  // namespace
}  // namespace aquarama::console
