// SPDX-License-Identifier: Apache-2.0
#include "master/capture/exchange/csv.h"

#include <array>
#include <charconv>

namespace aquarama::exchange {

namespace {

void append(std::string& text, double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.begin(), digits.end(), static_cast<float>(value)).ptr;
    text.append(digits.begin(), end);
}

}  // namespace

std::string csvOf(const Take& take) {
    std::string text = "time_s";
    for (std::size_t node = 0; node < body::kNodalPoints; ++node)
        for (const char* axis : {"_x_m", "_y_m", "_z_m"})
            text += ",n" + std::to_string(node) + axis;
    text += '\n';
    for (const TakeFrame& frame : take.frames) {
        append(text, frame.seconds);
        for (const glm::dvec3& node : frame.nodes)
            for (const double metres : {node.x, node.y, node.z}) append(text += ',', metres);
        text += '\n';
    }
    return text;
}

}  // namespace aquarama::exchange
