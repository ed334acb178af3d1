// SPDX-License-Identifier: Apache-2.0
#include "capture/search.h"

#include <csignal>
#include <filesystem>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "capture/gait_trial.h"
#include "common/base/log.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

namespace fs = std::filesystem;

class Search : public testing::Test {
  protected:
    void SetUp() override { fs::remove(path_); }
    void TearDown() override { fs::remove(path_); }

    [[nodiscard]] SearchTrial search(
        std::size_t mostTrials,
        const SearchProgress& progress = [](std::size_t, const SearchTrial&) {}) {
        SearchJournal journal(path_, "scad");
        return searchGaits(start_, mostTrials, journal, progress);
    }

    fs::path path_ = testing::TempDir() + "aquarama_search_test.journal";
    config::Species start_ = [] {
        config::Species weak =
            test::scad();  // Tu's lag of half a beat, and a head that stands in the way
        weak.water.frontFactor = 0.7;
        weak.swim.middleDrive = 0.5;
        weak.swim.backLagRadians = 3.05;
        return weak;
    }();
};

TEST_F(Search, findsFishLikeStrouhalNumbersFromABadStart) {
    double worstAtStart = 0;
    const SearchTrial best = search(60, [&](std::size_t trials, const SearchTrial& soFar) {
        if (trials == 1) worstAtStart = soFar.mostStrouhal;
    });
    EXPECT_GT(worstAtStart, 0.4);
    EXPECT_GT(best.leastStrouhal, 0.2);
    EXPECT_LT(best.mostStrouhal, 0.4);
}

TEST_F(Search, endsAsIfItHadNeverBeenKilled) {
    constexpr std::size_t kTrials = 16;
    const SearchTrial uninterrupted = search(kTrials);
    fs::remove(path_);

    const pid_t child = fork();
    if (child == 0) {
        static_cast<void>(search(kTrials, [](std::size_t trials, const SearchTrial&) {
            if (trials == 7) std::raise(SIGKILL);
        }));
        _exit(1);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(SearchJournal(path_, "scad").trials().size(), 7U);

    EXPECT_EQ(search(kTrials), uninterrupted);
    EXPECT_EQ(SearchJournal(path_, "scad").trials().size(), kTrials);
}

TEST_F(Search, doesNotTakeTheTrialsOfAnotherProgram) {
    static_cast<void>(search(2));
    start_.tissue.stiffness *= 1.1;
    EXPECT_THROW(static_cast<void>(search(2)), Error);
}

TEST_F(Search, aSpeciesThatSwimsWellIsLeftAsItIs) {
    start_ = test::scad();
    EXPECT_LT(search(50).miss, 0.01);
    EXPECT_EQ(SearchJournal(path_, "scad").trials().size(), 1U);
}

}  // namespace
}  // namespace aquarama::capture
