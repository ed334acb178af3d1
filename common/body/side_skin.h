// SPDX-License-Identifier: Apache-2.0
// A skin that a visitor has painted (side_view.h), ready for a texture: with the coarser levels
// that a far fish shows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>

namespace aquarama::body {

// From kSideTexels down to a single texel.
inline constexpr std::size_t kSideLevels = 11;
// Texels of a level; each has half of those of the one before, either way.
[[nodiscard]] glm::ivec2 sideTexelsAt(std::size_t level);

// Red, green and blue as sRGB codes, and 255; top row first. A texel of a coarser level sends back
// the mean light of the texels that it stands for.
struct SideSkin {
    std::array<std::vector<glm::u8vec4>, kSideLevels> levels;
};
// By the number that a fish's record names (motion::FishRecord::skin).
using SkinsByNumber = std::map<std::uint32_t, std::shared_ptr<const SideSkin>>;

// Alpha of the PNG is ignored. Throws Error, which names the source, where it is no picture of
// kSideTexels in 8 bits and in colour. Takes some hundredths of a second.
[[nodiscard]] SideSkin sideSkinOf(std::span<const std::byte> png, const std::string& source);

}  // namespace aquarama::body
