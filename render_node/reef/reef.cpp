// SPDX-License-Identifier: Apache-2.0
#include "render_node/reef/reef.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <thread>
#include <tuple>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/base/derived_cache.h"
#include "common/base/worker_pool.h"
#include "render_node/gl/handle.h"
#include "render_node/gl/program.h"
#include "render_node/reef/place_tables.h"
#include "render_node/reef/solid_array.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::scene {

namespace {

// Three integers for each cell of the grid of stirred water (wake.glsl).
constexpr std::size_t kWakeBytes = sizeof(std::int32_t) * 3 * shaders::kWakeCellsAcross *
                                   shaders::kWakeCellsUp * shaders::kWakeCellsAcross;
// Prototypes that are not rock.
constexpr unsigned kGrowths = kPrototypes - kRockShapes;

// Index of the command of a prototype at a level. Rock has one run of commands, all else another;
// in each run fine levels, which are near, come before coarse ones. One call can therefore draw a
// range of levels.
std::uint32_t commandOf(std::size_t prototype, std::size_t level) {
    if (prototype < kRockShapes) return static_cast<std::uint32_t>(level * kRockShapes + prototype);
    return static_cast<std::uint32_t>(kLevels * kRockShapes + level * kGrowths + prototype -
                                      kRockShapes);
}

// The ball about a prototype, centred on its axis; the other members are left to the caller.
Prototype boundsOf(const Mesh& mesh) {
    float low = 1.0e9F;
    float high = -1.0e9F;
    for (const SolidVertex& vertex : mesh.vertices) {
        low = std::min(low, vertex.position.y);
        high = std::max(high, vertex.position.y);
    }
    Prototype prototype{.middle = 0.5F * (low + high)};
    for (const SolidVertex& vertex : mesh.vertices)
        prototype.reach = std::max(
            prototype.reach, glm::length(vertex.position - glm::vec3{0, prototype.middle, 0}));
    return prototype;
}

// Sorts the instances by cells of 3 m, so that a workgroup of the culling has neighbours, which are
// culled together. Stable, hence the same on every machine.
std::vector<Instance> byCells(std::vector<Instance> instances) {
    constexpr float kCellMetres = 3.0F;
    const auto cellOf = [](const Instance& one) {
        const glm::ivec3 cell(glm::floor(glm::vec3(one.placeAndScale) / kCellMetres));
        return std::tuple{cell.x, cell.z, cell.y};
    };
    std::ranges::stable_sort(instances, {}, cellOf);
    return instances;
}

// For each workgroup a ball about its instances, with all that the swell may move.
std::vector<glm::vec4> groupBalls(std::span<const Instance> instances,
                                  std::span<const Prototype> prototypes) {
    std::vector<glm::vec4> balls;
    for (std::size_t first = 0; first < instances.size(); first += shaders::kGroupSize) {
        const auto group = instances.subspan(
            first, std::min<std::size_t>(shaders::kGroupSize, instances.size() - first));
        glm::vec3 middle{0.0F};
        for (const Instance& one : group) middle += glm::vec3(one.placeAndScale);
        middle /= static_cast<float>(group.size());
        float reach = 0.0F;
        for (const Instance& one : group) {
            const Prototype& prototype = prototypes[one.prototype];
            // As in place_cull.comp: plants that bend reach further.
            const float own = one.placeAndScale.w * (std::abs(prototype.middle) + prototype.reach +
                                                     1.5F * one.tintAndSway.w);
            reach = std::max(reach, glm::distance(middle, glm::vec3(one.placeAndScale)) + own);
        }
        balls.emplace_back(middle, reach);
    }
    return balls;
}

GLsizei commandCount(unsigned prototypes, unsigned levels) {
    return static_cast<GLsizei>(prototypes * levels);
}

// Draws `count` commands of the indirect buffer that is bound.
void drawFrom(std::size_t command, GLsizei count) {
    assert(command + static_cast<std::size_t>(count) <= kPrototypes * kLevels);
    drawCommands(command, count);
}

}  // namespace

