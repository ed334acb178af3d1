// SPDX-License-Identifier: Apache-2.0
// Versions of a real file, and what is left of them when a program is killed.
#include "common/base/versions.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace aquarama {
namespace {

namespace fs = std::filesystem;

class Versions : public testing::Test {
  protected:
    Versions() { fs::create_directories(folder); }
    ~Versions() override { fs::remove_all(folder); }
    void write(const std::string& content) const { std::ofstream(file) << content; }
    static std::string contentOf(const fs::path& path) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    const fs::path folder =
        fs::temp_directory_path() / ("aquarama_versions_" + std::to_string(getpid()));
    const fs::path file = folder / "hall.mpcdi";
};

TEST_F(Versions, areKeptWithTheirNotesTheNewestFirst) {
    EXPECT_TRUE(versionsOf(file).empty());
    keepVersion(file, "of nothing");
    EXPECT_TRUE(versionsOf(file).empty()) << "there is no file yet";
    write("one");
    keepVersion(file, "first");
    keepVersion(file, "");  // the same again
    write("two");
    keepVersion(file, "second");
    const auto versions = versionsOf(file);
    ASSERT_EQ(versions.size(), 2U);
    EXPECT_EQ(versions[0].note, "second");
    EXPECT_TRUE(versions[0].isInUse);
    EXPECT_EQ(versions[1].note, "first");
    EXPECT_FALSE(versions[1].isInUse);
    EXPECT_EQ(versions[1].path.parent_path(), folder / "hall.history");
    EXPECT_EQ(contentOf(versions[1].path), "one");
}

TEST_F(Versions, goBackAndForthWithoutLoss) {
    write("one");
    keepVersion(file, "first");
    write("two");  // nobody has kept it
    useVersion(file, versionsOf(file).at(0));
    EXPECT_EQ(contentOf(file), "one");
    const auto versions = versionsOf(file);
    ASSERT_EQ(versions.size(), 2U);
    EXPECT_TRUE(versions[1].isInUse);
    useVersion(file, versions[0]);
    EXPECT_EQ(contentOf(file), "two");
    EXPECT_EQ(versionsOf(file).size(), 2U);
}

TEST_F(Versions, areBoundedAndTheOneInUseStays) {
    for (std::size_t i = 0; i < kMostVersions + 5; ++i) {
        write("version " + std::to_string(i));
        keepVersion(file, "note");
    }
    auto versions = versionsOf(file);
    ASSERT_EQ(versions.size(), kMostVersions);
    EXPECT_EQ(contentOf(versions.back().path), "version 5");
    useVersion(file, versions.back());
    write("version 5");
    fs::rename(versionsOf(file).front().path, folder / "one.mpcdi");
    fs::rename(folder / "one.mpcdi", folder / "hall.history" / "9999-01-01T000000.mpcdi");
    std::ofstream(folder / "hall.history" / "9999-01-01T000001.mpcdi") << "one more";
    keepVersion(file, "");
    versions = versionsOf(file);
    ASSERT_EQ(versions.size(), kMostVersions);
    EXPECT_EQ(contentOf(versions.back().path), "version 5") << "the oldest, but in use";
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder / "hall.history"))
        ++files;
    EXPECT_LE(files, 2 * kMostVersions) << "notes go with their versions";
}

// A program is killed at some moment while it exchanges large versions.
TEST_F(Versions, areWholeWhenAProgramIsKilled) {
    const std::string one(200000, 'a'), two(200000, 'b');
    write(one);
    keepVersion(file, "");
    write(two);
    keepVersion(file, "");
    for (int round = 0; round < 30; ++round) {
        const pid_t child = fork();
        if (child == 0) {
            for (;;)
                for (const FileVersion& version : versionsOf(file)) useVersion(file, version);
        }
        std::this_thread::sleep_for(std::chrono::microseconds(2000 + 700 * round));
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        const std::string content = contentOf(file);
        ASSERT_TRUE(content == one || content == two) << "round " << round;
        const auto versions = versionsOf(file);
        ASSERT_EQ(versions.size(), 2U);
        for (const FileVersion& version : versions)
            ASSERT_EQ(contentOf(version.path).size(), one.size());
    }
}

}  // namespace
}  // namespace aquarama
