// SPDX-License-Identifier: Apache-2.0
// aquarama-compose as a crew uses it: its exit status, its one line on a mistake, its pictures.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "common/base/picture.h"
#include "common/config/rig.h"
#include "tests/support/projected.h"

namespace aquarama::compose {
namespace {

struct Outcome {
    int status = -1;
    std::string said;  // both streams
};

Outcome compose(const std::string& arguments) {
    const std::string command = "\"$AQUARAMA_BIN\"/aquarama-compose " + arguments + " 2>&1";
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
    const Outcome outcome = compose("check " AQUARAMA_SOURCE_DIR "/config/theatre.txtpb");
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
        const Outcome outcome = compose("check " + path);
        EXPECT_EQ(outcome.status, 1) << bad;
        EXPECT_THAT(outcome.said, testing::MatchesRegex(".*bad.txtpb:[0-9]+:[0-9]+: .*\n"));
        EXPECT_THAT(outcome.said, testing::HasSubstr(why));
        EXPECT_EQ(std::ranges::count(outcome.said, '\n'), 1) << outcome.said;
    }
}

TEST_F(Program, checkSaysWhatIsInASceneAndInASpecies) {
    const Outcome scene = compose("check " AQUARAMA_SOURCE_DIR "/config/scenes/reef.txtpb");
    EXPECT_EQ(scene.status, 0);
    EXPECT_THAT(scene.said, testing::HasSubstr("51 bigeye_scad, prey"));
    EXPECT_THAT(scene.said, testing::HasSubstr("reef.txtpb: good"));
    EXPECT_THAT(scene.said, testing::HasSubstr("tours 5 stops at 0.4 m/s after 20 s"));
    const Outcome species =
        compose("check " AQUARAMA_SOURCE_DIR "/config/species/blacktip_reef_shark.txtpb");
    EXPECT_EQ(species.status, 0);
    EXPECT_THAT(species.said, testing::HasSubstr("hunts bigeye_scad"));
}

TEST_F(Program, checkRefusesARigWhoseSceneIsNotThere) {
    const Outcome outcome = compose("check " + written("bad.txtpb", deskWith("id: 2", "id: 2")));
    EXPECT_EQ(outcome.status, 1) << "the folder has no scenes/";
    EXPECT_THAT(outcome.said, testing::HasSubstr("scenes/reef.txtpb"));
}

TEST_F(Program, checkRefusesABadSceneAndABadSpeciesInOneLine) {
    for (const std::string text :
         {"name: \"sea\" place: OPEN_SEA\nplankton: 3 whales: 1",
          "version: 2 name: \"fish\" skeleton {}\nhabits { role: PREY wings: 2 }"}) {
        const Outcome outcome = compose("check " + written("bad.txtpb", text));
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
    const Outcome outcome = compose("compose " + rigPath + " " + folder() + " --deep");
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    const Picture panorama = readPng(folder() + "/panorama.png");
    EXPECT_EQ(panorama.bits, 16);
    EXPECT_EQ(panorama.sizePixels, rig.panoramaPixels);
    EXPECT_EQ(readPng(folder() + "/hall.png").sizePixels, glm::ivec2(1600, 900));
}

TEST_F(Program, composeNamesAPictureThatIsMissingOrOfAnotherSize) {
    const std::string arguments = "compose " AQUARAMA_SOURCE_DIR "/config/desk.txtpb " + folder();
    const Outcome missing = compose(arguments);
    EXPECT_EQ(missing.status, 1);
    EXPECT_THAT(missing.said, testing::HasSubstr("channel-left.png: cannot be read"));
    writePng(folder() + "/channel-left.png", pictureOf(darkness({7, 5}), 8, 0));
    const Outcome small = compose(arguments);
    EXPECT_EQ(small.status, 1);
    EXPECT_THAT(small.said, testing::HasSubstr("is 7 x 5 pixels"));
}

const std::string kDesk = AQUARAMA_SOURCE_DIR "/config/desk.txtpb";

// The grid, as render nodes send it.
void writeGrid(const std::string& folder) {
    const config::Rig rig = config::readRig(kDesk);
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        writePng(folder + "/channel-" + rig.channels[i].name + ".png",
                 pictureOf(test::projectedLight(rig, i, wall::TestPattern::Grid), 8, 0));
}

double meanDifference(const Picture& one, const Picture& other) {
    double sum = 0;
    for (std::size_t i = 0; i < one.rgb.size(); ++i)
        sum += std::abs(double(one.rgb[i]) - double(other.rgb[i]));
    return sum / static_cast<double>(one.rgb.size());
}

TEST_F(Program, viewWithoutAHallIsTheSnapshotsHall) {
    writeGrid(folder());
    ASSERT_EQ(compose("compose " + kDesk + " " + folder()).status, 0);
    const Outcome outcome = compose("view " + kDesk + " --frame " + folder() +
                                    " --view hall --out " + folder() + "/seen.png");
    ASSERT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_EQ(outcome.said, "");
    EXPECT_LT(meanDifference(readPng(folder() + "/seen.png"), readPng(folder() + "/hall.png")),
              0.1);
}

// A hall that is as the rig says shows what the rig shows; a projector that hangs crooked does not.
TEST_F(Program, viewThrowsPicturesAsTheHallHangs) {
    writeGrid(folder());
    const std::string camera =
        "camera { position { x_m: 0.5 z_m: 2 } look_at { z_m: -2.6 } width_px: 320 height_px: 180 "
        "focal_px: 150 }\n";
    const std::string see = "view " + kDesk + " --frame " + folder();
    const auto seen = [&](const std::string& arguments) {
        const Outcome outcome = compose(see + arguments + " --out " + folder() + "/seen.png");
        EXPECT_EQ(outcome.status, 0) << outcome.said;
        return readPng(folder() + "/seen.png");
    };
    const std::string straight = written("straight.txtpb", camera);
    const std::string crooked =
        written("crooked.txtpb", camera + "projectors { channel: \"middle\" yaw_deg: 2 }\n");
    const Picture rig = seen(" --view hall");
    EXPECT_LT(meanDifference(seen(" --view hall --hall " + straight), rig), 1);
    EXPECT_GT(meanDifference(seen(" --view hall --hall " + crooked), rig), 4);
    const Picture byCamera = seen(" --view camera --hall " + straight);
    EXPECT_EQ(byCamera.sizePixels, glm::ivec2(320, 180));
    EXPECT_GT(*std::ranges::max_element(byCamera.rgb), 100);
    EXPECT_GT(meanDifference(byCamera, seen(" --view camera --hall " + crooked)), 2);
}

// Without pictures of channels a panorama is drawn as nodes draw it.
TEST_F(Program, viewDrawsAPanorama) {
    const config::Rig rig = config::readRig(kDesk);
    writePng(folder() + "/panorama.png",
             pictureOf(test::directPanorama(rig, wall::TestPattern::Grid), 16, 0));
    const std::string pictures = folder() + "/pictures";
    std::filesystem::create_directory(pictures);
    writeGrid(pictures);
    const std::string end = " --view camera --out " + folder() + "/seen.png";
    ASSERT_EQ(compose("view " + kDesk + " --frame " + folder() + end).status, 0);
    const Picture drawn = readPng(folder() + "/seen.png");
    ASSERT_EQ(compose("view " + kDesk + " --frame " + pictures + end).status, 0);
    EXPECT_LT(meanDifference(drawn, readPng(folder() + "/seen.png")), 1.5);
}

TEST_F(Program, viewRefusesWhatDoesNotFitInOneLine) {
    writePng(folder() + "/panorama.png", pictureOf(darkness({64, 32}), 8, 0));
    std::filesystem::create_directory(folder() + "/empty");
    std::filesystem::create_directory(folder() + "/sent");
    writePng(folder() + "/sent/channel-left.png", pictureOf(darkness({64, 32}), 8, 0));
    const std::string frame = " --frame " + folder(), out = " --out " + folder() + "/seen.png";
    const std::string hall = " --view hall";
    for (const auto& [arguments, why] :
         {std::pair{kDesk + frame + hall + out + " --hall random:x", "\"x\" is no seed"},
          std::pair{kDesk + frame + hall + out + " --hall none.txtpb", "none.txtpb"},
          std::pair{kDesk + frame + hall + out + " --wall none.mpcdi", "none.mpcdi"},
          std::pair{kDesk + frame + hall + out + " --wall " + kDesk, "desk.txtpb"},
          std::pair{kDesk + frame + "/empty" + hall + out, "channel-left.png: cannot be read"},
          std::pair{kDesk + frame + "/sent" + hall + out + " --hall random:7 --wall x.mpcdi",
                    "sent has pictures of channels"},
          std::pair{kDesk + frame + hall + " --out /dev/null/x.png", "--out"},
          std::pair{std::string("none.txtpb") + frame + hall + out, "none.txtpb"}}) {
        const Outcome outcome = compose("view " + arguments);
        EXPECT_EQ(outcome.status, 1) << arguments;
        EXPECT_THAT(outcome.said, testing::HasSubstr(why));
        EXPECT_EQ(std::ranges::count(outcome.said, '\n'), 1) << outcome.said;
    }
    EXPECT_EQ(compose("view " + kDesk + frame + " --view roof" + out).status, 2);
    EXPECT_EQ(compose("view " + kDesk + frame + hall).status, 2);
}

TEST_F(Program, withoutACommandItFails) {
    EXPECT_NE(compose("").status, 0);
}

}  // namespace
}  // namespace aquarama::compose
