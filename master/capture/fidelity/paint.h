// SPDX-License-Identifier: Apache-2.0
// How the fidelity report's pictures are drawn.
#pragma once

#include <string>

#include "master/capture/report/svg.h"

namespace aquarama::fidelity {

inline constexpr const char* kInk = "#1d2b36";
inline constexpr const char* kGrid = R"(stroke="#e2e8ec" stroke-width="1")";

[[nodiscard]] inline report::SvgStyle letters(int size, const char* anchor = "start") {
    return "font-size=\"" + std::to_string(size) + "\" text-anchor=\"" + anchor + "\" fill=\"" +
           kInk + "\"";
}

[[nodiscard]] inline report::SvgStyle stroke(const std::string& colour,
                                             double width,
                                             const std::string& more = "") {
    return "fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"" + report::fixed(width, 1) +
           "\" stroke-linejoin=\"round\" " + more;
}

}  // namespace aquarama::fidelity
