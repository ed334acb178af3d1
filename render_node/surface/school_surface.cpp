// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/school_surface.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "render_node/gl/handle.h"
#include "render_node/surface/level_buffers.h"
#include "render_node/surface/skin_programs.h"
#include "render_node/surface/visibility.h"

namespace aquarama {

namespace {

// Bindings of shader storage, as fish_data.glsl, fish.comp and fish.vert have them.
constexpr GLuint kSchool = 0, kRecorded = 1, kFirstEntries = 2, kEntries = 3, kSurface = 4;
// Uniforms of fish.comp and fish.vert.
constexpr GLint kFirstFish = 0, kFirstVertex = 1, kVertexCount = 2;

constexpr std::size_t kBytesPerVertex = 16;
// Half of the least block that GL drivers allow in practice (128 MiB on software Mesa).
constexpr std::size_t kMostSurfaceBytes = std::size_t{64} << 20U;
constexpr std::size_t kLargestDispatch = 65535;

// Fish of one level that follow each other in the school's buffer and share the surface buffer.
struct Batch {
    int level = 0;
    std::size_t firstFish = 0;
    std::size_t fish = 0;
    std::size_t firstVertex = 0;
};

struct VisibleFish {
    int level = 0;
    float distanceMetres = 0;
    PresentedFish fish;
};

}  // namespace

struct SchoolSurface::Parts {
    Parts(const FishBody& body,
          const std::vector<RecordedPoint>& points,
          const SurfaceOptions& surfaceOptions,
          std::shared_ptr<const SkinPrograms> skins)
        : options{surfaceOptions},
          painter{surfaceOptions.skin, body.eye},
          reachBodyLengths{reachOf(points)},
          recorded{makeBuffer(points, "recorded control points")},
          programs{std::move(skins)} {
        for (int level = 0; level < kSurfaceLevels; ++level)
            levels.emplace_back(makeLimitTable(body, level));
        roomVertices =
            std::min(kMostSurfaceBytes / kBytesPerVertex, options.fish * levels.back().vertexCount);
        const auto bytes = static_cast<GLsizeiptr>(roomVertices * kBytesPerVertex);
        glNamedBufferStorage(surface.name(), bytes, nullptr, 0);
        glObjectLabel(GL_BUFFER, surface.name(), -1, "fish surfaces");
    }

    void cull(std::span<const PresentedFish> fish,
              const glm::mat4& clipFromWorld,
              glm::vec3 sharedEyeMetres);
    void upload();
    void splitIntoBatches();
    void evaluate(const Batch& batch) const;
    void bind(const Batch& batch, unsigned program) const;
    void drawBatch(const Batch& batch) const;

    SurfaceOptions options;
    SkinPainter painter;
    float reachBodyLengths;
    std::size_t roomVertices = 0;
    std::vector<LevelBuffers> levels;
    gl::Buffer recorded, school, surface;
    std::shared_ptr<const SkinPrograms> programs;

    std::vector<VisibleFish> visible;
    std::vector<PresentedFish> uploaded;
    std::vector<Batch> batches;
    bool allFit = true;  // the surfaces of all batches have room at once
};

// Farthest first, so that fins may be blended over what is behind them; coarse levels are the
// farthest. Equal distances fall back to the id: all nodes draw in the same order.
void SchoolSurface::Parts::cull(std::span<const PresentedFish> fish,
                                const glm::mat4& clipFromWorld,
                                glm::vec3 sharedEyeMetres) {
    const Frustum frustum = frustumOf(clipFromWorld);
    visible.clear();
    for (const PresentedFish& one : fish) {
        const float margin = reachBodyLengths * one.lengthMetres;
        if (isAway(one)) continue;
        if (options.culling && !reaches(frustum, one.positionMetres, margin)) continue;
        const int level = options.levelsOfDetail
                              ? levelOfDetail(sharedEyeMetres, one.positionMetres, one.lengthMetres)
                              : kSurfaceLevels - 1;
        visible.push_back({level, glm::distance(sharedEyeMetres, one.positionMetres), one});
    }
    std::ranges::sort(visible, {}, [](const VisibleFish& one) {
        return std::tuple{one.level, -one.distanceMetres, one.fish.id};
    });
}

void SchoolSurface::Parts::upload() {
    uploaded.clear();
    for (const VisibleFish& one : visible) uploaded.push_back(one.fish);
    glNamedBufferData(school.name(),
                      static_cast<GLsizeiptr>(uploaded.size() * sizeof(PresentedFish)),
                      uploaded.data(),
                      GL_STREAM_DRAW);
}

void SchoolSurface::Parts::splitIntoBatches() {
    batches.clear();
    allFit = true;
    std::size_t used = 0;
    for (std::size_t first = 0; first < visible.size();) {
        const int level = visible[first].level;
        const std::size_t vertexCount = levels[static_cast<std::size_t>(level)].vertexCount;
        if (used + vertexCount > roomVertices) {
            used = 0;
            allFit = false;
        }
        const std::size_t most = std::min(kLargestDispatch, (roomVertices - used) / vertexCount);
        std::size_t last = first;
        while (last < visible.size() && last - first < most && visible[last].level == level) ++last;
        batches.push_back({level, first, last - first, used});
        used += (last - first) * vertexCount;
        first = last;
    }
}

void SchoolSurface::Parts::bind(const Batch& batch, unsigned program) const {
    const LevelBuffers& level = levels[static_cast<std::size_t>(batch.level)];
    glUseProgram(program);
    glUniform1ui(kFirstFish, static_cast<GLuint>(batch.firstFish));
    glUniform1ui(kFirstVertex, static_cast<GLuint>(batch.firstVertex));
    glUniform1ui(kVertexCount, static_cast<GLuint>(level.vertexCount));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kSchool, school.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kSurface, surface.name());
}

