// SPDX-License-Identifier: Apache-2.0
// A line of comma separated values.
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <utility>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "common/config/species.h"
#include "common/motion/repertoire.h"

namespace aquarama::report {

// None of the values may have a comma in it.
template <class... Values>
void addRow(std::ostream& csv, const Values&... values) {
    const char* comma = "";
    ((csv << std::exchange(comma, ",") << values), ...);
    csv << '\n';
}

// Points and lists of them in JSON, to a hundred thousandth of a body length.

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

// What the report is drawn from, as JSON: master/capture/report/draw_report.py and
// draw_controllers.py make the page and the pictures of it.

// Of a repertoire: its file, body, gaits, turns, closure and each segment seen from above. Lengths
// are in body lengths.
[[nodiscard]] std::string reportData(const motion::Repertoire& repertoire);

// What the dynamic fish does under each of the nine motor controllers. It is simulated for that: in
// its stride at medium speed, then so ordered.
[[nodiscard]] std::string controllersData(const config::Species& species);

// Write them as SPECIES.json and controllers.json; return the path. Throw Error where the folder
// cannot be written.
std::filesystem::path writeReport(const motion::Repertoire& repertoire,
                                  const std::filesystem::path& folder);
std::filesystem::path writeControllers(const config::Species& species,
                                       const std::filesystem::path& folder);

// What a repertoire holds, as a table of text.

// Throws Error, naming `source`, when the bytes are no intact repertoire.
[[nodiscard]] std::string inspectRepertoire(std::span<const std::byte> bytes,
                                            const std::string& source);

// Of the file format.
[[nodiscard]] int formatVersionOf(std::span<const std::byte> intactRepertoire);

}  // namespace aquarama::report
