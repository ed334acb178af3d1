// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "common/base/log.h"
#include "common/config/keys.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

int fuzzKeys(const std::uint8_t* bytes, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    try {
        const config::KeyFile key = config::parseKeyFile(text, "fuzzed");
        promise(key.publicKey.size() == 40 && key.secretKey.size() == 40,
                "keys have 40 characters");
    } catch (const Error& error) {
        promiseLine(error.what());
        promise(std::string(error.what()).starts_with("fuzzed"), "an error names its source");
    }
    return 0;
}

}  // namespace aquarama
