// SPDX-License-Identifier: Apache-2.0
#include "master/capture/exchange/markers.h"

#include <array>

namespace aquarama::exchange {

namespace {

constexpr std::size_t kDorsalTip = 21;  // behind the nose and five rings of four

struct Corner {
    const char* label;
    const char* description;
};
constexpr std::array kCorners{Corner{"DL", "dorsal left"},
                              Corner{"DR", "dorsal right"},
                              Corner{"VR", "ventral right"},
                              Corner{"VL", "ventral left"}};

std::string ringOf(std::size_t node) {
    return std::to_string(1 + (node - 1) / kCorners.size());
}

const Corner& cornerOf(std::size_t node) {
    return kCorners.at((node - 1) % kCorners.size());
}

}  // namespace

std::string markerLabel(std::size_t node) {
    if (node == 0) return "NOSE";
    if (node >= kDorsalTip) return node == kDorsalTip ? "TAIL_D" : "TAIL_V";
    return "R" + ringOf(node) + "_" + cornerOf(node).label;
}

std::string markerDescription(std::size_t node) {
    const std::string number = "nodal point " + std::to_string(node) + ", ";
    if (node == 0) return number + "nose";
    if (node >= kDorsalTip)
        return number + (node == kDorsalTip ? "dorsal" : "ventral") + " tip of the tail";
    return number + "ring " + ringOf(node) + " of 5, " + cornerOf(node).description;
}

}  // namespace aquarama::exchange
