// SPDX-License-Identifier: Apache-2.0
// What the report is drawn from, as JSON: master/capture/report/draw_report.py and
// draw_controllers.py make the page and the pictures of it.
#pragma once

#include <filesystem>
#include <string>

#include "common/config/species.h"
#include "common/motion/repertoire.h"

namespace aquarama::report {

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

}  // namespace aquarama::report
