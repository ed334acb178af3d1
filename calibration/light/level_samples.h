// SPDX-License-Identifier: Apache-2.0
// The reduced pictures of levels in a view, in linear light.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "calibration/scan/decode.h"

namespace aquarama::light {

// The view with corrected samples in the exposure of the first picture. Noise adds light to black,
// as it is cut off below zero: this is subtracted. The response is corrected by pictures of one
// white in several exposures.
[[nodiscard]] scan::CameraView linearised(scan::CameraView view);

// The samples of a linearised view, which outlives this.
class LevelSamples {
  public:
    explicit LevelSamples(const scan::CameraView& view);

    // How many channels there are.
    [[nodiscard]] std::size_t channels() const { return whites_.size(); }
    // Whether there is a black, a white of each channel, and places of each.
    [[nodiscard]] bool isWhole() const;
    // The mean of all pictures of black.
    [[nodiscard]] const Light& black() const { return black_; }
    // The picture of a level that all channels show at once; null where there is none.
    [[nodiscard]] const scan::SampledPicture* level(glm::vec3 light) const;
    // Grey levels of all channels below white, rising.
    [[nodiscard]] std::vector<const scan::SampledPicture*> greys() const;
    // The light of a sample without black; NaN where the camera was clipped.
    [[nodiscard]] glm::dvec3 light(const scan::SampledPicture& picture, std::size_t index) const {
        return glm::dvec3(picture.light.rgb[index]) - glm::dvec3(black_.rgb[index]);
    }
    // The white of a channel alone.
    [[nodiscard]] glm::dvec3 white(std::size_t channel, std::size_t index) const {
        return light(*whites_[channel], index);
    }
    // The sum of the whites of a set of channels.
    [[nodiscard]] glm::dvec3 whites(std::uint64_t lit, std::size_t index) const;
    // The place in a channel's picture that lights a sample; NaN where it is not known.
    [[nodiscard]] glm::dvec2 place(std::size_t channel, std::size_t index) const;

  private:
    [[nodiscard]] const scan::SampledPicture* levelOf(std::uint64_t lit, glm::vec3 light) const;

    const scan::CameraView& view_;
    Light black_;
    std::vector<const scan::SampledPicture*> whites_;
};

// Bands of samples along rows and columns that are held out from the fit of the responses, to test
// it.
inline constexpr std::array kBands{0.15, 0.3, 0.5, 0.7, 0.85};  // shares of the picture
inline constexpr int kBandWidth = 5;                            // samples
[[nodiscard]] int firstOfBand(double at, int samples);
[[nodiscard]] bool isHeldOut(glm::ivec2 size, std::size_t index);

}  // namespace aquarama::light
