// SPDX-License-Identifier: Apache-2.0
// Finds the files of species, and the repertoires that were captured from them before: those that
// came with the programs, and those that this user's cache has.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "capture/capture_repertoire.h"
#include "common/config/species.h"

namespace aquarama::capture {

// The folder `config` of the source tree, or share/aquarama/config of an installation: the nearest
// above the running program that holds a folder `species`. Throws Error where there is none.
[[nodiscard]] std::filesystem::path findConfigFolder();

// The files of the species that are given by name or by path; of all species, sorted, when the list
// is empty. Throws Error for one that does not exist.
[[nodiscard]] std::vector<std::filesystem::path> speciesFiles(
    const std::vector<std::string>& namesOrFiles, const std::filesystem::path& configFolder);

// The bytes of a file, not yet checked to be a repertoire. Throws Error where it cannot be read or
// is far too large.
[[nodiscard]] std::vector<std::byte> readRepertoireFile(const std::filesystem::path& path);

// The encoded repertoire of a species, or the error message that says why there is none.
struct RepertoireFile {
    std::string species;
    std::vector<std::byte> bytes;
    std::string error;
};

// Where captured repertoires lie, each under a digest of the data that it was captured from.
struct RepertoireFolders {
    std::filesystem::path own;      // of this user: what is captured is kept there
    std::filesystem::path shipped;  // came with the programs: only read; empty: there is none
};
// The folder "repertoires" of cacheFolder(), and share/aquarama/repertoires, the nearest above the
// running program.
[[nodiscard]] RepertoireFolders repertoireFolders();

// One for each species, in their order: read from a folder where it was captured before, else
// captured now and kept. A damaged file is captured again.
[[nodiscard]] std::vector<RepertoireFile> repertoiresFor(const std::vector<config::Species>& all,
                                                         const RepertoireFolders& folders,
                                                         const CaptureRun& run);

}  // namespace aquarama::capture
