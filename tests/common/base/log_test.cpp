// SPDX-License-Identifier: Apache-2.0
#include "common/base/log.h"

#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace aquarama {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class ShowLog : public ::testing::Test {
  protected:
    ~ShowLog() override { fs::remove_all(folder_); }
    static std::vector<std::string> linesOf(const fs::path& path) {
        std::ifstream file(path);
        std::vector<std::string> lines;
        for (std::string line; std::getline(file, line);) lines.push_back(line);
        return lines;
    }

    fs::path folder_ = fs::temp_directory_path() / ("aquarama-log-" + std::to_string(getpid()));
    fs::path path_ = folder_ / "logs/hall.jsonl";
};

TEST_F(ShowLog, aLineIsOneObjectWhateverItSays) {
    LogFile(path_).write("left", 41, Severity::Warning, "says \"no\"\nand \xff more");
    const auto lines = linesOf(path_);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_THAT(
        lines[0],
        HasSubstr(R"("node":"left","frame":41,"severity":"warning","text":"says \"no\"\n)"));
}

// Ten times what one file holds: the disk never fills.
TEST_F(ShowLog, oldFilesAreKeptWithinABound) {
    {
        LogFile log(path_);
        const std::string text(8000, 'x');
        for (std::uint64_t line = 0; line < 10000; ++line)
            log.write("left", line, Severity::Info, text);
    }
    std::uintmax_t bytes = 0;
    std::size_t files = 0;
    for (const fs::directory_entry& file : fs::directory_iterator(path_.parent_path())) {
        bytes += file.file_size();
        ++files;
    }
    EXPECT_LE(files, 6U);
    EXPECT_GT(files, 1U);
    EXPECT_LE(bytes, std::uintmax_t{6} * (std::uintmax_t{8} << 20U));
}

// The lines are written by a thread of their own, which ends with the file.
TEST_F(ShowLog, aDiskThatIsFullIsSaidOnce) {
    fs::create_directories(path_.parent_path());
    fs::create_symlink("/dev/full", path_);
    std::vector<std::string> warnings;
    setLogListener([&](Severity severity, const std::string& line) {
        if (severity == Severity::Warning) warnings.push_back(line);
    });
    {
        LogFile log(path_);
        for (std::uint64_t line = 0; line < 10; ++line)
            log.write("left", line, Severity::Info, "x");
    }
    setLogListener({});
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_THAT(warnings[0], HasSubstr(path_.string()));
    EXPECT_THAT(warnings[0], HasSubstr("make room"));
}

TEST_F(ShowLog, aFolderThatCannotBeMadeIsNamed) {
    std::ofstream(folder_) << "a file";
    try {
        LogFile log(path_);
        ADD_FAILURE() << "made it";
    } catch (const Error& problem) {
        EXPECT_THAT(problem.what(), HasSubstr("hall.jsonl: the log of the show cannot be written"));
    }
}

TEST(LogListener, hearsNeitherControlsNorOtherEncodings) {
    std::vector<std::string> heard;
    setLogListener([&](Severity, const std::string& line) { heard.push_back(line); });
    logWarning("node {} says {}", "b\xFChne", "\x1B[2Jgr\xC3\xBC\xC3\x9F");
    setLogListener({});
    EXPECT_THAT(heard, testing::ElementsAre("node b\\xFChne says \\x1B[2Jgr\xC3\xBC\xC3\x9F"));
}

TEST(LogListener, hearsEveryLineWithItsSeverity) {
    std::vector<std::pair<Severity, std::string>> heard;
    setLogListener(
        [&](Severity severity, const std::string& line) { heard.emplace_back(severity, line); });
    logInfo("one {}", 1);
    logError("two");
    setLogListener({});
    logInfo("three");
    EXPECT_THAT(heard,
                testing::ElementsAre(testing::Pair(Severity::Info, "one 1"),
                                     testing::Pair(Severity::Error, "two")));
}

}  // namespace
}  // namespace aquarama
