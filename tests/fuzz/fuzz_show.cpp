// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "common/base/log.h"
#include "common/wire/show_file.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

int fuzzShow(const std::uint8_t* bytes, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    try {
        const wire::ShowChange kept = wire::parseKeptShow(text, "fuzzed");
        const bool isPattern = !kept.pattern || wire::nameOf(*kept.pattern) != "";
        promise(isPattern, "a pattern has a name");
        promise(!kept.quality || !*kept.quality || !config::nameOf(**kept.quality).empty(),
                "a quality has a name");
    } catch (const Error& error) {
        promise(std::string(error.what()).starts_with("fuzzed"), "an error names its source");
    }
    return 0;
}

}  // namespace aquarama
