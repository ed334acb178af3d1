// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "common/base/log.h"
#include "common/config/rig.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

int fuzzRig(const std::uint8_t* bytes, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    try {
        for (const config::Channel& channel : config::parseRig(text, "fuzzed").channels)
            promise(channel.sizePixels.x > 0 && channel.sizePixels.y > 0, "a channel has pixels");
    } catch (const Error& error) {
        promiseLine(error.what());
        promise(std::string(error.what()).starts_with("fuzzed"), "an error names its source");
    }
    return 0;
}

}  // namespace aquarama
