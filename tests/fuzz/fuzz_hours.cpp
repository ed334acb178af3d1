// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "common/base/log.h"
#include "common/config/hours.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

int fuzzHours(const std::uint8_t* bytes, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    try {
        const config::Hours hours = config::parseHours(text, "fuzzed");
        for (const config::OpenSpan& span : hours.open) {
            promise(span.from >= 0 && span.from < span.to && span.to <= 2 * 1440,
                    "a span ends after it begins, on the next day at the latest");
            promise(!span.weekdays.empty(), "a span has days");
        }
        static_cast<void>(config::wantedAt(hours, 0LL));
    } catch (const Error& error) {
        promiseLine(error.what());
        promise(std::string(error.what()).starts_with("fuzzed"), "an error names its source");
    }
    return 0;
}

}  // namespace aquarama
