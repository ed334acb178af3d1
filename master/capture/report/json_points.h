// SPDX-License-Identifier: Apache-2.0
// Points and lists of them in JSON, to a hundred thousandth of a body length.
#pragma once

#include <cmath>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace aquarama::report {

[[nodiscard]] inline nlohmann::json pointOf(double value) {
    return std::round(value * 1e5) / 1e5;
}
[[nodiscard]] inline nlohmann::json pointOf(const glm::dvec2& point) {
    return {pointOf(point.x), pointOf(point.y)};
}
[[nodiscard]] inline nlohmann::json pointOf(const glm::dvec3& point) {
    return {pointOf(point.x), pointOf(point.y), pointOf(point.z)};
}

// Of whatever holds numbers or points.
template <class Points>
[[nodiscard]] nlohmann::json listOf(const Points& points) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& point : points) list.push_back(pointOf(point));
    return list;
}

}  // namespace aquarama::report
