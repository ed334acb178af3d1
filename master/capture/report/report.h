// SPDX-License-Identifier: Apache-2.0
// A page about a repertoire: pictures like the paper's Figs. 3 and 4, and its figures beside those
// of living fish.
#pragma once

#include <filesystem>

#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"

namespace aquarama {

// Writes SPECIES.html and the pictures it shows; returns its path. Throws Error when the folder
// cannot be written.
std::filesystem::path writeReport(const Repertoire& repertoire,
                                  const FishBody& body,
                                  const std::filesystem::path& folder);

}  // namespace aquarama
