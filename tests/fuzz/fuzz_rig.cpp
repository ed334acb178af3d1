// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "common/config/rig.h"
#include "common/units/log.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

namespace {

void writeAndReadAgain(const config::Rig& rig) {
    const std::string text = config::writeRig(rig);
    try {
        promise(config::writeRig(config::parseRig(text, "written")) == text,
                "a rig is read as it was written");
    } catch (const Error& error) {
        promise(false, error.what());
    }
}

}  // namespace

int fuzzRig(const std::uint8_t* bytes, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    try {
        writeAndReadAgain(config::parseRig(text, "fuzzed"));
    } catch (const Error& error) {
        promise(std::string(error.what()).starts_with("fuzzed"), "an error names its source");
    }
    return 0;
}

}  // namespace aquarama
