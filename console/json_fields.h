// SPDX-License-Identifier: Apache-2.0
// Fields of JSON that others wrote: one that is missing or of another type is as if it were empty.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace aquarama::console {

// Empty where it is no text.
[[nodiscard]] inline std::string textIn(const nlohmann::json& object, const char* field) {
    const auto found = object.find(field);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

// 0 where it is no number.
[[nodiscard]] inline double numberIn(const nlohmann::json& object, const char* field) {
    const auto found = object.find(field);
    return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

}  // namespace aquarama::console
