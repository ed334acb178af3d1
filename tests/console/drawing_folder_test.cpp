// SPDX-License-Identifier: Apache-2.0
#include "console/drawing_folder.h"

#include <chrono>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/ask/drawing_reader.h"
#include "common/base/files.h"
#include "tests/support/await.h"

namespace aquarama::console {
namespace {

namespace fs = std::filesystem;
using ask::Answer;
using ask::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A folder, and a taker whose answers the test gives.
class DrawingFolderTest : public testing::Test {
  protected:
    DrawingFolderTest() { fs::create_directories(place); }

    void put(const std::string& name, const std::string& content = "a picture") const {
        std::ofstream(place / name) << content;
    }
    // Ticks until something holds.
    void tickUntil(const std::function<bool()>& holds, bool isOpen = true) {
        EXPECT_TRUE(test::comesTrue([&] {
            folder.tick(isOpen);
            return holds();
        }));
    }
    // Enough for three looks, none of which should do anything.
    void tickInVain(bool isOpen = true) {
        for (int tick = 0; tick < 60; ++tick) {
            folder.tick(isOpen);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }
    [[nodiscard]] bool isThere(const fs::path& name) const { return fs::exists(place / name); }

    TemporaryFolder temporary{"folder"};
    fs::path place = temporary.path() / "scans";
    bool takes = true;
    std::vector<std::string> taken, refused;
    std::map<std::uint64_t, Answer> answers;
    DrawingFolder folder{place,
                         {[this](const std::string& name, const std::string& picture) {
                              if (!takes) return std::uint64_t{0};
                              taken.push_back(name + ": " + picture);
                              answers[taken.size()] = {Outcome::Waiting, ""};
                              return std::uint64_t{taken.size()};
                          },
                          [this](std::uint64_t command) {
                              const auto known = answers.find(command);
                              return known == answers.end() ? nullptr : &known->second;
                          },
                          [this](const std::string& name, const std::string& why) {
                              refused.push_back(name + ": " + why);
                          }}};
};

TEST_F(DrawingFolderTest, aPictureIsOfferedOnceAndRemovedWhenItsDrawingWasTaken) {
    put("scan_1.jpg");
    tickUntil([&] { return !taken.empty(); });
    tickInVain();
    EXPECT_THAT(taken, ElementsAre("scan_1.jpg: a picture")) << "its end is waited for";
    EXPECT_TRUE(isThere("scan_1.jpg"));
    answers[1] = {Outcome::Done, "drawing 1"};
    tickUntil([&] { return !isThere("scan_1.jpg"); });
    tickInVain();
    EXPECT_EQ(taken.size(), 1U);
    EXPECT_FALSE(isThere("refused"));
}

TEST_F(DrawingFolderTest, aRefusedOneIsMovedAndTheNextGoesOn) {
    put("bad.jpg", "no sheet");
    fs::last_write_time(place / "bad.jpg",
                        fs::file_time_type::clock::now() - std::chrono::hours(1));
    put("good.jpg");
    tickUntil([&] { return taken.size() == 1; });
    EXPECT_EQ(taken[0], "bad.jpg: no sheet") << "the oldest first";
    answers[1] = {Outcome::Refused, "no sheet is in the picture"};
    tickUntil([&] { return taken.size() == 2; });
    EXPECT_TRUE(isThere("refused/bad.jpg"));
    EXPECT_FALSE(isThere("bad.jpg"));
    EXPECT_EQ(taken[1], "good.jpg: a picture");
}

TEST_F(DrawingFolderTest, oneWhoseEndNobodyKnowsIsOfferedAgain) {
    put("scan.jpg");
    tickUntil([&] { return taken.size() == 1; });
    answers[1] = {Outcome::Lost, ""};
    tickUntil([&] { return taken.size() == 2; });
    answers.clear();
    tickUntil([&] { return taken.size() == 3; });
    EXPECT_TRUE(isThere("scan.jpg"));
}

TEST_F(DrawingFolderTest, aFileThatIsStillWrittenWaits) {
    std::ofstream writer(place / "slow.jpg");
    for (int part = 0; part < 40; ++part) {
        writer << "part" << std::flush;
        folder.tick(true);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_THAT(taken, IsEmpty());
    writer.close();
    tickUntil([&] { return taken.size() == 1; });
    EXPECT_EQ(taken[0].size(), std::string("slow.jpg: ").size() + 40 * 4);
}

TEST_F(DrawingFolderTest, hiddenFilesLinksFoldersAndEmptyOnesArePassedOver) {
    put(".upload.jpg");
    put("empty.jpg", "");
    fs::create_directories(place / "more");
    put("more/inside.jpg");
    fs::create_symlink("/etc/passwd", place / "link.jpg");
    tickInVain();
    EXPECT_THAT(taken, IsEmpty());
    EXPECT_TRUE(isThere("more/inside.jpg"));
}

TEST_F(DrawingFolderTest, nothingIsTakenWhileDrawingsAreOffOrTooManyWait) {
    put("scan.jpg");
    tickInVain(false);
    EXPECT_THAT(taken, IsEmpty());
    takes = false;
    tickInVain();
    EXPECT_TRUE(isThere("scan.jpg"));
    takes = true;
    tickUntil([&] { return taken.size() == 1; });
}

TEST_F(DrawingFolderTest, oneThatIsTooLargeIsRefusedUnread) {
    put("film.jpg", "x");
    fs::resize_file(place / "film.jpg", ask::kMostPictureBytes + 1);
    tickUntil([&] { return isThere("refused/film.jpg") && !isThere("film.jpg"); });
    EXPECT_THAT(taken, IsEmpty());
    ASSERT_EQ(refused.size(), 1U);
    EXPECT_THAT(refused[0], HasSubstr("film.jpg: the picture is too large"));
}

TEST_F(DrawingFolderTest, ofTheRefusedTheLastHundredStay) {
    fs::create_directories(place / "refused");
    const auto now = fs::file_time_type::clock::now();
    for (int i = 0; i < 110; ++i) {
        const std::string name = "refused/old_" + std::to_string(i);
        put(name);
        fs::last_write_time(place / name, now - std::chrono::hours(200 - i));
    }
    put("bad.jpg");
    tickUntil([&] { return taken.size() == 1; });
    answers[1] = {Outcome::Refused, ""};
    tickUntil([&] { return !isThere("bad.jpg"); });
    EXPECT_EQ(std::distance(fs::directory_iterator(place / "refused"), fs::directory_iterator()),
              static_cast<std::ptrdiff_t>(DrawingFolder::kMostRefused));
    EXPECT_TRUE(isThere("refused/bad.jpg"));
    EXPECT_TRUE(isThere("refused/old_109"));
    EXPECT_FALSE(isThere("refused/old_0"));
}

TEST_F(DrawingFolderTest, aFolderThatIsGoneIsAProblemUntilItIsThere) {
    fs::remove(place);
    tickUntil([&] { return !folder.problem().empty(); });
    EXPECT_THAT(folder.problem(), HasSubstr("scans"));
    fs::create_directories(place);
    tickUntil([&] { return folder.problem().empty(); });
}

// A picture that cannot be taken away would be offered again and again.
TEST_F(DrawingFolderTest, whatCannotBeTakenAwayIsAProblemAndOfferedOnce) {
    put("scan.jpg");
    put("refused", "a file where the folder should be");
    fs::last_write_time(place / "refused",
                        fs::file_time_type::clock::now() + std::chrono::hours(1));
    tickUntil([&] { return taken.size() == 1; });
    answers[1] = {Outcome::Refused, ""};
    tickUntil([&] { return !folder.problem().empty(); });
    tickInVain();
    EXPECT_EQ(taken.size(), 1U);
    fs::remove(place / "refused");
    tickUntil([&] { return folder.problem().empty(); });
    EXPECT_TRUE(isThere("refused/scan.jpg"));
}

}  // namespace
}  // namespace aquarama::console
