// SPDX-License-Identifier: Apache-2.0
#include "drawings/tags.h"

#include <cassert>
#include <memory>

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

namespace aquarama::drawings {

namespace {

using Family = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;

Family family() {
    return {tag36h11_create(), tag36h11_destroy};
}

// The library's corners begin at the lower left and go to the right.
FoundTag tagOf(const apriltag_detection_t& detection) {
    constexpr std::array<std::size_t, 4> kFromUpperLeft{3, 2, 1, 0};
    FoundTag tag{.id = detection.id};
    for (std::size_t k = 0; k < 4; ++k) {
        const double* corner = detection.p[kFromUpperLeft.at(k)];
        tag.corners.at(k) = {corner[0], corner[1]};
    }
    return tag;
}

}  // namespace

TagPattern tagPattern(int id) {
    const Family tags = family();
    assert(id >= 0 && static_cast<std::uint32_t>(id) < tags->ncodes);
    TagPattern pattern{};
    for (auto& row : pattern) row.fill(true);
    for (std::uint32_t bit = 0; bit < tags->nbits; ++bit)
        if ((tags->codes[static_cast<std::size_t>(id)] >> (tags->nbits - 1 - bit) & 1U) != 0)
            pattern.at(tags->bit_y[bit]).at(tags->bit_x[bit]) = false;
    return pattern;
}

std::vector<FoundTag> findTags(std::span<const std::uint8_t> grey,
                               glm::ivec2 sizePixels,
                               float reduction) {
    const Family tags = family();
    const std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)> detector(
        apriltag_detector_create(), apriltag_detector_destroy);
    constexpr int kWrongBits = 1;
    apriltag_detector_add_family_bits(detector.get(), tags.get(), kWrongBits);
    detector->quad_decimate = reduction;
    // The library reads the picture only.
    image_u8_t image{.width = sizePixels.x,
                     .height = sizePixels.y,
                     .stride = sizePixels.x,
                     .buf = const_cast<std::uint8_t*>(grey.data())};
    zarray_t* detections = apriltag_detector_detect(detector.get(), &image);
    std::vector<FoundTag> found;
    for (int i = 0; i < zarray_size(detections); ++i) {
        apriltag_detection_t* detection = nullptr;
        zarray_get(detections, i, &detection);
        found.push_back(tagOf(*detection));
    }
    apriltag_detections_destroy(detections);
    return found;
}

}  // namespace aquarama::drawings
