// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/reef.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "render_node/gl/program.h"
#include "render_node/scene/coral_mesh.h"
#include "render_node/scene/rock_mesh.h"
#include "render_node/scene/solid_array.h"
#include "render_node/scene/solid_noise.h"

namespace aquarama {

namespace {

constexpr std::array<float, kReefLevels - 1> kLevelMetres{6.5F, 11.0F, 18.0F, 27.0F};
constexpr float kGrowthShare = 1.45F;  // of the rock's radius: how far its corals reach

// The small ones are lost in the water.
constexpr std::array<float, kReefLevels> kLeastShare{0.0F, 0.0F, 0.1F, 0.3F, 0.55F};

// Cover is what makes rock look alive: about a coral for every hand's breadth of its top.
void addCorals(ReefMesh& mesh, const Rock& rock, int level) {
    const auto count = static_cast<int>(6.0F + 46.0F * std::pow(rock.radiusMetres, 1.35F));
    Dice dice{hashOf(rock.seed, 77)};
    for (const Spot& spot : spotsOn(rock, count)) {
        const float share = dice.unit();
        const float size =
            (0.16F + 0.34F * share * share) * (0.6F + 0.35F * std::sqrt(rock.radiusMetres));
        const std::uint32_t seed = dice.seed();
        if (share < kLeastShare.at(static_cast<std::size_t>(level))) continue;
        addCoral(mesh, spot, size, seed, std::min(level, 3));
    }
}

}  // namespace

ReefMesh growBoulder(const Rock& rock, int level) {
    ReefMesh mesh;
    addBoulder(mesh.stone, rock, level);
    addCorals(mesh, rock, level);
    return mesh;
}

Reef::Range Reef::append(Mesh& all, const Mesh& mesh) {
    const Range range{all.indices.size() * sizeof(std::uint32_t),
                      static_cast<int>(mesh.indices.size()),
                      static_cast<int>(all.vertices.size())};
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    all.indices.insert(all.indices.end(), mesh.indices.begin(), mesh.indices.end());
    return range;
}

Reef::Reef(std::uint32_t seed)
    : stoneProgram_{gl::makeProgram({"rock.vert", "rock.frag"})},
      growthProgram_{gl::makeProgram({"coral.vert", "lit.frag"})},
      detail_{makeTexture(rockTile())} {
    const std::vector<Rock> rocks = rocksOf({seed});
    Mesh all;
    for (const Rock& rock : rocks) {
        Boulder& boulder = boulders_.emplace_back();
        boulder.centre = rock.centre;
        boulder.radiusMetres = rock.radiusMetres * kGrowthShare;
        const std::size_t finest = finestLevelOf(rock.centre, kLevelMetres);
        for (std::size_t level = finest; level < kReefLevels; ++level) {
            const ReefMesh mesh = growBoulder(rock, static_cast<int>(level));
            boulder.stone[level] = append(all, mesh.stone);
            boulder.growth[level] = append(all, mesh.growth);
        }
        std::fill_n(boulder.stone.begin(), finest, boulder.stone[finest]);
        std::fill_n(boulder.growth.begin(), finest, boulder.growth[finest]);
    }
    setSolids(array_, vertices_, indices_, all);
}

void Reef::draw(const Viewpoint& viewpoint) {
    inView_.clear();
    for (const Boulder& boulder : boulders_)
        if (viewpoint.sees(boulder.centre, boulder.radiusMetres)) inView_.push_back(&boulder);
    // Near ones first: what they hide is never shaded.
    std::ranges::sort(inView_, {}, [&](const Boulder* boulder) {
        return glm::distance(boulder->centre, viewpoint.eyeMetres);
    });
    glBindTextureUnit(14, detail_.name());
    glBindVertexArray(array_.name());
    glUseProgram(growthProgram_.name());
    drawPart(viewpoint, &Boulder::growth);
    glUseProgram(stoneProgram_.name());
    glEnable(GL_CULL_FACE);
    drawPart(viewpoint, &Boulder::stone);
    glDisable(GL_CULL_FACE);
}

void Reef::drawPart(const Viewpoint& viewpoint,
                    std::array<Range, kReefLevels> Boulder::*part) const {
    for (const Boulder* boulder : inView_) {
        const Range& range = (boulder->*part)[viewpoint.levelOf(boulder->centre, kLevelMetres)];
        glDrawElementsBaseVertex(GL_TRIANGLES,
                                 range.count,
                                 GL_UNSIGNED_INT,
                                 byteOffset(range.firstByte),
                                 range.firstVertex);
    }
}

}  // namespace aquarama
