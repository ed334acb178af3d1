// SPDX-License-Identifier: Apache-2.0
// Packets of OSC made by hand, apart from the code that is tested.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace aquarama::test {

// Filled up with zeros to whole words, one at least.
inline std::string oscText(std::string_view text) {
    return std::string(text) + std::string(4 - text.size() % 4, '\0');
}

// Big-endian.
inline std::string oscWord(std::uint32_t value) {
    std::string word;
    for (const unsigned shift : {24U, 16U, 8U, 0U})
        word += static_cast<char>(value >> shift & 0xFFU);
    return word;
}

// `arguments`: their bytes, one after the other.
inline std::string oscMessage(std::string_view address,
                              std::string_view tags,
                              std::string_view arguments = "") {
    return oscText(address) + oscText("," + std::string(tags)) + std::string(arguments);
}

// With a time that means at once.
inline std::string oscBundle(const std::vector<std::string>& parts) {
    std::string bundle = oscText("#bundle") + oscWord(0) + oscWord(1);
    for (const std::string& part : parts)
        bundle += oscWord(static_cast<std::uint32_t>(part.size())) + part;
    return bundle;
}

}  // namespace aquarama::test
