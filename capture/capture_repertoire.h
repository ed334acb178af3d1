// SPDX-License-Identifier: Apache-2.0
// Captures the repertoires of species (the paper's section 3), finds the species files, and keeps
// captured repertoires in a cache.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "common/config/species.h"
#include "common/motion/repertoire.h"

namespace aquarama::capture {

// Capture: simulates the actions of species and compiles their repertoires.

// Called with the share that is done, from 0 to 1, by several threads, but never by two at once.
using Progress = std::function<void(double share)>;

// How to run a capture. The functions are not empty.
struct CaptureRun {
    unsigned threads = std::thread::hardware_concurrency();
    Progress progress = [](double) {};
    // Called once by repertoiresFor(), before it simulates: so many species are not in the cache.
    std::function<void(std::size_t missing)> begins = [](std::size_t) {};
    // Asked by any thread before each job. When it says true, no further job begins.
    std::function<bool()> isStopped = [] { return false; };
};

// A repertoire, or the error message that says why there is none.
struct CaptureOutcome {
    std::optional<motion::Repertoire> repertoire;
    std::string error;
};

// One outcome for each species, in their order. A species that fails does not affect the others.
// The result is the same, bit by bit, each time on one machine and on any number of threads. The
// sine of another machine may differ in the last bit, which is why only the master captures.
[[nodiscard]] std::vector<CaptureOutcome> captureRepertoires(
    const std::vector<config::Species>& species, const CaptureRun& run);

// The repertoire of one species; throws Error when it cannot be captured.
[[nodiscard]] motion::Repertoire captureRepertoire(const config::Species& species,
                                                   const Progress& progress);

// Species files.

// The folder `config` of the source tree, or share/aquarama/config of an installation: the nearest
// above the running program that holds a folder `species`. Throws Error where there is none.
[[nodiscard]] std::filesystem::path findConfigFolder();

// The files of the species that are given by name or by path; of all species, sorted, when the list
// is empty. Throws Error for one that does not exist.
[[nodiscard]] std::vector<std::filesystem::path> speciesFiles(
    const std::vector<std::string>& namesOrFiles, const std::filesystem::path& configFolder);

// Repertoires as files: written completely or not at all, and cached under a digest of the data
// that they were captured from.

// The bytes of a file, not yet checked to be a repertoire. Throws Error where it cannot be read or
// is far too large.
[[nodiscard]] std::vector<std::byte> readRepertoireFile(const std::filesystem::path& path);

// The encoded repertoire of a species, or the error message that says why there is none.
struct RepertoireFile {
    std::string species;
    std::vector<std::byte> bytes;
    std::string error;
};

// One for each species, in their order: read from the cache folder where it was captured before,
// else captured now and written there. A damaged file is captured again.
[[nodiscard]] std::vector<RepertoireFile> repertoiresFor(const std::vector<config::Species>& all,
                                                         const std::filesystem::path& cacheFolder,
                                                         const CaptureRun& run);

}  // namespace aquarama::capture