void SchoolSurface::Parts::evaluate(const Batch& batch) const {
    const LevelBuffers& level = levels[static_cast<std::size_t>(batch.level)];
    bind(batch, programs->surface.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kRecorded, recorded.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kFirstEntries, level.firstEntries.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kEntries, level.entries.name());
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);  // earlier draws have read what is overwritten
    glDispatchCompute(static_cast<GLuint>(batch.fish), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void SchoolSurface::Parts::drawBatch(const Batch& batch) const {
    const LevelBuffers& level = levels[static_cast<std::size_t>(batch.level)];
    const auto instances = static_cast<GLsizei>(batch.fish);
    glBindVertexArray(level.vertexArray.name());
    glEnable(GL_CULL_FACE);

    bind(batch, painter.bodyOf(batch.level));
    glDrawElementsInstanced(GL_TRIANGLES, level.bodyIndices, GL_UNSIGNED_INT, nullptr, instances);

    bind(batch, painter.fins.name());
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    const auto firstFin = static_cast<std::uintptr_t>(level.bodyIndices) * sizeof(std::uint32_t);
    // NOLINTNEXTLINE(performance-no-int-to-ptr): GL takes an offset into the buffer as a pointer
    const auto* offset = reinterpret_cast<const void*>(firstFin);
    glDrawElementsInstanced(GL_TRIANGLES, level.finIndices, GL_UNSIGNED_INT, offset, instances);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
}

SchoolSurface::SchoolSurface(const FishBody& body,
                             const Repertoire& repertoire,
                             const SurfaceOptions& options,
                             std::shared_ptr<const SkinPrograms> skins)
    : parts_{std::make_unique<Parts>(
          body, recordedPoints(body, repertoire), options, std::move(skins))} {}

SchoolSurface::~SchoolSurface() = default;
SchoolSurface::SchoolSurface(SchoolSurface&&) noexcept = default;
SchoolSurface& SchoolSurface::operator=(SchoolSurface&&) noexcept = default;

void SchoolSurface::update(std::span<const PresentedFish> fish,
                           const glm::mat4& clipFromWorld,
                           glm::vec3 sharedEyeMetres) {
    parts_->cull(fish, clipFromWorld, sharedEyeMetres);
    parts_->upload();
    parts_->splitIntoBatches();
    if (!parts_->allFit) return;  // then each batch is evaluated just before it is drawn
    for (const Batch& batch : parts_->batches) parts_->evaluate(batch);
}

void SchoolSurface::draw() const {
    for (const Batch& batch : parts_->batches) {
        if (!parts_->allFit) parts_->evaluate(batch);
        parts_->drawBatch(batch);
    }
}

SurfaceCounts SchoolSurface::counts() const {
    SurfaceCounts counts;
    counts.visible = static_cast<int>(parts_->visible.size());
    for (const VisibleFish& one : parts_->visible) ++counts.perLevel[one.level];
    return counts;
}

}  // namespace aquarama
