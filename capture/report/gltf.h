// SPDX-License-Identifier: Apache-2.0
// A segment as glTF 2.0 (ISO/IEC 12113): the skin of the fish through a cycle, and the animation
// that moves it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <tiny_gltf.h>

#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"

namespace aquarama::report {

// The skin: the limit surface over the control cage, which follows the nodal points of each pose.

// The skin in one pose: an element for each vertex, in the body frame; positions in metres.
struct SkinShape {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
};

// All shapes have the same vertices and triangles.
struct SwimmingSkin {
    std::vector<std::uint32_t> triangles;  // three vertices each, counter-clockwise from outside
    std::vector<SkinShape> shapes;         // evenly spaced in phase, the first at phase 0
};

// `shapes` >= 1 poses of a segment; `shapes` divides kPhases.
[[nodiscard]] SwimmingSkin skinOf(const body::FishBody& body,
                                  const motion::ActionSegment& segment,
                                  double lengthMetres,
                                  int shapes);

// These append an array to the first buffer of a glTF model, with a buffer view and an accessor of
// its own, and return the index of the accessor. Vertices and times must not be empty: glTF demands
// their bounds.

// Three indices of vertices for each triangle.
[[nodiscard]] int addTriangles(tinygltf::Model& model, std::span<const std::uint32_t> corners);
[[nodiscard]] int addVertices(tinygltf::Model& model, std::span<const glm::vec3> vectors);
[[nodiscard]] int addTimes(tinygltf::Model& model, std::span<const float> seconds);
// The keys of an animation. For weights there are several numbers for each time, one for each morph
// target.
[[nodiscard]] int addKeys(tinygltf::Model& model, std::span<const float> numbers);
[[nodiscard]] int addKeys(tinygltf::Model& model, std::span<const glm::vec3> vectors);
[[nodiscard]] int addKeys(tinygltf::Model& model, std::span<const glm::vec4> quaternions);

// The file.

// Binary: .glb. Text: .gltf, with the buffer embedded as base64.
enum class GltfContainer { Binary, Text };

// The number of shapes of the skin, and of keys of the animation, in a cycle. For a beat it is half
// of the phases: linear interpolation between them has an error of less than 0.002 body lengths.
// For a turn that plays to its end it is all phases, since it begins abruptly.
[[nodiscard]] int gltfShapes(const motion::ActionSegment& segment);

// The bytes of a file with one animation, named like the segment: a node moves as the body frame,
// and its mesh takes the poses of the cycle as morph targets. Metres, Y up; the fish heads along
// +x, where glTF's convention for "forward" is +z. `cycles` >= 1. Throws Error when the file cannot
// be encoded.
[[nodiscard]] std::vector<std::byte> gltfOf(const motion::Repertoire& repertoire,
                                            const body::FishBody& body,
                                            motion::Action action,
                                            int cycles,
                                            GltfContainer container);

}  // namespace aquarama::report
