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
    std::atomic<int> doctors = 0, readings = 0, uses = 0;
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
