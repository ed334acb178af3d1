// SPDX-License-Identifier: Apache-2.0
// Puts arrays into the buffer of a glTF model; each becomes an accessor with a view of its own.
#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <tiny_gltf.h>

namespace aquarama::exchange {

// Each returns the number of the accessor. Bounds are given where glTF demands them.
[[nodiscard]] int addTriangles(tinygltf::Model& model, std::span<const std::uint32_t> corners);
[[nodiscard]] int addVertices(tinygltf::Model& model, std::span<const glm::vec3> vectors);
[[nodiscard]] int addTimes(tinygltf::Model& model, std::span<const float> seconds);
// Of an animation: one number, three or four at each time, or at each several numbers.
[[nodiscard]] int addKeys(tinygltf::Model& model, std::span<const float> numbers);
[[nodiscard]] int addKeys(tinygltf::Model& model, std::span<const glm::vec3> vectors);
[[nodiscard]] int addKeys(tinygltf::Model& model, std::span<const glm::vec4> quaternions);

}  // namespace aquarama::exchange
