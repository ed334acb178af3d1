// SPDX-License-Identifier: Apache-2.0
// Captures species: simulates their actions and compiles their repertoires (the paper's section 3).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/config/species.h"
#include "common/motion/repertoire.h"

namespace aquarama::capture {

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

}  // namespace aquarama::capture
