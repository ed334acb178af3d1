// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "common/base/log.h"
#include "common/config/scene.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

int fuzzScene(const std::uint8_t* bytes, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    try {
        const config::Scene scene = config::parseScene(text, "fuzzed");
        promise(config::fishIn(scene) <= kMostFish, "the fish of a scene are bounded");
    } catch (const Error& error) {
        promiseLine(error.what());
        promise(std::string(error.what()).starts_with("fuzzed"), "an error names its source");
    }
    return 0;
}

}  // namespace aquarama
