// SPDX-License-Identifier: Apache-2.0
// Pictures that visitors send, from their bytes: a pure function, which trusts nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace aquarama::drawings {

// sRGB codes red, green, blue; top row first.
struct Photo {
    glm::ivec2 sizePixels{};
    std::vector<std::uint8_t> rgb;
};

// What is read at most, tested before memory is taken.
inline constexpr std::size_t kMostPhotoBytes = std::size_t{16} << 20U;
inline constexpr std::int64_t kMostPhotoPixels = 50'000'000;

// A JPEG, PNG or WebP, whichever the bytes say. Throws Refusal, TooLarge or NotAPicture.
[[nodiscard]] Photo decodePhoto(std::span<const std::byte> bytes);

// The light of a photo between the centres of its pixels (+0.5), linear Rec. 709; its border goes
// on. Owns a table, not the photo, which must outlive it.
class PhotoLight {
  public:
    explicit PhotoLight(const Photo& photo);
    // Red, green, blue at a place in pixels.
    [[nodiscard]] glm::vec3 at(glm::dvec2 pixel) const;

  private:
    [[nodiscard]] glm::vec3 pixel(int x, int y) const;

    const Photo& photo_;
    std::vector<float> light_;  // of each code
};

}  // namespace aquarama::drawings
