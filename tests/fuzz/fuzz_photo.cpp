// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <span>

#include "drawings/photo.h"
#include "drawings/refusal.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

int fuzzPhoto(const std::uint8_t* bytes, std::size_t size) {
    try {
        const drawings::Photo photo = drawings::decodePhoto(std::as_bytes(std::span(bytes, size)));
        const glm::ivec2 pixels = photo.sizePixels;
        promise(pixels.x > 0 && pixels.y > 0 &&
                    std::int64_t{pixels.x} * pixels.y <= drawings::kMostPhotoPixels,
                "a picture has a size within the limits");
        promise(photo.rgb.size() ==
                    3 * static_cast<std::size_t>(pixels.x) * static_cast<std::size_t>(pixels.y),
                "a picture has three codes a pixel");
    } catch (const drawings::Refusal& refusal) {
        promiseLine(refusal.what());
        promise(refusal.reason() == drawings::RefusalReason::TooLarge ||
                    refusal.reason() == drawings::RefusalReason::NotAPicture,
                "a picture is too large or none");
    }
    return 0;
}

}  // namespace aquarama
