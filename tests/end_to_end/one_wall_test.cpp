// SPDX-License-Identifier: Apache-2.0
// Real nodes draw the channels of a rig; what they throw on the simulated screen must be one
// picture.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "calibration/compose/compose.h"
#include "common/base/units.h"
#include "common/config/rig.h"
#include "common/wall/wall.h"
#include "tests/end_to_end/free_port.h"
#include "tests/support/panorama_measure.h"
#include "tests/support/projected.h"

namespace aquarama {
namespace {

namespace fs = std::filesystem;

// One of config/*.txtpb on ports of its own, its pictures in a folder that goes with it.
class Installation {
  public:
    explicit Installation(const std::string& name)
        : folder_{fs::temp_directory_path() / ("aquarama-wall-" + name)} {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        rig_ = config::parseRig(rigOnFreePorts(name), name);
        std::ofstream(folder_ / "rig.txtpb") << rig_.text;
        for (const auto& [file, content] : rig_.files)
            fs::copy_file(fs::path(AQUARAMA_SOURCE_DIR "/config") / file, folder_ / file);
        config::readRigFiles(rig_, (folder_ / "rig.txtpb").string());
    }
    ~Installation() { fs::remove_all(folder_); }
    Installation(const Installation&) = delete;
    Installation& operator=(const Installation&) = delete;

    // The light of each channel after two frames of a pattern, before an empty sea, which is soon
    // prepared.
    std::vector<Light> showPattern(const std::string& arguments) const {
        return show("--scene " AQUARAMA_SOURCE_DIR "/config/scenes/empty_sea.txtpb --pattern " +
                    arguments);
    }
    // The light of each channel after two frames of the show.
    std::vector<Light> show(const std::string& arguments) const {
        const std::string command = std::string(getenv("AQUARAMA_BIN")) + "/aquarama run " +
                                    (folder_ / "rig.txtpb").string() +
                                    " --headless --frames 2 --snapshot " + folder_.string() + " " +
                                    arguments + " > " + (folder_ / "log").string() + " 2>&1";
        EXPECT_EQ(std::system(command.c_str()), 0) << log();
        return compose::readChannels(rig_, folder_.string());
    }
    [[nodiscard]] const config::Rig& rig() const { return rig_; }

