// SPDX-License-Identifier: Apache-2.0
#include "common/parts/part.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <optional>
#include <string_view>

#include "common/base/log.h"

namespace aquarama::parts {

namespace {

// Digits and nothing else.
std::optional<std::uint32_t> numberIn(std::string_view text) {
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

}  // namespace

Part parsePart(const std::string& text) {
    const std::size_t slash = text.find('/');
    if (slash != std::string::npos) {
        const auto number = numberIn(std::string_view(text).substr(0, slash));
        const auto of = numberIn(std::string_view(text).substr(slash + 1));
        if (number && of && *number >= 1 && *number <= *of && *of <= kMostParts)
            return {*number, *of};
    }
    throw Error("\"" + text + "\" is no part; write K/N, such as 2/5: K from 1 to N, N up to " +
                std::to_string(kMostParts));
}

std::string partPath(std::string out, Part part) {
    while (out.size() > 1 && out.ends_with('/')) out.pop_back();
    return out + '.' + std::to_string(part.number) + "-of-" + std::to_string(part.of) + ".aqpart";
}

UnitRange unitsOf(Part part, std::size_t units) {
    assert(part.number >= 1);
    assert(part.number <= part.of);
    // The first parts have one more. No product: a film may have very many units.
    const std::size_t each = units / part.of;
    const std::size_t more = units % part.of;
    const auto before = [&](std::size_t parts) { return parts * each + std::min(parts, more); };
    return {before(part.number - 1), before(part.number)};
}

}  // namespace aquarama::parts
