// SPDX-License-Identifier: Apache-2.0
// A clip as a player sees it.
#pragma once

#include <string>
#include <vector>

#include "common/base/picture.h"

namespace aquarama::test {

struct SeenClip {
    std::string codec;  // "h264"
    glm::ivec2 sizePixels{};
    std::vector<Picture> pictures;  // 8 bits
    std::vector<double> seconds;    // when each is shown
    double durationSeconds = 0;
};
// Throws Error where the file is no clip.
[[nodiscard]] SeenClip readClip(const std::string& path);

// Mean absolute difference of 8-bit codes over the smaller of two sizes.
[[nodiscard]] double meanCodesBetween(const Picture& one, const Picture& other);

}  // namespace aquarama::test