// Plants are large, but their leaves are small.
std::array<float, kLevels> leastPixelsOf(std::size_t prototype) {
    if (prototype < kRockShapes) return {420.0F, 150.0F, 60.0F, 20.0F, 4.0F};
    if (prototype >= prototypeOf(Form::Seagrass, 0)) return {200.0F, 90.0F, 40.0F, 18.0F, 3.0F};
    if (prototype >= prototypeOf(Form::Kelp, 0)) return {1200.0F, 500.0F, 220.0F, 90.0F, 6.0F};
    if (prototype >= prototypeOf(Form::Turf, 0)) return {90.0F, 45.0F, 22.0F, 11.0F, 3.0F};
    return {170.0F, 85.0F, 38.0F, 16.0F, 2.2F};
}

Library growLibrary() {
    Library library;
    WorkerPool(std::thread::hardware_concurrency()).run(kPrototypes, [&](std::size_t i) {
        const std::size_t growth = i - kRockShapes;
        library[i] = i < kRockShapes ? growRock(static_cast<int>(i))
                                     : grow(static_cast<Form>(growth / kShapesOfForm),
                                            static_cast<int>(growth % kShapesOfForm));
    });
    return library;
}

namespace {

// Each command gets as many slots in the list of chosen instances as its prototype has instances,
// so that the culling never runs out of room.
ReefTables makeReefTables(const place::PlaceKey& place) {
    const Library library = growLibrary();
    ReefTables tables;
    tables.instances = byCells(scatter(place));
    tables.commands.resize(kPrototypes * kLevels);
    // The first slot of each command in the list of chosen instances.
    std::uint32_t slots = 0;
    for (std::size_t i = 0; i < kPrototypes; ++i) {
        const auto own = static_cast<std::uint32_t>(std::ranges::count_if(
            tables.instances, [&](const Instance& one) { return one.prototype == i; }));
        Prototype prototype = boundsOf(library.at(i)[0]);
        prototype.firstCommand = commandOf(i, 0);
        prototype.commandStride = commandOf(i, 1) - commandOf(i, 0);
        prototype.leastPixels = leastPixelsOf(i);
        tables.prototypes.push_back(prototype);
        for (std::size_t level = 0; level < kLevels; ++level) {
            const Mesh& mesh = library.at(i).at(level);
            tables.commands[commandOf(i, level)] = {
                static_cast<std::uint32_t>(mesh.indices.size()),
                0,
                static_cast<std::uint32_t>(tables.indices.size()),
                static_cast<std::int32_t>(tables.vertices.size()),
                slots};
            slots += own;
            tables.vertices.insert(
                tables.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
            tables.coarse.insert(tables.coarse.end(), mesh.coarse.begin(), mesh.coarse.end());
            tables.indices.insert(tables.indices.end(), mesh.indices.begin(), mesh.indices.end());
        }
    }
    tables.groups = groupBalls(tables.instances, tables.prototypes);
    return tables;
}

}  // namespace

ReefTables reefTables(const place::PlaceKey& place) {
    return derivedTables<ReefTables>(derivedKey("reef", place),
                                     [&] { return makeReefTables(place); });
}

Reef::Reef(const ReefTables& tables, const Quality& quality)
    : quality_{quality},
      group_{gl::makeProgram({"place_groups.comp"})},
      cull_{gl::makeProgram({"place_cull.comp"})},
      stone_{quality.rockScales > 1
                 ? gl::makeProgram({"rock.vert", "rock.frag"}, replacementsOf(quality.light))
                 : gl::makeProgram({"rock_plain.vert", "rock_plain.frag"},
                                   replacementsOf(quality.light))},
      growth_{gl::makeProgram({"coral.vert", "coral.frag"}, replacementsOf(quality.light))},
      farGrowth_{gl::makeProgram({"coral_far.vert", "lit.frag"}, replacementsOf(quality.light))},
      stir_{gl::makeProgram({"wake.comp"})},
      detail_{makeTexture(rockTile())} {
    wake_ = gl::makeBuffer(kWakeBytes, "wake");
    // At rest, also for the shadow maps, which are drawn before the first call of stir().
    constexpr GLint kStill = 0;
    glClearNamedBufferData(wake_.name(), GL_R32I, GL_RED_INTEGER, GL_INT, &kStill);
    fillBuffers(tables);
}

// Uploads the tables. The vertex attribute kChosenAttribute advances once for each instance; from
// kCoarseAttribute on are the members of CoarseVertex.
void Reef::fillBuffers(const ReefTables& tables) {
    assert(tables.prototypes.size() == kPrototypes);
    assert(tables.commands.size() == kPrototypes * kLevels);
    instanceCount_ = static_cast<unsigned>(tables.instances.size());
    groupCount_ = static_cast<unsigned>(tables.groups.size());
    setSolids(array_, vertices_, indices_, tables.vertices, tables.indices);
    coarse_ = gl::makeBuffer(tables.coarse, "reef vertices of the coarser level");
    attachCoarse(array_, coarse_);
    instances_ = gl::makeBuffer(tables.instances, "reef instances");
    std::vector<Prototype> prototypes = tables.prototypes;
    for (Prototype& one : prototypes)
        one.leastPixels.back() *= quality_.placeDetail / quality_.placeReach;
    prototypes_ = gl::makeBuffer(prototypes, "reef prototypes");
    groups_ = gl::makeBuffer(tables.groups, "reef groups");
    // The size of a dispatch (3 numbers), then the groups that it visits.
    const std::vector<std::uint32_t> seen(3 + groupCount_);
    seenGroups_ = gl::makeBuffer(seen, "reef groups seen");
    none_ = gl::makeBuffer(tables.commands, "reef commands, none drawn");
    commands_ = gl::makeBuffer(tables.commands, "reef commands");
    // Each instance has a slot at every level.
    const std::size_t slots = kLevels * tables.instances.size();
    chosen_ = gl::makeBuffer(slots * sizeof(std::uint32_t), "reef chosen");
    constexpr unsigned kChosen = shaders::kChosenAttribute;
    glVertexArrayVertexBuffer(array_.name(), kChosen, chosen_.name(), 0, sizeof(std::uint32_t));
    glVertexArrayBindingDivisor(array_.name(), kChosen, 1);
    glEnableVertexArrayAttrib(array_.name(), kChosen);
    glVertexArrayAttribIFormat(array_.name(), kChosen, 1, GL_UNSIGNED_INT, 0);
    glVertexArrayAttribBinding(array_.name(), kChosen, kChosen);
}

void Reef::stir(std::size_t fish, float fraction) const {
    assert(fraction >= 0.0F);
    assert(fraction <= 1.0F);
    const gl::Stage stage{"place stir"};
    // The grid stays at rest then, as the constructor has cleared it.
    if (!quality_.plantsGiveWay) return;
    constexpr std::int32_t kStill = 0;
    glClearNamedBufferData(wake_.name(), GL_R32I, GL_RED_INTEGER, GL_INT, &kStill);
    gl::bindStorage(shaders::kWakeStorage, wake_);
    const auto count = static_cast<unsigned>(fish);
    if (count == 0) return;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glUseProgram(stir_.name());
    glUniform1f(shaders::kFractionLocation, fraction);
    glUniform1ui(shaders::kWakeFishCountLocation, count);
    glDispatchCompute((count + shaders::kGroupSize - 1) / shaders::kGroupSize, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

// First step: tests the balls of the groups. It writes the number of seen groups as the size of the
// second dispatch, which starts at 0 x 1 x 1.
void Reef::cullGroups(const PlaceRule& rule) const {
    constexpr std::array<std::uint32_t, 3> kNone{0, 1, 1};
    glClearNamedBufferSubData(seenGroups_.name(),
                              GL_RGB32UI,
                              0,
                              sizeof(kNone),
                              GL_RGB_INTEGER,
                              GL_UNSIGNED_INT,
                              kNone.data());
    glUseProgram(group_.name());
    glUniform1ui(shaders::kGroupCountLocation, groupCount_);
    glUniform1i(shaders::kCullingLocation, rule.culling ? 1 : 0);
    gl::bindStorage(shaders::kGroupsStorage, groups_);
    gl::bindStorage(shaders::kSeenGroupsStorage, seenGroups_);
    glDispatchCompute((groupCount_ + shaders::kGroupSize - 1) / shaders::kGroupSize, 1, 1);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

// Second step: resets the commands, then tests the instances of the seen groups. A very high detail
// selects the finest level everywhere.
void Reef::cull(const PlaceRule& rule) const {
    const gl::Stage stage{"place cull"};
    glCopyNamedBufferSubData(none_.name(),
                             commands_.name(),
                             0,
                             0,
                             static_cast<GLsizeiptr>(kPrototypes * kLevels * sizeof(DrawCommand)));
    cullGroups(rule);
    glUseProgram(cull_.name());
    glUniform1ui(shaders::kInstanceCountLocation, instanceCount_);
    glUniform1i(shaders::kCullingLocation, rule.culling ? 1 : 0);
    glUniform1f(shaders::kCullDetailLocation, rule.levelsOfDetail ? quality_.placeDetail : 1.0e6F);
    gl::bindStorage(shaders::kInstancesStorage, instances_);
    gl::bindStorage(shaders::kPrototypesStorage, prototypes_);
    gl::bindStorage(shaders::kCommandsStorage, commands_);
    gl::bindStorage(shaders::kChosenStorage, chosen_);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, seenGroups_.name());
    glDispatchComputeIndirect(0);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

void Reef::bind() const {
    glBindVertexArray(array_.name());
    gl::bindStorage(shaders::kInstancesStorage, instances_);
    gl::bindStorage(shaders::kWakeStorage, wake_);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.name());
}

void Reef::draw() const {
    bind();
    glBindTextureUnit(shaders::kDetailTileUnit, detail_.name());
    // Number of levels that are lit at each pixel, where the tier does so.
    constexpr unsigned kFine = 4;
    if (quality_.growthAtPixels) {
        glUseProgram(growth_.name());
        glUniform1f(shaders::kReachLocation, quality_.placeReach);
        glUniform1i(shaders::kStirredLocation, quality_.plantsGiveWay ? 1 : 0);
        drawFrom(commandOf(kRockShapes, 0), commandCount(kGrowths, kFine));
    }
    // The other levels are lit at their vertices.
    const unsigned firstFar = quality_.growthAtPixels ? kFine : 0;
    glUseProgram(farGrowth_.name());
    glUniform1f(shaders::kReachLocation, quality_.placeReach);
    drawFrom(commandOf(kRockShapes, firstFar), commandCount(kGrowths, kLevels - firstFar));
    // Rock comes last: the corals and plants on it are cheaper and hide much of it.
    glEnable(GL_CULL_FACE);
    glUseProgram(stone_.name());
    glUniform1f(shaders::kReachLocation, quality_.placeReach);
    if (quality_.rockScales > 1) glUniform1i(shaders::kRockScalesLocation, quality_.rockScales);
    drawFrom(0, commandCount(kRockShapes, kLevels));
    glDisable(GL_CULL_FACE);
}

Reef::DepthPrograms Reef::depthPrograms() const {
    return {gl::makeProgram({"coral.vert"}, replacementsOf(quality_.light)),
            gl::makeProgram({"rock.vert"})};
}

// All levels with the program for near ones; in the maps nothing moves with the fish.
void Reef::drawDepths(const DepthPrograms& programs) const {
    bind();
    glUseProgram(programs.growth.name());
    glUniform1f(shaders::kReachLocation, quality_.placeReach);
    glUniform1i(shaders::kStirredLocation, 0);
    drawFrom(commandOf(kRockShapes, 0), commandCount(kGrowths, kLevels));
    glEnable(GL_CULL_FACE);
    glUseProgram(programs.stone.name());
    glUniform1f(shaders::kReachLocation, quality_.placeReach);
    drawFrom(0, commandCount(kRockShapes, kLevels));
    glDisable(GL_CULL_FACE);
}

}  // namespace aquarama::scene
