// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "console/pjlink.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

int fuzzPjlink(const std::uint8_t* bytes, std::size_t size) {
    const std::string line(reinterpret_cast<const char*>(bytes), size);
    const auto isPrintable = [](const std::string& text) {
        return std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
    };
    if (const auto greeting = console::readGreeting(line))
        promise(greeting->salt.size() <= 32 && isPrintable(greeting->salt), "a salt is short text");
    for (const char* const command : {"POWR ?", "LAMP ?"})
        if (const auto value = console::readPjlinkAnswer(line, command))
            promise(
                !value->empty() && value->size() < console::kMostPjlinkBytes && isPrintable(*value),
                "a value is short text");
    promise(console::problemsIn(line).size() <= 6, "a projector has six parts");
    return 0;
}

}  // namespace aquarama
