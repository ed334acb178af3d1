// SPDX-License-Identifier: Apache-2.0
// aquarama-calibrate as a crew uses it: its exit status, its one line on a mistake, its pictures.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "common/base/picture.h"
#include "common/config/rig.h"
#include "tests/support/projected.h"

namespace aquarama::theatre {
namespace {

struct Outcome {
    int status = -1;
    std::string said;  // both streams
};

Outcome calibrate(const std::string& arguments) {
    const std::string command = "\"$AQUARAMA_BIN\"/aquarama-calibrate " + arguments + " 2>&1";
    std::FILE* pipe = popen(command.c_str(), "r");
    Outcome outcome;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe))
        outcome.said += static_cast<char>(c);
    outcome.status = WEXITSTATUS(pclose(pipe));
    return outcome;
}

class Program : public testing::Test {
  protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] std::string written(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return (folder_ / name).string();
    }
    [[nodiscard]] std::string folder() const { return folder_.string(); }

  private:
    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                    ("calibrate-" + std::to_string(getpid()) + "-" +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
};

std::string deskWith(const std::string& good, const std::string& bad) {
    std::ifstream file(AQUARAMA_SOURCE_DIR "/config/desk.txtpb");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    return text.replace(text.find(good), good.size(), bad);
}

TEST_F(Program, checkSaysALineForEachChannelOfAGoodRig) {
    const Outcome outcome = calibrate("check " AQUARAMA_SOURCE_DIR "/config/theatre.txtpb");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.said, testing::HasSubstr("left: lights 60.0 deg left"));
    EXPECT_EQ(std::ranges::count(outcome.said, '\n'), 4);
}

TEST_F(Program, checkRefusesABadRigInOneLine) {
    for (const auto& [good, bad, why] :
         {std::tuple{"height_m:", "heigth_m:", "heigth_m"},
          std::tuple{"id: 2", "id: 1", "taken"},
          std::tuple{"width_px: 480", "width_px: 0", "width_px"},
          std::tuple{"yaw_deg: 39.2", "yaw_deg: 219.2", "projector \"left\" misses the screen"}}) {
        const std::string path = written("bad.txtpb", deskWith(good, bad));
        const Outcome outcome = calibrate("check " + path);
        EXPECT_EQ(outcome.status, 1) << bad;
        EXPECT_THAT(outcome.said, testing::MatchesRegex(".*bad.txtpb:[0-9]+:[0-9]+: .*\n"));
        EXPECT_THAT(outcome.said, testing::HasSubstr(why));
        EXPECT_EQ(std::ranges::count(outcome.said, '\n'), 1) << outcome.said;
    }
}

TEST_F(Program, checkSaysWhatIsInASceneAndInASpecies) {
    const Outcome scene = calibrate("check " AQUARAMA_SOURCE_DIR "/config/scenes/reef.txtpb");
    EXPECT_EQ(scene.status, 0);
    EXPECT_THAT(scene.said, testing::HasSubstr("51 bigeye_scad, prey"));
    EXPECT_THAT(scene.said, testing::HasSubstr("reef.txtpb: good"));
    EXPECT_THAT(scene.said, testing::HasSubstr("tours 6 stops at 0.4 m/s after 20 s"));
    const Outcome species =
        calibrate("check " AQUARAMA_SOURCE_DIR "/config/species/blacktip_reef_shark.txtpb");
    EXPECT_EQ(species.status, 0);
    EXPECT_THAT(species.said, testing::HasSubstr("hunts bigeye_scad"));
}

TEST_F(Program, checkRefusesARigWhoseSceneIsNotThere) {
    const Outcome outcome = calibrate("check " + written("bad.txtpb", deskWith("id: 2", "id: 2")));
    EXPECT_EQ(outcome.status, 1) << "the folder has no scenes/";
    EXPECT_THAT(outcome.said, testing::HasSubstr("scenes/reef.txtpb"));
}

TEST_F(Program, checkRefusesABadSceneAndABadSpeciesInOneLine) {
    for (const std::string text : {"name: \"sea\" place: OPEN_SEA\nplankton: 3 whales: 1",
                                   "name: \"fish\" skeleton {}\nhabits { role: PREY wings: 2 }"}) {
        const Outcome outcome = calibrate("check " + written("bad.txtpb", text));
        EXPECT_EQ(outcome.status, 1);
        EXPECT_THAT(outcome.said, testing::MatchesRegex(".*bad.txtpb:2:[0-9]+: .*\n"));
        EXPECT_EQ(std::ranges::count(outcome.said, '\n'), 1) << outcome.said;
    }
}

TEST_F(Program, composeMakesBothPicturesInTheDepthAskedFor) {
    const std::string rigPath = AQUARAMA_SOURCE_DIR "/config/desk.txtpb";
    const config::Rig rig = config::readRig(rigPath);
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        writePng(folder() + "/channel-" + rig.channels[i].name + ".png",
                 pictureOf(test::projectedLight(rig, i, wall::TestPattern::Grey), 16, 0));
    const Outcome outcome = calibrate("compose " + rigPath + " " + folder() + " --deep");
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    const Picture panorama = readPng(folder() + "/panorama.png");
    EXPECT_EQ(panorama.bits, 16);
    EXPECT_EQ(panorama.sizePixels, rig.panoramaPixels);
    EXPECT_EQ(readPng(folder() + "/hall.png").sizePixels, glm::ivec2(1600, 900));
}

TEST_F(Program, composeNamesAPictureThatIsMissingOrOfAnotherSize) {
    const std::string compose = "compose " AQUARAMA_SOURCE_DIR "/config/desk.txtpb " + folder();
    const Outcome missing = calibrate(compose);
    EXPECT_EQ(missing.status, 1);
    EXPECT_THAT(missing.said, testing::HasSubstr("channel-left.png: cannot be read"));
    writePng(folder() + "/channel-left.png", pictureOf(darkness({7, 5}), 8, 0));
    const Outcome small = calibrate(compose);
    EXPECT_EQ(small.status, 1);
    EXPECT_THAT(small.said, testing::HasSubstr("is 7 x 5 pixels"));
}

TEST_F(Program, withoutACommandItFails) {
    EXPECT_NE(calibrate("").status, 0);
}

}  // namespace
}  // namespace aquarama::theatre
