// SPDX-License-Identifier: Apache-2.0
#include "render_node/reef/ground.h"

#include <algorithm>
#include <cassert>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "common/base/derived_cache.h"
#include "common/place/place.h"
#include "render_node/gl/program.h"
#include "render_node/reef/fade.h"
#include "render_node/reef/mesh.h"
#include "render_node/reef/place_tables.h"
#include "render_node/reef/solid_array.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::scene {

namespace {

static_assert(shaders::kMeanFloorMetres == place::kMeanFloorDepthMetres);

// The sand is a square of 14 x 14 patches about the origin.
constexpr float kPatchMetres = 10.0F;
constexpr int kPatchesASide = 14;
// Half the diagonal of a patch is 0.71 of its side; the rest is for its height.
constexpr float kPatchRadius = kPatchMetres * 0.75F;
// Cells along a side of a patch at each level.
constexpr std::array<int, shaders::kSandLevels> kCells{24, 12, 6};
// How far the rim of a patch hangs down.
constexpr float kRimMetres = 0.35F;
// Side of the map of shade, texels.
constexpr int kShadeTexels = 360;

// Normal of the sand by forward differences over 5 cm.
glm::vec3 sandNormal(std::uint32_t seed, glm::vec2 xz) {
    constexpr float kStep = 0.05F;
    const float here = place::floorHeight({seed}, xz);
    const float slopeX = (place::floorHeight({seed}, {xz.x + kStep, xz.y}) - here) / kStep;
    const float slopeZ = (place::floorHeight({seed}, {xz.x, xz.y + kStep}) - here) / kStep;
    return glm::normalize(glm::vec3{-slopeX, 1.0F, -slopeZ});
}

// As GroundTables::shade.
using ShadeTexel = glm::u8vec4;

// World x and z of a texel's middle, and the texel that holds a coordinate.
glm::vec2 middleOfTexel(int column, int row) {
    return (glm::vec2{column, row} + 0.5F) * (shaders::kFloorShadeMetres / kShadeTexels) -
           shaders::kFloorShadeMetres / 2.0F;
}

int texelAt(float metres) {
    const float texel =
        (metres + shaders::kFloorShadeMetres / 2.0F) * (kShadeTexels / shaders::kFloorShadeMetres);
    return std::clamp(static_cast<int>(texel), 0, kShadeTexels - 1);
}

// Multiplies a stored share by another.
void darken(glm::u8& value, float share) {
    value = static_cast<glm::u8>(static_cast<float>(value) * share);
}

// Adds the shade and the rubble of one rock to the map. A shadow reaches further where the rock
// stands higher above the sand: only the texels within reach are visited.
void shadeSand(std::vector<ShadeTexel>& texels, const place::Rock& rock, float sand) {
    assert(texels.size() == static_cast<std::size_t>(kShadeTexels) * kShadeTexels);
    const float reach = 4.0F * rock.radiusMetres + std::max(rock.centre.y - sand, 0.0F);
    const std::span<const place::Rock> own{&rock, 1};
    const float above = std::max(rock.centre.y - rock.radiusMetres - sand, 0.0F);
    for (int row = texelAt(rock.centre.z - reach); row <= texelAt(rock.centre.z + reach); ++row)
        for (int column = texelAt(rock.centre.x - reach); column <= texelAt(rock.centre.x + reach);
             ++column) {
            const glm::vec2 xz = middleOfTexel(column, row);
            const glm::vec3 place{xz.x, sand, xz.y};
            ShadeTexel& texel = texels[static_cast<std::size_t>(row) * kShadeTexels +
                                       static_cast<std::size_t>(column)];
            darken(texel.r, sunVisibility(own, place));
            darken(texel.g, ambientOcclusion(own, place, {0.0F, 1.0F, 0.0F}));
            // Rubble lies around rocks that stand on the sand, not under those that hang above it.
            const float away = glm::distance(xz, glm::vec2{rock.centre.x, rock.centre.z});
            const float heap = glm::smoothstep(1.9F, 0.75F, away / rock.radiusMetres) *
                               glm::smoothstep(0.5F, 0.0F, above);
            texel.b = std::max(texel.b, static_cast<glm::u8>(255.0F * heap));
        }
}

// The map of all rocks; starts fully open and without rubble.
std::vector<ShadeTexel> bakeShade(const place::PlaceKey& place) {
    std::vector<ShadeTexel> texels(static_cast<std::size_t>(kShadeTexels) * kShadeTexels,
                                   {255, 255, 0, 255});
    for (const place::Rock& rock : place::rocksOf(place))
        shadeSand(texels, rock, place::floorHeight(place, {rock.centre.x, rock.centre.z}));
    return texels;
}

// Uploads the map.
gl::Texture makeShade(const std::vector<ShadeTexel>& texels) {
    assert(texels.size() == static_cast<std::size_t>(kShadeTexels) * kShadeTexels);
    gl::Texture texture = makeTexture(GL_RGBA8, glm::ivec2{kShadeTexels}, 1, Edge::Clamp);
    glTextureSubImage2D(texture.name(),
                        0,
                        0,
                        0,
                        kShadeTexels,
                        kShadeTexels,
                        GL_RGBA,
                        GL_UNSIGNED_BYTE,
                        texels.data());
    return texture;
}

}  // namespace

