// SPDX-License-Identifier: Apache-2.0
// The skin of a fish through a cycle: the limit surface over the control cage, which follows the
// nodal points of each pose.
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

// One number a vertex; in the body frame, metres.
struct SkinShape {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
};

struct SwimmingSkin {
    std::vector<std::uint32_t> triangles;  // three vertices each, counter-clockwise from outside
    std::vector<SkinShape> shapes;         // evenly spaced in phase, the first at phase 0
};

// `shapes` divides kPhases.
[[nodiscard]] SwimmingSkin skinOf(const body::FishBody& body,
                                  const motion::ActionSegment& segment,
                                  double lengthMetres,
                                  int shapes);

// Puts arrays into the buffer of a glTF model; each becomes an accessor with a view of its own.

// Each returns the number of the accessor. Bounds are given where glTF demands them.
[[nodiscard]] int addTriangles(tinygltf::Model& model, std::span<const std::uint32_t> corners);
[[nodiscard]] int addVertices(tinygltf::Model& model, std::span<const glm::vec3> vectors);
[[nodiscard]] int addTimes(tinygltf::Model& model, std::span<const float> seconds);
// Of an animation: one number, three or four at each time, or at each several numbers.
[[nodiscard]] int addKeys(tinygltf::Model& model, std::span<const float> numbers);
[[nodiscard]] int addKeys(tinygltf::Model& model, std::span<const glm::vec3> vectors);
[[nodiscard]] int addKeys(tinygltf::Model& model, std::span<const glm::vec4> quaternions);

// A segment as glTF 2.0 (ISO/IEC 12113): the skin of the fish, swimming.

enum class GltfContainer { Binary, Text };  // .glb; .gltf with its buffer inside

// Shapes of the skin, and keys of the animation, in a cycle: half of its phases for a beat, which
// straight lines between them leave by less than 0.002 body lengths; all for a turn that plays to
// its end, for it begins abruptly.
[[nodiscard]] int gltfShapes(const motion::ActionSegment& segment);

// One animation, named like the segment: the body frame moves a node, and the mesh below it goes
// through the poses of the cycle as morph targets. Metres, Y up, the fish heads along +x (where
// glTF's own custom is +z).
[[nodiscard]] std::vector<std::byte> gltfOf(const motion::Repertoire& repertoire,
                                            const body::FishBody& body,
                                            motion::Action action,
                                            int cycles,
                                            GltfContainer container);

}  // namespace aquarama::report
