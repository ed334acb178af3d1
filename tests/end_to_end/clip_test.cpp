// SPDX-License-Identifier: Apache-2.0
// `aquarama run --clip`: the whole show as processes, and the file that it leaves.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "common/base/picture.h"
#include "common/config/rig.h"
#include "tests/end_to_end/free_port.h"
#include "tests/support/read_clip.h"

namespace aquarama {
namespace {

namespace fs = std::filesystem;

class ClipOfAShow : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directories(folder_);
        std::string rig = test::withField(rigOnFreePorts("desk"), "width_px", "451");
        rig = test::withField(rig, "height_px", "201");  // the first size is the panorama's
        std::ofstream(folder_ / "rig.txtpb") << rig;
    }
    void TearDown() override { fs::remove_all(folder_); }

    int run(const std::string& arguments) const {
        const std::string command = std::string(getenv("AQUARAMA_BIN")) + "/aquarama run " +
                                    path("rig.txtpb") + " --headless --quality low " + arguments +
                                    " > " + path("log") + " 2>&1";
        return WEXITSTATUS(std::system(command.c_str()));
    }
    [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] std::string log() const {
        std::ifstream file(folder_ / "log");
        return {std::istreambuf_iterator<char>(file), {}};
    }

    fs::path folder_ = fs::temp_directory_path() / ("aquarama-clip-" + std::to_string(getpid()));
};

TEST_F(ClipOfAShow, showsThePanoramaOfEveryOtherFrameAndLeavesNothingElse) {
    ASSERT_EQ(run("--pattern grid --frames 7 --film-every 2 --clip " + path("show/clip.mp4") +
                  " --snapshot " + path("show")),
              0)
        << log();
    const auto seen = test::readClip(path("show/clip.mp4"));
    EXPECT_EQ(seen.codec, "h264");
    EXPECT_EQ(seen.sizePixels, glm::ivec2(452, 202)) << "even, one more than the panorama";
    ASSERT_EQ(seen.pictures.size(), 4U);
    EXPECT_NEAR(seen.durationSeconds, 8 / 60.0, 1e-3);
    const Picture last = readPng(path("show/panorama.png"));
    EXPECT_LT(test::meanCodesBetween(seen.pictures.back(), last), 3);
    EXPECT_FALSE(fs::exists(path("show/clip.mp4.part")));
    EXPECT_EQ(std::distance(fs::directory_iterator(path("show")), {}), 6) << "5 pictures, a clip";
}

TEST_F(ClipOfAShow, showsAChannelOfTheWorldAsItsSnapshotHasIt) {
    ASSERT_EQ(run("--frames 3 --clip-of middle --clip " + path("middle.mp4") + " --snapshot " +
                  path("show")),
              0)
        << log();
    const auto seen = test::readClip(path("middle.mp4"));
    ASSERT_EQ(seen.pictures.size(), 3U);
    const Picture last = readPng(path("show/channel-middle.png"));
    const double off = test::meanCodesBetween(seen.pictures[2], last);
    EXPECT_LT(off, 5);
    EXPECT_LT(off, test::meanCodesBetween(seen.pictures[1], last)) << "another frame is as near";
}

TEST_F(ClipOfAShow, whatCannotBeIsRefusedInOneLineBeforeAnythingStarts) {
    std::ofstream(path("file")) << "in the way";
    for (const auto& [arguments, status, why] :
         {std::tuple{"--clip " + path("a.avi"), 2, "FILE.mp4 or FILE.webp"},
          std::tuple{"--clip " + path("file/a.mp4"), 1, "choose another folder"},
          std::tuple{
              "--clip-of ceiling --clip " + path("a.mp4"), 1, "panorama, hall, left, middle"}}) {
        EXPECT_EQ(run("--frames 2 " + arguments), status) << log();
        EXPECT_THAT(log(), testing::HasSubstr(why));
        EXPECT_EQ(std::ranges::count(log(), '\n'), 1) << log();
    }
}

}  // namespace
}  // namespace aquarama