Mesh layPatch(std::uint32_t seed, glm::vec2 corner, float sideMetres, int cells) {
    assert(sideMetres > 0.0F);
    assert(cells > 0);
    Mesh mesh;
    // The corners of the cells, and the rim on both sides.
    const int width = cells + 3;
    for (int row = 0; row < width; ++row)
        for (int column = 0; column < width; ++column) {
            const glm::ivec2 inside = glm::clamp(glm::ivec2{column, row} - 1, 0, cells);
            const bool rim = inside != glm::ivec2{column, row} - 1;
            const glm::vec2 xz =
                corner + glm::vec2(inside) * (sideMetres / static_cast<float>(cells));
            const float height = place::floorHeight({seed}, xz) - (rim ? kRimMetres : 0.0F);
            addVertex(mesh, {xz.x, height, xz.y}, sandNormal(seed, xz), {}, 1.0F);
        }
    joinRows(mesh, 0, width, width);
    return mesh;
}

namespace {

// A patch at all levels, each with its vertices' places on the next one. Rims go with the edge that
// they hang from.
std::array<Mesh, kCells.size()> layLevels(std::uint32_t seed, glm::vec2 corner) {
    std::array<Mesh, kCells.size()> levels;
    for (std::size_t level = 0; level < kCells.size(); ++level)
        levels.at(level) = layPatch(seed, corner, kPatchMetres, kCells.at(level));
    for (std::size_t level = 0; level < kCells.size(); ++level) {
        const std::size_t next = std::min(level + 1, kCells.size() - 1);
        const int cells = kCells.at(level);
        const auto stepAt = [&](int i) {
            Step step = stepOf(std::clamp(i - 1, 0, cells), cells, kCells.at(next));
            ++step.cell;
            return step;
        };
        const int width = cells + 3;
        Mesh& mesh = levels.at(level);
        for (int i = 0; i < width * width; ++i) {
            const Mesh& coarser = levels.at(next);
            mesh.coarse.push_back(
                pointOn(coarser, coarser.patches.front(), stepAt(i / width), stepAt(i % width)));
            const bool isRim = i % width == 0 || i % width == width - 1 || i / width == 0 ||
                               i / width == width - 1;
            if (isRim) mesh.coarse.back().position.y -= kRimMetres;
        }
    }
    return levels;
}

GroundTables makeGroundTables(const place::PlaceKey& place) {
    GroundTables tables;
    constexpr float kHalf = kPatchMetres * kPatchesASide / 2.0F;
    // Of each level: all patches share its triangles.
    std::array<DrawCommand, kCells.size()> shared{};
    for (std::size_t level = 0; level < kCells.size(); ++level) {
        const Mesh mesh = layPatch(place.seed, {}, kPatchMetres, kCells.at(level));
        shared.at(level).count = static_cast<std::uint32_t>(mesh.indices.size());
        shared.at(level).firstIndex = static_cast<std::uint32_t>(tables.indices.size());
        tables.indices.insert(tables.indices.end(), mesh.indices.begin(), mesh.indices.end());
    }
    for (unsigned i = 0; i < kPatchesASide * kPatchesASide; ++i) {
        const glm::vec2 corner =
            glm::vec2{i % kPatchesASide, i / kPatchesASide} * kPatchMetres - kHalf;
        const glm::vec2 middle = corner + kPatchMetres / 2.0F;
        tables.balls.emplace_back(
            middle.x, place::floorHeight(place, middle), middle.y, kPatchRadius);
        const std::array<Mesh, kCells.size()> levels = layLevels(place.seed, corner);
        for (std::size_t level = 0; level < kCells.size(); ++level) {
            const Mesh& mesh = levels.at(level);
            DrawCommand& draw = tables.draws.emplace_back(shared.at(level));
            draw.baseVertex = static_cast<std::int32_t>(tables.vertices.size());
            draw.baseInstance = i;
            tables.coarse.insert(tables.coarse.end(), mesh.coarse.begin(), mesh.coarse.end());
            tables.vertices.insert(
                tables.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        }
    }
    tables.shade = bakeShade(place);
    return tables;
}

}  // namespace

GroundTables groundTables(const place::PlaceKey& place) {
    return derivedTables<GroundTables>(derivedKey("ground", place),
                                       [&] { return makeGroundTables(place); });
}

Ground::Ground(const GroundTables& tables, const LightQuality& light)
    : cull_{gl::makeProgram({"sand_cull.comp"})},
      program_{light.isFine ? gl::makeProgram({"floor.vert", "floor.frag"}, replacementsOf(light))
                            : gl::makeProgram({"floor_plain.vert", "floor_plain.frag"})},
      detail_{makeTexture(sandTile())},
      rubble_{makeTexture(rockTile())},
      shade_{makeShade(tables.shade)} {
    fillBuffers(tables);
}

// The vertex attribute kFadedAttribute advances once for each instance, a patch; from
// kCoarseAttribute on are the members of CoarseVertex.
void Ground::fillBuffers(const GroundTables& tables) {
    assert(tables.draws.size() == shaders::kSandLevels * tables.balls.size());
    patchCount_ = static_cast<unsigned>(tables.balls.size());
    setSolids(array_, vertices_, indices_, tables.vertices, tables.indices);
    coarse_ = gl::makeBuffer(tables.coarse, "sand of the coarser level");
    attachCoarse(array_, coarse_);
    balls_ = gl::makeBuffer(tables.balls, "sand patches");
    draws_ = gl::makeBuffer(tables.draws, "sand draws");
    commands_ = gl::makeBuffer(patchCount_ * sizeof(DrawCommand), "sand commands");
    faded_ = gl::makeBuffer(patchCount_ * sizeof(float), "sand faded");
    constexpr unsigned kFaded = shaders::kFadedAttribute;
    glVertexArrayVertexBuffer(array_.name(), kFaded, faded_.name(), 0, sizeof(float));
    glVertexArrayBindingDivisor(array_.name(), kFaded, 1);
    glEnableVertexArrayAttrib(array_.name(), kFaded);
    glVertexArrayAttribFormat(array_.name(), kFaded, 1, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array_.name(), kFaded, kFaded);
}

// A very long reach selects the finest level everywhere.
void Ground::cull(const PlaceRule& rule, glm::vec3 sharedEyeMetres, float reach) const {
    assert(reach > 0.0F);
    const gl::Stage stage{"place cull"};
    glUseProgram(cull_.name());
    glUniform1ui(shaders::kGroupCountLocation, patchCount_);
    glUniform1i(shaders::kCullingLocation, rule.culling ? 1 : 0);
    glUniform1f(shaders::kPatchReachLocation, rule.levelsOfDetail ? reach : 1.0e6F);
    glUniform3fv(shaders::kPatchEyeLocation, 1, glm::value_ptr(sharedEyeMetres));
    gl::bindStorage(shaders::kGroupsStorage, balls_);
    gl::bindStorage(shaders::kPatchLevelsStorage, draws_);
    gl::bindStorage(shaders::kCommandsStorage, commands_);
    gl::bindStorage(shaders::kFadedStorage, faded_);
    glDispatchCompute((patchCount_ + shaders::kGroupSize - 1) / shaders::kGroupSize, 1, 1);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

void Ground::draw() const {
    glUseProgram(program_.name());
    glBindTextureUnit(shaders::kDetailTileUnit, detail_.name());
    glBindTextureUnit(shaders::kFloorShadeUnit, shade_.name());
    glBindTextureUnit(shaders::kFloorRockUnit, rubble_.name());
    drawPatches();
}

gl::ProgramHandle Ground::depthProgram() {
    return gl::makeProgram({"floor.vert"});
}

void Ground::drawDepths(const gl::ProgramHandle& program) const {
    glUseProgram(program.name());
    drawPatches();
}

void Ground::drawPatches() const {
    glBindVertexArray(array_.name());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.name());
    drawCommands(0, static_cast<GLsizei>(patchCount_));
}

}  // namespace aquarama::scene
