// SPDX-License-Identifier: Apache-2.0
// Shows the progress of one job as a bar on a terminal. Elsewhere nothing: stderr is for errors.
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

class ProgressBar {
  public:
    explicit ProgressBar(std::string what);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ProgressBar(ProgressBar&&) = delete;
    ProgressBar& operator=(ProgressBar&&) = delete;
    // 0 to 1, and on a terminal a note behind the bar.
    void show(double share, const std::string& note = "");

  private:
    std::string what_;
    bool isTerminal_;
    int shown_ = -1;  // per cent
    std::string note_;
};

// Captures species: simulates their actions and compiles their repertoires (the paper's section 3).

// Told the share that is done, from 0 to 1; from several threads, but from one at a time.
using Progress = std::function<void(double share)>;

struct CaptureRun {
    unsigned threads = std::thread::hardware_concurrency();
    Progress progress = [](double) {};
    std::function<bool()> isStopped = [] { return false; };  // then it begins nothing more
};

// A repertoire, or why there is none.
struct CaptureOutcome {
    std::optional<motion::Repertoire> repertoire;
    std::string error;
};

// Of each species, in their order. A species that fails leaves the others alone. The same bytes
// each time on one machine, on any number of threads; another machine's sine may differ in the last
// bit, which is why only the master captures.
[[nodiscard]] std::vector<CaptureOutcome> captureRepertoires(
    const std::vector<config::Species>& species, const CaptureRun& run);

// Of one; throws Error.
[[nodiscard]] motion::Repertoire captureRepertoire(const config::Species& species,
                                                   const Progress& progress);

// Where the species files are.

// The folder `config` of the source tree, or share/aquarama/config of an installation, that is
// nearest above the running program. Throws Error where there is none.
[[nodiscard]] std::filesystem::path findConfigFolder();

// Files of the species that are asked for by name or by path; all there are when none is.
[[nodiscard]] std::vector<std::filesystem::path> speciesFiles(
    const std::vector<std::string>& namesOrFiles, const std::filesystem::path& configFolder);

// Repertoires as files: written whole or not at all, and cached by what they were captured from.

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
