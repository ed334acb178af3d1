// SPDX-License-Identifier: Apache-2.0
// What nodes send is what the wall's warp and blend say, or the masks and colours of a wall file.
#include "calibration/hall/drawn_wall.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "common/formats/mpcdi.h"
#include "tests/support/projected.h"
#include "tests/support/source_folder.h"

namespace aquarama::hall {
namespace {

config::Rig desk() {
    return config::readRig(test::sourceFolder() + "/config/desk.txtpb");
}

TEST(DrawnWall, sendsTheGridAsItsWarpAndBlendSay) {
    const config::Rig rig = desk();
    const DrawnWall wall(rig);
    const std::vector<Light> pictures = wall.pictures(gridContent(wall.wall()));
    ASSERT_EQ(pictures.size(), rig.channels.size());
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const Light truth = test::projectedLight(rig, i, wall::TestPattern::Grid);
        for (std::size_t k = 0; k < truth.rgb.size(); k += 7)
            ASSERT_NEAR(pictures[i].rgb[k].g, truth.rgb[k].g, 1e-4);
    }
}

// A file with one even region: its blend, black level and colour are seen in what is sent.
TEST(DrawnWall, takesMasksAndColourOfAWallFile) {
    const config::Rig rig = desk();
    formats::WallFile file;
    file.profile = formats::Profile::Content;
    for (const config::Channel& channel : rig.channels) {
        formats::FileChannel region;
        region.name = channel.name;
        region.sizePixels = channel.sizePixels;
        region.warp = {.size = {2, 2},
                       .sampling = formats::Sampling::Nodes,
                       .samples = {{0.2, 0.2, 0}, {0.8, 0.2, 0}, {0.2, 0.8, 0}, {0.8, 0.8, 0}}};
        region.blend = {.size = {1, 1}, .bits = 16, .codes = {32768}};
        region.black = {.size = {1, 1}, .bits = 16, .codes = {6554}};
        region.colour = {.mix = glm::mat3(0.5F), .response = {}};
        for (auto& response : region.colour->response) response = {0, 0.25F, 1};
        file.channels.push_back(region);
    }
    const std::string path = testing::TempDir() + "drawn-" + std::to_string(getpid()) + ".mpcdi";
    formats::writeMpcdi(path, file, 2);
    const DrawnWall wall(withWallFile(rig, path));
    std::filesystem::remove(path);
    const glm::vec3 sent =
        wall.sent(0, {100, 100}, [](glm::dvec3) { return glm::vec3(0.4F, 0.8F, 1); });
    for (int c = 0; c < 3; ++c) {
        const double light = std::array{0.4, 0.8, 1.0}.at(static_cast<std::size_t>(c)) * 0.5;
        const double own = 0.5 * (light * 0.9 + 0.1);
        const double code = own < 0.25 ? own / 0.25 * 0.5 : 0.5 + (own - 0.25) / 0.75 * 0.5;
        EXPECT_NEAR(sent[c], linearFromSrgb(code), 2e-3) << c;
    }
}

}  // namespace
}  // namespace aquarama::hall
