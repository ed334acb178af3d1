// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "common/base/log.h"
#include "common/wire/wanted_show.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

int fuzzShow(const std::uint8_t* bytes, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    try {
        const v1::WantedShow kept = wire::parseKeptShow(text, "fuzzed");
        const bool isEmpty = !kept.has_scene() && !kept.has_quality() && !kept.has_pattern() &&
                             !kept.has_black() && !kept.has_freeze();
        promise(wire::textOf(kept).empty() == isEmpty, "what is set has words");
    } catch (const Error& error) {
        promise(std::string(error.what()).starts_with("fuzzed"), "an error names its source");
    }
    return 0;
}

}  // namespace aquarama
