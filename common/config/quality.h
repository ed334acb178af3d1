// SPDX-License-Identifier: Apache-2.0
// How fine a wall is drawn. All nodes of a wall draw at the same tier, or their pictures would part
// where they overlap; render_node/reef/quality.h says what each buys.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace aquarama::config {

enum class QualityTier : std::uint8_t {
    Low,     // software OpenGL on two cores, live
    Medium,  // a small GPU
    High,    // a GPU of today
    Ultra,   // no expense spared: pictures, references
};
inline constexpr std::array<std::string_view, 4> kTierNames{"low", "medium", "high", "ultra"};

[[nodiscard]] constexpr std::string_view nameOf(QualityTier tier) {
    return kTierNames.at(static_cast<std::size_t>(tier));
}
[[nodiscard]] constexpr std::optional<QualityTier> tierAt(std::uint32_t index) {
    if (index >= kTierNames.size()) return std::nullopt;
    return static_cast<QualityTier>(index);
}
[[nodiscard]] constexpr std::optional<QualityTier> tierNamed(std::string_view name) {
    const auto found = std::ranges::find(kTierNames, name);
    return tierAt(static_cast<std::uint32_t>(found - kTierNames.begin()));
}

}  // namespace aquarama::config
