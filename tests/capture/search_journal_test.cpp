// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/search.h"
#include "common/base/log.h"

namespace aquarama::capture {
namespace {

namespace fs = std::filesystem;

class Journal : public testing::Test {
  protected:
    void SetUp() override { fs::remove(path_); }
    void TearDown() override { fs::remove(path_); }

    static SearchTrial trial(double miss) {
        return {.point = {0.1, 1.0 / 3, 1},
                .miss = miss,
                .leastStrouhal = 0.2,
                .mostStrouhal = 0.3,
                .leastStride = 0.5,
                .mostStride = 0.7};
    }
    void write(const std::string& text) const { std::ofstream(path_) << text; }
    [[nodiscard]] std::string read() const {
        std::ifstream file(path_);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    [[nodiscard]] std::string errorOnOpening() const {
        try {
            const SearchJournal journal(path_, "a search");
            return "none";
        } catch (const Error& error) {
            return error.what();
        }
    }

    fs::path path_ = testing::TempDir() + "aquarama_journal_test.journal";
};

TEST_F(Journal, givesBackEveryBitOfWhatWasAdded) {
    SearchJournal(path_, "a search").add(trial(2.0 / 7));
    SearchJournal(path_, "a search").add(trial(1e-9));
    EXPECT_THAT(SearchJournal(path_, "a search").trials(),
                testing::ElementsAre(trial(2.0 / 7), trial(1e-9)));
}

TEST_F(Journal, losesOnlyALineThatWasNotFinished) {
    SearchJournal(path_, "a search").add(trial(1));
    SearchJournal(path_, "a search").add(trial(2));
    const std::string whole = read();
    for (std::size_t cut = 1; cut < 20; ++cut) {
        write(whole.substr(0, whole.size() - cut));
        SearchJournal journal(path_, "a search");
        EXPECT_THAT(journal.trials(), testing::ElementsAre(trial(1)));
        journal.add(trial(2));
        EXPECT_EQ(read(), whole);
    }
}

TEST_F(Journal, beginsAnewWhereNotEvenTheFirstLineWasFinished) {
    write("a sea");
    EXPECT_TRUE(SearchJournal(path_, "a search").trials().empty());
    EXPECT_EQ(read(), "a search\n");
}

TEST_F(Journal, refusesTheJournalOfAnotherSearch) {
    write("another search\n");
    EXPECT_THAT(errorOnOpening(),
                testing::HasSubstr(".journal:1: the journal of another search; remove it"));
}

TEST_F(Journal, namesTheDamagedLine) {
    SearchJournal(path_, "a search").add(trial(1));
    const std::string good = read();
    for (const char* bad :
         {"1 2 3\n", "\n", "0.1 nonsense 0.2 0.3 0.5 0.7 1 1\n", "1 2 3 4 5 6 7 8 x\n"}) {
        write(good + bad + good.substr(good.find('\n') + 1));
        EXPECT_THAT(errorOnOpening(), testing::HasSubstr(".journal:3: not a trial")) << bad;
    }
}

TEST_F(Journal, saysWhereItCannotBeWritten) {
    path_ = "/proc/no/such.journal";
    EXPECT_THAT(errorOnOpening(), testing::HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace aquarama::capture
