// SPDX-License-Identifier: Apache-2.0
// A page about a repertoire: pictures like the paper's Figs. 3 and 4, and its figures beside those
// of living fish.
#pragma once

#include <filesystem>
#include <string>

#include "common/motion/repertoire.h"

namespace aquarama::report {

// One page of HTML with its pictures inside.
[[nodiscard]] std::string reportPage(const motion::Repertoire& repertoire);

// Writes it as SPECIES.html; returns its path. Throws Error when the folder cannot be written.
std::filesystem::path writeReport(const motion::Repertoire& repertoire,
                                  const std::filesystem::path& folder);

}  // namespace aquarama::report
