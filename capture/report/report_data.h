// SPDX-License-Identifier: Apache-2.0
// Data of the pages and figures: rows of CSV, points in JSON, the report about a repertoire, the
// trials of the motor controllers; and a repertoire as a table of text.
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

// Writes one row of CSV. No value may contain a comma, a quote or a line end.
template <class... Values>
void addRow(std::ostream& csv, const Values&... values) {
    const char* comma = "";
    ((csv << std::exchange(comma, ",") << values), ...);
    csv << '\n';
}

// Numbers and points in JSON, rounded to five decimals: to 1e-5 body lengths.
[[nodiscard]] inline nlohmann::json pointOf(double value) {
    return std::round(value * 1e5) / 1e5;
}
[[nodiscard]] inline nlohmann::json pointOf(const glm::dvec2& point) {
    return {pointOf(point.x), pointOf(point.y)};
}
[[nodiscard]] inline nlohmann::json pointOf(const glm::dvec3& point) {
    return {pointOf(point.x), pointOf(point.y), pointOf(point.z)};
}

// A JSON list of any range of numbers or points.
template <class Points>
[[nodiscard]] nlohmann::json listOf(const Points& points) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& point : points) list.push_back(pointOf(point));
    return list;
}

// The data of the figures as JSON text, which draw_report.py and draw_controllers.py beside this
// file read.

// A repertoire: its file, body, gaits, turns, closure and each segment seen from above. Lengths are
// body lengths.
[[nodiscard]] std::string reportData(const motion::Repertoire& repertoire);

inline constexpr int kMoments = 240;  // intervals between the recorded moments of a trial

// The biomechanical fish under each of the nine motor controllers, simulated in this call: most
// trials start in medium swimming; balance starts rolled by 40 degrees and retreat at rest. JSON.
[[nodiscard]] std::string controllersData(const config::Species& species);

// Write reportData() as SPECIES.json and controllersData() as controllers.json into the folder and
// return the path. Throw Error where that cannot be written.
std::filesystem::path writeReport(const motion::Repertoire& repertoire,
                                  const std::filesystem::path& folder);
std::filesystem::path writeControllers(const config::Species& species,
                                       const std::filesystem::path& folder);

// The contents of a repertoire file as a table of text. Throws Error, naming `source`, when the
// bytes are not an intact repertoire.
[[nodiscard]] std::string inspectRepertoire(std::span<const std::byte> bytes,
                                            const std::string& source);

// The version of the file format, from the head of a repertoire file.
[[nodiscard]] int formatVersionOf(std::span<const std::byte> intactRepertoire);

}  // namespace aquarama::report
