// SPDX-License-Identifier: Apache-2.0
// The channels of a scan in the small copies of its pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "calibration/scan/faults.h"

namespace aquarama::scan {

// One channel. Planes have a value for each pixel of the small copies; they are empty where the
// channel was not scanned.
struct SmallChannel {
    Plane light;             // of its white without black
    float most = 0;          // the light of its bright pixels
    std::vector<int> cells;  // the tag's cell at each pixel, kBeside or kEdge; empty without a tag
    bool hasTag = false;     // all cells of the tag are seen
    std::vector<std::uint8_t> seen = {};  // 1 for each cell of kGrid that the camera sees
    float seenShare = 0;                  // of kGrid

    static constexpr int kBeside = -1, kEdge = -2;
    static constexpr glm::ivec2 kGrid{24, 15};  // cells of the channel's picture
    // The camera sees enough of it to judge it.
    [[nodiscard]] bool isSeen() const { return seenShare > 0.05F; }
};

// All channels of the rig. Immutable; refers to the evidence.
class SmallChannels {
  public:
    explicit SmallChannels(const Evidence& evidence);

    // How many channels there are, and one of them.
    [[nodiscard]] std::size_t size() const { return channels_.size(); }
    [[nodiscard]] const SmallChannel& operator[](std::size_t channel) const {
        return channels_[channel];
    }
    // The picture in which all channels are black.
    [[nodiscard]] const Plane& black() const { return *black_; }
    // The white of a set of channels together, at a pixel.
    [[nodiscard]] float lightAt(std::size_t pixel, std::uint64_t lit) const;
    // The light of the brightest channel.
    [[nodiscard]] float mostLight() const;

    static constexpr float kLeastLight = 0.04F;  // of a usable white; linear

  private:
    const Plane* black_;
    std::vector<SmallChannel> channels_;
};

// The light of a channel in a pattern: 0 where the pattern does not light it.
[[nodiscard]] inline float weightOf(const config::ScanPattern& pattern, std::size_t channel) {
    const glm::vec3& light = pattern.light;
    return config::contains(pattern.lit, channel) ? cameraLuminance(light.r, light.g, light.b) : 0;
}

}  // namespace aquarama::scan
