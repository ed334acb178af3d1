// SPDX-License-Identifier: Apache-2.0
#include "console/panorama.h"

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/wall/wall.h"
#include "tests/support/source_folder.h"

namespace aquarama::console {
namespace {

namespace fs = std::filesystem;

std::string rigPath(const std::string& name) {
    return test::sourceFolder() + "/config/" + name + ".txtpb";
}

// Of point i of a mesh, in shares; far outside where it is nowhere near.
glm::dvec2 placeOf(const browser::ChannelMesh& mesh, std::size_t i) {
    const auto share = [&](std::size_t at) {
        const auto low = static_cast<unsigned char>(mesh.places()[at]);
        const auto high = static_cast<unsigned char>(mesh.places()[at + 1]);
        return (low + 256 * high) / 32768.0 - 0.5;
    };
    return {share(4 * i), share(4 * i + 2)};
}

// Straight on between the four points about a place of a picture, in shares.
glm::dvec2 drawnAt(const browser::ChannelMesh& mesh, glm::dvec2 share) {
    const glm::dvec2 at = share * glm::dvec2(mesh.columns() - 1, mesh.rows() - 1);
    const glm::uvec2 low =
        glm::min(glm::uvec2(at), glm::uvec2(mesh.columns() - 2, mesh.rows() - 2));
    const glm::dvec2 part = at - glm::dvec2(low);
    const auto point = [&](unsigned x, unsigned y) {
        return placeOf(mesh, (low.y + y) * mesh.columns() + low.x + x);
    };
    return glm::mix(glm::mix(point(0, 0), point(1, 0), part.x),
                    glm::mix(point(0, 1), point(1, 1), part.x),
                    part.y);
}

class PanoramaOfRig : public testing::TestWithParam<const char*> {};

// A browser draws straight between the points of a mesh: that is where the wall has it, to a pixel.
TEST_P(PanoramaOfRig, theMeshesLieWhereTheWallHasThem) {
    const config::Rig rig = config::readRig(rigPath(GetParam()));
    const wall::Wall wall(rig);
    const browser::Panorama panorama = panoramaOf(rig);
    ASSERT_EQ(static_cast<std::size_t>(panorama.meshes_size()), rig.channels.size());
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0, 1);
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        const browser::ChannelMesh& mesh = panorama.meshes(static_cast<int>(i));
        ASSERT_EQ(mesh.places().size(), 4 * mesh.columns() * mesh.rows());
        int seen = 0;
        for (int n = 0; n < 300; ++n) {
            const glm::dvec2 at(share(random), share(random));
            const auto point =
                wall.channel(i).pointOf(at * glm::dvec2(rig.channels[i].sizePixels), 0);
            if (!point) continue;
            ++seen;
            const glm::dvec2 apart = (drawnAt(mesh, at) - wall.screen().unrolled(*point)) *
                                     glm::dvec2(rig.panoramaPixels);
            EXPECT_LT(glm::length(apart), 1) << rig.channels[i].name << " " << at.x << " " << at.y;
        }
        EXPECT_GT(seen, 100) << rig.channels[i].name;
    }
}
// Not of a cave: under the feet of its viewer azimuths turn too fast.
INSTANTIATE_TEST_SUITE_P(
    OfEachShape,
    PanoramaOfRig,
    testing::Values("desk", "flat_3", "wall_2x2", "dome_5", "televisions_3", "measured_3"));

// A camera or a hand moves the picture while the console runs.
TEST(Panorama, isMadeAnewWhenAFileOfTheRigChanges) {
    const fs::path folder =
        fs::temp_directory_path() / ("aquarama-panorama-" + std::to_string(getpid()));
    fs::create_directories(folder);
    const std::string rig = (folder / "desk.txtpb").string();
    const auto write = [&](const fs::path& path, const std::string& text) {
        std::ofstream(path) << text;
    };
    write(rig, config::readTextFile(rigPath("desk")) + "adjustments: \"hand.txtpb\"\n");
    write(folder / "hand.txtpb", "");
    PanoramaWatch watch(rig);
    const auto isMadeWithin = [&](int seconds) {
        for (int i = 0; i < 100 * seconds; ++i) {
            if (watch.update()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    };
    ASSERT_TRUE(isMadeWithin(20));
    const std::string before = watch.panorama().SerializeAsString();
    const std::string first = watch.panorama().meshes(0).places();
    EXPECT_FALSE(isMadeWithin(1)) << "nothing has changed";
    write(folder / "hand.txtpb", "points { channel: \"nobody\" }");
    EXPECT_FALSE(isMadeWithin(1)) << "a mistake leaves it as it was";
    EXPECT_EQ(watch.panorama().SerializeAsString(), before);
    write(folder / "hand.txtpb",
          "points { channel: \"middle\" panorama { x_px: 675 y_px: 300 } right_px: 20 }");
    ASSERT_TRUE(isMadeWithin(20));
    EXPECT_NE(watch.panorama().SerializeAsString(), before);
    EXPECT_EQ(watch.panorama().meshes(0).places(), first);
    fs::remove_all(folder);
}

}  // namespace
}  // namespace aquarama::console
