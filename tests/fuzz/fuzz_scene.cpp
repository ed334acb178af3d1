// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "common/config/scene.h"
#include "common/units/log.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

namespace {

void writeAndReadAgain(const config::Scene& scene) {
    const std::string text = config::writeScene(scene);
    try {
        promise(config::writeScene(config::parseScene(text, "written")) == text,
                "a scene is read as it was written");
    } catch (const Error& error) {
        promise(false, error.what());
    }
}

}  // namespace

int fuzzScene(const std::uint8_t* bytes, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    try {
        writeAndReadAgain(config::parseScene(text, "fuzzed"));
    } catch (const Error& error) {
        promise(std::string(error.what()).starts_with("fuzzed"), "an error names its source");
    }
    return 0;
}

}  // namespace aquarama
