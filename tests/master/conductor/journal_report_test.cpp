// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/journal_report.h"

#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "common/wire/journal_text.h"
#include "common/wire/messages.h"

namespace aquarama::conductor {
namespace {

using std::chrono::seconds;

constexpr net::Moment kNow{seconds(1000)};

constexpr net::Moment in(int passed) {
    return kNow + seconds(passed);
}

TEST(JournalReport, itTellsTheAgeOfTheNewestSaveAndTheBytes) {
    JournalReport report;
    EXPECT_FALSE(report.status(in(0)).has_save_age_s());
    report.saved(kNow);
    report.measured({.file = 12'000'000, .folder = 140'000'000, .free = 80'000'000'000});
    const v1::JournalStatus status = report.status(in(3));
    EXPECT_EQ(status.condition(), v1::JournalStatus::WRITTEN);
    EXPECT_EQ(status.save_age_s(), 3);
    EXPECT_EQ(wire::journalText(status),
              "written, newest save 3 s old, file 12 MB, folder 140 MB, disk 80 GB free");
    EXPECT_EQ(wire::journalProblem(status), "");
}

TEST(JournalReport, aPauseHasItsReasonUntilTheJournalGoesOn) {
    JournalReport report;
    report.paused("the disk is full\n");
    const v1::JournalStatus paused = report.status(in(0));
    EXPECT_EQ(paused.condition(), v1::JournalStatus::PAUSED);
    EXPECT_TRUE(
        wire::journalProblem(paused).starts_with("the journal is paused: the disk is full"));
    report.goesOn();
    const v1::JournalStatus status = report.status(in(0));
    EXPECT_EQ(status.condition(), v1::JournalStatus::WRITTEN);
    EXPECT_EQ(status.pauses(), 1U);
    EXPECT_EQ(wire::journalProblem(status), "");
}

// A world that stands still saves nothing, and its disk is asked for nothing: that is no problem.
TEST(JournalReport, aDiskThatDoesNotAnswerForThreeSecondsIsWaitedFor) {
    JournalReport report;
    report.saved(kNow);
    EXPECT_EQ(report.status(in(3600)).condition(), v1::JournalStatus::WRITTEN);
    {
        const JournalReport::DiskUse use(report, kNow);
        EXPECT_EQ(report.status(in(2)).condition(), v1::JournalStatus::WRITTEN);
        EXPECT_EQ(report.status(in(4)).condition(), v1::JournalStatus::WAITING);
        { const JournalReport::DiskUse within(report, in(3)); }
        EXPECT_EQ(report.status(in(4)).condition(), v1::JournalStatus::WAITING);
        EXPECT_EQ(wire::journalProblem(report.status(in(4))),
                  "the journal waits for its disk: it stands still");
    }
    EXPECT_EQ(report.status(in(4)).condition(), v1::JournalStatus::WRITTEN);
}

TEST(JournalReport, itTellsFromWhereAWorldGoesOn) {
    JournalReport report;
    EXPECT_EQ(wire::wentOnText(report.status(in(0))), "");
    report.wentOn(Tick{900}, 2.2);
    EXPECT_EQ(wire::wentOnText(report.status(in(0))),
              "the world goes on from 0:00:15, away for 2 s");
    report.wentOn(Tick{60 * 3600 * 30}, 15 * 3600);
    EXPECT_EQ(wire::wentOnText(report.status(in(0))),
              "the world goes on from 30:00:00, away for 15 h");
}

TEST(JournalReport, aShowWithoutAJournalSaysWhy) {
    const JournalReport recorded(v1::JournalStatus::NOT_KEPT, "the show is recorded");
    EXPECT_EQ(wire::journalText(recorded.status(in(0))), "none: the show is recorded");
    EXPECT_EQ(wire::journalProblem(recorded.status(in(0))), "");
    const JournalReport refused(v1::JournalStatus::REFUSED, "another show keeps its journal there");
    EXPECT_EQ(wire::journalProblem(refused.status(in(0))),
              "no journal is kept: another show keeps its journal there");
}

TEST(JournalReport, lateInputsAreCountedAndHowOftenThatBegan) {
    JournalReport report;
    report.inputWasLate(true);
    report.inputWasLate(false);
    EXPECT_EQ(report.status(in(0)).late_inputs(), 2U);
    EXPECT_EQ(report.status(in(0)).late_spells(), 1U);
}

TEST(JournalReport, aReasonOfAnyBytesIsLegibleAndWithinTheBoundsOfTheMessage) {
    JournalReport report;
    report.paused("\xff\x01" + std::string(5000, 'x'));
    const std::string reason = report.status(in(0)).reason();
    EXPECT_LE(reason.size(), wire::kMostReasonBytes);
    EXPECT_EQ(reason.find_first_of("\xff\x01"), std::string::npos);
}

}  // namespace
}  // namespace aquarama::conductor
