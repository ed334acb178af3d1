// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>

#include "common/base/log.h"
#include "common/config/adjustments.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

int fuzzAdjustments(const std::uint8_t* bytes, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    config::Rig rig;
    rig.channels.resize(2);
    rig.channels[0].name = "left";
    rig.channels[1].name = "right";
    try {
        const config::Adjustments all = config::parseAdjustments(text, "fuzzed", rig);
        for (const config::ControlPoint& point : all.points)
            promise(std::isfinite(point.byPixels.x) && point.radiusPixels > 0,
                    "the moves of points are finite");
        for (const config::MaskedArea& mask : all.masks)
            promise(mask.corners.size() >= 3, "masks have corners");
    } catch (const Error& error) {
        promiseLine(error.what());
        promise(std::string(error.what()).starts_with("fuzzed"), "an error names its source");
    }
    return 0;
}

}  // namespace aquarama
