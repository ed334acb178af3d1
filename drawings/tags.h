// SPDX-License-Identifier: Apache-2.0
// AprilTags of the family 36h11 (Wang and Olson 2016): what they look like, and where a picture has
// some. The only place that knows the library.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace aquarama::drawings {

// Modules of a tag each way, without its white border.
inline constexpr int kTagModules = 8;
// Whether each is black; rows from the top.
using TagPattern = std::array<std::array<bool, kTagModules>, kTagModules>;
// id: 0 to 586.
[[nodiscard]] TagPattern tagPattern(int id);

// A tag in a picture.
struct FoundTag {
    int id = 0;
    // Of its black border in pixels, whose centres are at +0.5, in the order of TagCorners.
    std::array<glm::dvec2, 4> corners{};
};

// All tags with at most one wrong bit. grey: codes row by row from the top. Edges are looked for in
// a picture that is so many times smaller, and refined in the whole one.
[[nodiscard]] std::vector<FoundTag> findTags(std::span<const std::uint8_t> grey,
                                             glm::ivec2 sizePixels,
                                             float reduction);

}  // namespace aquarama::drawings
