// SPDX-License-Identifier: Apache-2.0
// What a visitor could see of the levels of detail of the place: corners of their meshes, and jumps
// from one to the next.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

#include <epoxy/gl.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "render_node/gl/context.h"
#include "render_node/quality/quality.h"
#include "render_node/reef/reef.h"
#include "render_node/scene/scene.h"
#include "tests/support/still.h"

namespace aquarama::scene {
namespace {

const Library& library() {
    static const Library all = growLibrary();
    return all;
}

// How far the smooth curve through three vertices in a row of a mesh lies from its edges, for a
// scale of 1: a quarter of the middle one's distance from the middle of the others.
float cornerAt(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    return glm::distance(b, 0.5F * (a + c)) / 4.0F;
}

void addCorners(std::vector<float>& corners, const Mesh& mesh, const Patch& patch) {
    const auto at = [&](int row, int column) {
        return mesh.vertices[patch.first + static_cast<std::size_t>(row * patch.columns + column)]
            .position;
    };
    for (int row = 0; row < patch.rows; ++row)
        for (int column = 0; column < patch.columns; ++column) {
            if (row > 0 && row + 1 < patch.rows)
                corners.push_back(
                    cornerAt(at(row - 1, column), at(row, column), at(row + 1, column)));
            if (column > 0 && column + 1 < patch.columns)
                corners.push_back(
                    cornerAt(at(row, column - 1), at(row, column), at(row, column + 1)));
        }
}

// The median corner of a level, for a scale of 1.
float cornerOf(std::size_t prototype, std::size_t level) {
    const Mesh& mesh = library().at(prototype).at(level);
    std::vector<float> corners;
    for (const Patch& patch : mesh.patches) addCorners(corners, mesh, patch);
    if (corners.empty()) return 0.0F;
    std::ranges::sort(corners);
    return corners[corners.size() / 2];
}

// Rock and the forms that are smooth in nature.
std::vector<std::size_t> smoothPrototypes() {
    std::vector<std::size_t> all(kRockShapes);
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (const Form form : {Form::Brain,
                            Form::Lobes,
                            Form::Leaves,
                            Form::Crust,
                            Form::Turf,
                            Form::Kelp,
                            Form::Seagrass})
        for (int shape = 0; shape < kShapesOfForm; ++shape) all.push_back(prototypeOf(form, shape));
    return all;
}

// Where a level is largest, just before a finer one is drawn. The finest has no such end.
TEST(Levels, haveCornersOfAboutAPixel) {
    for (const auto tier : {config::QualityTier::Low, config::QualityTier::Medium}) {
        const Quality quality = qualityOf(tier);
        for (const std::size_t prototype : smoothPrototypes())
            for (std::size_t level = 1; level < kLevels; ++level) {
                const float pixels = leastPixelsOf(prototype).at(level - 1) / quality.placeDetail;
                EXPECT_LT(cornerOf(prototype, level) * pixels * quality.pictureShare, 1.5F)
                    << "prototype " << prototype << " level " << level;
            }
    }
}

// Every vertex of the next level is there bit by bit.
TEST(Levels, fadeIntoTheShapeOfTheNextOne) {
    for (std::size_t shape = 0; shape < kRockShapes; ++shape)
        for (std::size_t level = 0; level + 1 < kLevels; ++level) {
            const Levels& levels = library().at(shape);
            std::vector<glm::vec3> faded;
            for (const CoarseVertex& vertex : levels.at(level).coarse)
                faded.push_back(vertex.position);
            for (const SolidVertex& vertex : levels.at(level + 1).vertices)
                ASSERT_NE(std::ranges::find(faded, vertex.position), faded.end())
                    << "shape " << shape << " level " << level;
        }
}

// The picture of one view while the shared eye, from which levels follow, goes elsewhere.
class Retreat {
  public:
    explicit Retreat(config::QualityTier tier) {
        SceneOptions options;
        options.quality = tier;
        options.pixelRadians = test::pixelRadiansOf(camera_);
        scene_ =
            std::make_unique<SceneRenderer>(options, std::span<const surface::SchoolSpecies>{});
    }
    // Display light, in codes.
    std::vector<glm::vec3> seenFrom(float metresBack) {
        SceneFrame frame;
        frame.timeSeconds = 12.0;
        frame.eyePositionMetres = camera_.eyeMetres + glm::vec3{0.0F, 0.0F, metresBack};
        scene_->update(frame);
        const unsigned texture = scene_->draw(test::viewOf(camera_));
        const glm::ivec2 size = camera_.sizePixels;
        std::vector<glm::vec3> pixels(static_cast<std::size_t>(size.x * size.y));
        glGetTextureImage(texture,
                          0,
                          GL_RGB,
                          GL_FLOAT,
                          static_cast<GLsizei>(pixels.size() * sizeof(glm::vec3)),
                          pixels.data());
        return pixels;
    }
    [[nodiscard]] glm::ivec2 size() const { return camera_.sizePixels; }

  private:
    test::Camera camera_{.azimuthDegrees = -50.0F, .sizePixels = {480, 270}};
    std::unique_ptr<SceneRenderer> scene_;
};

constexpr int kBlock = 16;

// The greatest mean change of a block of pixels, codes.
float greatestChange(const std::vector<glm::vec3>& a,
                     const std::vector<glm::vec3>& b,
                     glm::ivec2 size) {
    std::vector<float> blocks(
        static_cast<std::size_t>((size.x / kBlock + 1) * (size.y / kBlock + 1)));
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const auto i = static_cast<std::size_t>(y * size.x + x);
            const glm::vec3 d = glm::abs(a[i] - b[i]);
            blocks[static_cast<std::size_t>(y / kBlock * (size.x / kBlock) + x / kBlock)] +=
                (d.r + d.g + d.b) * 255.0F / 3.0F / (kBlock * kBlock);
        }
    return *std::ranges::max_element(blocks);
}

// One step may change more: where a pale plate's light goes from its pixels to its corners, which
// the fading of shapes does not cover (5.4 codes). Without fading several do.
TEST(Fading, noLevelOfThePlaceJumpsButWhereItsLightGoesToItsCorners) {
    const auto context = gl::makeOffscreenContext("mesa", {16, 16});
    Retreat retreat{config::QualityTier::Low};
    // Codes. Without fading some corals change by 5 at once.
    constexpr float kMost = 3.4F;
    std::vector<glm::vec3> before = retreat.seenFrom(0.0F);
    int jumps = 0;
    for (int step = 1; step <= 60; ++step) {
        const std::vector<glm::vec3> now = retreat.seenFrom(0.02F * static_cast<float>(step));
        jumps += greatestChange(before, now, retreat.size()) < kMost ? 0 : 1;
        before = now;
    }
    EXPECT_LE(jumps, 1);
}

}  // namespace
}  // namespace aquarama::scene
