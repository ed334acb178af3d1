// SPDX-License-Identifier: Apache-2.0
// Repertoires as files: written whole or not at all, and cached by what they were captured from.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "master/capture/compile/capture_repertoire.h"

namespace aquarama::capture {

// The bytes of a file that may be a repertoire. Throws Error.
[[nodiscard]] std::vector<std::byte> readRepertoireFile(const std::filesystem::path& path);

// The encoded repertoire of a species, or why there is none.
struct RepertoireFile {
    std::string species;
    std::vector<std::byte> bytes;
    std::string error;
};

// Of each species, in their order: from the folder where it was captured before, else captured now
// and kept there. A damaged file is captured anew.
[[nodiscard]] std::vector<RepertoireFile> repertoiresFor(const std::vector<config::Species>& all,
                                                         const std::filesystem::path& cacheFolder,
                                                         const CaptureRun& run);

}  // namespace aquarama::capture
