// SPDX-License-Identifier: Apache-2.0
// What the GPU keeps of a species: its recorded control points, and the tables of each level of
// detail.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"
#include "common/skin/limit_table.h"
#include "render_node/gl/handle.h"

namespace aquarama {

// A place, body lengths, and a heading (headingsOf()), half turns: 16 bits each.
using RecordedPoint = std::array<std::int16_t, 4>;

// By segment, phase and control point. Of segments that were captured without control points they
// are computed from the nodal points (paper, section 3.1), so that the GPU sees no difference.
// Throws Error where one lies further than a body length from the body frame's origin.
[[nodiscard]] std::vector<RecordedPoint> recordedPoints(const FishBody& body,
                                                        const Repertoire& repertoire);

// How far from the body frame's origin any control point of any pose gets, in body lengths. Poses
// between recorded ones get no further.
[[nodiscard]] float reachOf(const std::vector<RecordedPoint>& points);

template <class T>
gl::Buffer makeBuffer(const std::vector<T>& values, const char* label) {
    gl::Buffer buffer;
    glNamedBufferStorage(
        buffer.name(), static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(), 0);
    glObjectLabel(GL_BUFFER, buffer.name(), -1, label);
    return buffer;
}

// FinTable as fish_pose.glsl reads it.
[[nodiscard]] gl::Buffer makeFinBuffer(const FinTable& fins);

struct LevelBuffers {
    explicit LevelBuffers(const LimitTable& table);

    std::size_t vertexCount;
    GLsizei bodyIndices;
    GLsizei finIndices;
    gl::Buffer firstEntries, entries, places, indices;
    gl::VertexArray vertexArray;
};

}  // namespace aquarama
