// SPDX-License-Identifier: Apache-2.0
// Where a camera sees the tag of a channel: by the places around it, as the tag itself has none.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "calibration/scan/decode.h"

namespace aquarama::scan {

// Immutable. Maps pixels of the camera to the cells of a channel's tag.
class TagMap {
  public:
    // By the places around the tag; nothing where too few are seen, or they contradict each other.
    [[nodiscard]] static std::optional<TagMap> of(const ChannelView& view,
                                                  glm::ivec2 cameraPixels,
                                                  glm::ivec2 channelPixels);
    // From a camera's pixel (its index, whole at the centre) to cells right and down of the corner
    // of the tag.
    [[nodiscard]] glm::dvec2 cellAt(glm::dvec2 pixel) const;
    // The pixels of the camera, around the tag, for which the map is valid.
    [[nodiscard]] glm::ivec2 low() const { return low_; }
    [[nodiscard]] glm::ivec2 high() const { return high_; }
    [[nodiscard]] double cellPixels() const { return cell_; }  // of the channel

    // A sample of the tag in a picture.
    struct Sample {
        glm::ivec2 pixel{};
        glm::dvec2 cell{};
    };

  private:
    using Terms = std::array<double, 6>;  // of a polynomial of second order
    void frame(const std::vector<Sample>& samples, double cellPixels, glm::ivec2 cameraPixels);
    [[nodiscard]] bool fit(const std::vector<Sample>& samples);
    [[nodiscard]] Terms termsAt(glm::dvec2 pixel) const;

    glm::ivec2 low_{1 << 20}, high_{-1};
    double cell_ = 1, scale_ = 1;
    glm::dvec2 middle_{};
    std::array<Terms, 2> fit_{};
};

}  // namespace aquarama::scan
