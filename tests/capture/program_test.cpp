// SPDX-License-Identifier: Apache-2.0
// `aquarama capture` as it is used: what it leaves in its folder, on mistakes too.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "capture/repertoire_files.h"
#include "common/config/text_file.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

namespace fs = std::filesystem;

class Program : public testing::Test {
  protected:
    void SetUp() override {
        fs::remove_all(root_);
        fs::create_directories(root_);
    }
    void TearDown() override { fs::remove_all(root_); }

    struct Outcome {
        int status = -1;
        std::string said;  // both streams
    };
    [[nodiscard]] Outcome capture(const std::string& arguments,
                                  const std::string& before = "") const {
        const std::string command = "XDG_CACHE_HOME=" + cache().string() + " " + before +
                                    " \"$AQUARAMA_BIN\"/aquarama capture --out " + out().string() +
                                    " " + arguments + " 2>&1";
        std::FILE* pipe = popen(command.c_str(), "r");
        Outcome outcome;
        for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe))
            outcome.said += static_cast<char>(c);
        outcome.status = WEXITSTATUS(pclose(pipe));
        return outcome;
    }
    [[nodiscard]] fs::path out() const { return root_ / "out"; }
    [[nodiscard]] fs::path cache() const { return root_ / "cache"; }
    // When each captured repertoire was kept, by its file.
    [[nodiscard]] std::map<fs::path, fs::file_time_type> cachedAt() const {
        std::map<fs::path, fs::file_time_type> files;
        for (const auto& entry : fs::recursive_directory_iterator(cache()))
            if (entry.is_regular_file()) files[entry.path()] = entry.last_write_time();
        return files;
    }
    [[nodiscard]] std::set<std::string> left() const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(out()))
            names.insert(entry.path().filename().string());
        return names;
    }
    // A species file, with one text put in another's place.
    [[nodiscard]] std::string edited(const std::string& good, const std::string& bad) const {
        std::string text = config::readTextFile(test::kScadFile);
        text.replace(text.find(good), good.size(), bad);
        const fs::path path = root_ / "edited.txtpb";
        std::ofstream(path) << text;
        return path.string();
    }

  private:
    fs::path root_ = fs::path(testing::TempDir()) /
                     ("capture-" + std::to_string(getpid()) + "-" +
                      testing::UnitTest::GetInstance()->current_test_info()->name());
};

// Of those in the config folder, here two.
TEST_F(Program, leavesOneFileForEachSpeciesAndNothingElse) {
    const fs::path config = out().parent_path() / "config";
    fs::create_directories(config / "species");
    for (const char* name : {"clownfish.txtpb", "moorish_idol.txtpb"})
        fs::copy_file(fs::path(test::kScadFile).parent_path() / name, config / "species" / name);
    const Outcome outcome = capture("--config " + config.string());
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_EQ(left(), (std::set<std::string>{"clownfish.aqrep", "moorish_idol.aqrep"}));
}

TEST_F(Program, putsAFileInTheOldOnesPlaceAndSimulatesNothingTwice) {
    fs::create_directories(out());
    std::ofstream(out() / "bigeye_scad.aqrep") << "old";
    EXPECT_EQ(capture("--species bigeye_scad").status, 0);
    const auto captured = cachedAt();
    const auto fresh = readRepertoireFile(out() / "bigeye_scad.aqrep");
    EXPECT_EQ(motion::decodeRepertoire(fresh, "fresh").species, "bigeye_scad");
    EXPECT_EQ(capture("--species bigeye_scad").status, 0);
    EXPECT_EQ(cachedAt(), captured) << "it was captured anew";
    EXPECT_EQ(readRepertoireFile(out() / "bigeye_scad.aqrep"), fresh);
    EXPECT_EQ(left(), std::set<std::string>{"bigeye_scad.aqrep"});
}

TEST_F(Program, namesASpeciesThatFailsAndCapturesTheOthers) {
    const std::string broken = edited("time_scale: 1.5", "time_scale: -1");
    const Outcome outcome = capture("--species bigeye_scad " + broken);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.said, testing::ContainsRegex("aquarama capture: [^\n]*edited.txtpb"));
    EXPECT_EQ(left(), std::set<std::string>{"bigeye_scad.aqrep"});
}

TEST_F(Program, leavesNothingWhenItIsInterrupted) {
    const Outcome outcome = capture("", "timeout --signal=INT 0.2");
    EXPECT_NE(outcome.status, 0);
    for (const std::string& name : left())
        static_cast<void>(
            motion::decodeRepertoire(readRepertoireFile(out() / name), name));  // whole, if any
}

TEST_F(Program, refusesAFolderThatIsAFile) {
    std::ofstream{out()} << "a file";
    const Outcome outcome = capture("--species bigeye_scad");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.said, testing::HasSubstr(out().string()));
    EXPECT_FALSE(fs::exists(cache())) << "before any work";
}

}  // namespace
}  // namespace aquarama::capture
