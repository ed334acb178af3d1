// SPDX-License-Identifier: Apache-2.0
// `aquarama fidelity --clip`: the film that it leaves, and what it says where it cannot be made.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/base/picture.h"
#include "tests/support/read_clip.h"

namespace aquarama {
namespace {

namespace fs = std::filesystem;

class FilmOfFishAndReplica : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    int run(const std::string& arguments) const { return run(getenv("AQUARAMA_BIN"), arguments); }
    int run(const fs::path& programs, const std::string& arguments) const {
        const std::string command = (programs / "aquarama").string() + " fidelity --config " +
                                    AQUARAMA_SOURCE_DIR "/config " + arguments + " > " +
                                    path("said") + " 2> " + path("errors");
        return WEXITSTATUS(std::system(command.c_str()));
    }
    [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] std::string textOf(const std::string& name) const {
        std::ifstream file(folder_ / name);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    fs::path folder_ = fs::temp_directory_path() / ("aquarama-film-" + std::to_string(getpid()));
};

// The mean of the red, green and blue codes of a part of a picture.
glm::dvec3 meanOf(const Picture& picture, glm::ivec2 from, glm::ivec2 size) {
    glm::dvec3 sum{};
    for (int y = from.y; y < from.y + size.y; ++y)
        for (int x = from.x; x < from.x + size.x; ++x)
            for (int c = 0; c < 3; ++c)
                sum[c] +=
                    picture.rgb[static_cast<std::size_t>(3 * (y * picture.sizePixels.x + x) + c)];
    return sum / static_cast<double>(size.x * size.y);
}

TEST_F(FilmOfFishAndReplica, playsAsLongAsItsScriptAndShowsTheFishInItsSkin) {
    ASSERT_EQ(run("clownfish --seconds 1 --clip " + path("film.mp4")), 0) << textOf("errors");
    const auto seen = test::readClip(path("film.mp4"));
    EXPECT_EQ(seen.codec, "h264");
    EXPECT_EQ(seen.sizePixels, glm::ivec2(1280, 720));
    ASSERT_EQ(seen.pictures.size(), 30U);
    EXPECT_NEAR(seen.durationSeconds, 1, 1e-3);
    EXPECT_GT(test::meanCodesBetween(seen.pictures.front(), seen.pictures.back()), 0.05);
    // In the middle of the views from the side: orange in water that is bluer than red.
    for (const int band : {0, 1}) {
        const glm::dvec3 fish = meanOf(seen.pictures[15], {890, 204 * band + 80}, {20, 20});
        const glm::dvec3 water = meanOf(seen.pictures[15], {1100, 204 * band + 80}, {20, 20});
        EXPECT_GT(fish.r, fish.b + 60) << "band " << band;
        EXPECT_GT(water.b, water.r) << "band " << band;
    }
    EXPECT_THAT(textOf("said"), testing::HasSubstr("| brake |"));
    EXPECT_THAT(textOf("said"), testing::HasSubstr("clownfish and its replica, 30 pictures\n"));
    EXPECT_EQ(textOf("errors"), "");
    EXPECT_FALSE(fs::exists(path("film.mp4.part")));
}

TEST_F(FilmOfFishAndReplica, whatCannotBeIsRefusedInOneLine) {
    std::ofstream(path("file")) << "in the way";
    for (const auto& [arguments, status, why] :
         {std::tuple{"goldfish --clip " + path("a.mp4"), 1, "goldfish"},
          std::tuple{"clownfish blue_tang --clip " + path("a.mp4"), 1, "--clip shows one species"},
          std::tuple{"--clip " + path("a.avi"), 2, "FILE.mp4 or FILE.webp"},
          std::tuple{"--clip " + path("file/a.mp4"), 1, "choose another folder"},
          std::tuple{"--clip " + path("a.mp4") + " --out " + path(""), 2, "--out excludes --clip"},
          std::tuple{std::string("clownfish"), 2, "--out or --clip is required"}}) {
        EXPECT_EQ(run(arguments), status) << arguments << textOf("errors");
        EXPECT_THAT(textOf("errors"), testing::HasSubstr(why)) << arguments;
        EXPECT_EQ(std::ranges::count(textOf("errors"), '\n'), 1) << textOf("errors");
        EXPECT_EQ(textOf("said"), "");
    }
}

// The program alone, as where only a part of the packages is installed.
TEST_F(FilmOfFishAndReplica, withoutTheEncoderItSaysWhatToInstall) {
    fs::create_directories(path("programs"));
    for (const char* program : {"aquarama", "aquarama-node"})
        fs::copy_file(fs::path(getenv("AQUARAMA_BIN")) / program, path("programs") + "/" + program);
    EXPECT_EQ(run(path("programs"), "clownfish --clip " + path("a.mp4")), 1);
    EXPECT_THAT(textOf("errors"),
                testing::HasSubstr("aquarama-compose is missing; build or install"));
    EXPECT_EQ(std::ranges::count(textOf("errors"), '\n'), 1) << textOf("errors");
}

// The encoder finds out only when the first picture comes: its own words are the error.
TEST_F(FilmOfFishAndReplica, anEncoderThatFailsIsHeard) {
    fs::create_symlink("/dev/full", path("full.mp4"));
    EXPECT_EQ(run("clownfish --seconds 1 --clip " + path("full.mp4")), 1);
    EXPECT_THAT(textOf("errors"),
                testing::StartsWith("aquarama fidelity: " + path("full.mp4") + ":"));
    EXPECT_THAT(textOf("errors"), testing::HasSubstr("No space left"));
    EXPECT_EQ(std::ranges::count(textOf("errors"), '\n'), 1) << textOf("errors");
}

}  // namespace
}  // namespace aquarama