  private:
    [[nodiscard]] std::string log() const {
        std::ifstream file(folder_ / "log");
        return {std::istreambuf_iterator<char>(file), {}};
    }
    fs::path folder_;
    config::Rig rig_;
};

class OneWall : public testing::TestWithParam<const char*> {};

TEST_P(OneWall, everyLineOfTheGridIsWhereADirectRenderHasIt) {
    const Installation installation(GetParam());
    const Light composed =
        compose::composePanorama(installation.rig(), installation.showPattern("grid --deep"));
    const auto offsets =
        test::lineOffsets(installation.rig(),
                          composed,
                          test::directPanorama(installation.rig(), wall::TestPattern::Grid));
    ASSERT_GT(offsets.size(), 500U);
    double worst = 0;
    for (const test::LineOffset& line : offsets)
        worst = std::max(worst, std::abs(line.offsetPixels));
    RecordProperty("worst_px", std::to_string(worst));
    EXPECT_LT(worst, 0.5);
}

TEST_P(OneWall, flatGreyStaysFlatAcrossTheOverlaps) {
    const Installation installation(GetParam());
    const auto deep = installation.showPattern("grey --deep");
    EXPECT_LT(test::unevenness(compose::composePanorama(installation.rig(), deep), 1), 0.01);
    const auto dithered = installation.showPattern("grey");
    EXPECT_LT(test::unevenness(compose::composePanorama(installation.rig(), dithered), 16), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Rigs, OneWall, testing::Values("theatre", "touring"));

// Screens of other shapes, and panels.
class AnyScreen : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(
    Rigs,
    AnyScreen,
    testing::Values("flat_3", "wall_2x2", "dome_5", "measured_3", "cave_4", "televisions_3"));

// Light where the panorama shows screen. What surrounds the eye is left out near its poles, where a
// pixel of the panorama is a small part of one on the screen, and the lines run together.
Light measuredPart(const config::Rig& rig) {
    constexpr double kHighest = 75 * kRadiansPerDegree<double>;
    Light part = test::directPanorama(rig, wall::TestPattern::Grey);
    const wall::Wall wall(rig);
    if (rig.screen.shape != config::ScreenShape::Panels) return part;
    for (int y = 0; y < part.sizePixels.y; ++y)
        for (int x = 0; x < part.sizePixels.x; ++x) {
            const auto point =
                wall.screen().at((glm::dvec2(x, y) + 0.5) / glm::dvec2(part.sizePixels));
            if (point && std::abs(wall::elevationOf(*point - rig.sweetSpotMetres)) > kHighest)
                part.at(x, y) = glm::vec3(0);
        }
    return part;
}

TEST_P(AnyScreen, everyLineOfTheGridIsWhereADirectRenderHasItAndGreyIsFlat) {
    const Installation installation(GetParam());
    const config::Rig& rig = installation.rig();
    const Light grid = compose::composePanorama(rig, installation.showPattern("grid --deep"));
    const Light screen = measuredPart(rig);
    const auto offsets =
        test::windowOffsets(grid, test::directPanorama(rig, wall::TestPattern::Grid), screen);
    ASSERT_GT(offsets.size(), 500U);
    double worst = 0;
    for (const double offset : offsets) worst = std::max(worst, std::abs(offset));
    RecordProperty("worst_px", std::to_string(worst));
    EXPECT_LT(worst, 0.5);
    const Light grey = compose::composePanorama(rig, installation.showPattern("grey --deep"));
    EXPECT_LT(test::unevennessOn(grey, screen), 0.01);
}

// The scene as one channel alone shows it on the panorama: its light, freed of its blend.
class Alone {
  public:
    Alone(const config::Rig& rig, const std::vector<Light>& channels, std::size_t channel)
        : rig_{rig}, wall_{rig}, channel_{channel} {
        std::vector<Light> only = channels;
        for (std::size_t other = 0; other < only.size(); ++other) {
            if (other != channel) only[other] = darkness(only[other].sizePixels);
        }
        panorama_ = compose::composePanorama(rig, only);
    }
    [[nodiscard]] double weight(glm::ivec2 at) const {
        const glm::dvec2 unrolledAt = (glm::dvec2(at) + 0.5) / glm::dvec2(rig_.panoramaPixels);
        return wall_.weight(channel_, wall_.screen().at(unrolledAt).value());
    }
    [[nodiscard]] double green(glm::ivec2 at) const {
        return static_cast<double>(panorama_.at(at.x, at.y).g) / weight(at);
    }

  private:
    const config::Rig& rig_;
    wall::Wall wall_;
    std::size_t channel_;
    Light panorama_;
};

// How far the one picture must be moved to lie on the other, by one least-squares step (Lucas and
// Kanade 1981).
glm::dvec2 displacement(const Alone& first,
                        const Alone& second,
                        const std::vector<glm::ivec2>& overlap) {
    glm::dmat2 normal(0.0);
    glm::dvec2 right(0.0);
    for (const glm::ivec2 at : overlap) {
        const glm::dvec2 slope{
            (first.green(at + glm::ivec2(1, 0)) - first.green(at - glm::ivec2(1, 0))) / 2,
            (first.green(at + glm::ivec2(0, 1)) - first.green(at - glm::ivec2(0, 1))) / 2};
        normal += glm::outerProduct(slope, slope);
        right += slope * (first.green(at) - second.green(at));
    }
    return glm::inverse(normal) * right;
}

TEST(Neighbours, showTheSameFishAtTheSamePlaceOfTheScreen) {
    const Installation installation("touring");  // its overlaps are wide
    const config::Rig& rig = installation.rig();
    const auto channels = installation.show("--fish 2000 --deep");
    for (std::size_t left = 0; left + 1 < rig.channels.size(); ++left) {
        const Alone first(rig, channels, left);
        const Alone second(rig, channels, left + 1);
        std::vector<glm::ivec2> overlap;
        for (int y = 4; y < rig.panoramaPixels.y - 4; y += 2) {
            for (int x = 4; x < rig.panoramaPixels.x - 4; x += 2) {
                if (std::min(first.weight({x, y}), second.weight({x, y})) > 0.25)
                    overlap.emplace_back(x, y);
            }
        }
        ASSERT_GT(overlap.size(), 2000U);
        const glm::dvec2 moved = displacement(first, second, overlap);
        EXPECT_LT(glm::length(moved), 0.25) << "channels " << left << " and " << left + 1;
    }
}

}  // namespace
}  // namespace aquarama
