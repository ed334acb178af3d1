// SPDX-License-Identifier: Apache-2.0
// Captures the repertoires of species (the paper's section 3).
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/config/species.h"
#include "common/motion/repertoire.h"

namespace aquarama::capture {

// Called with the share that is done, from 0 to 1, by several threads, but never by two at once.
using Progress = std::function<void(double share)>;

// How to run a capture. The functions are not empty.
struct CaptureRun {
    unsigned threads = std::thread::hardware_concurrency();
    Progress progress = [](double) {};
    // Called once by repertoiresFor(), before it simulates: so many species are kept nowhere.
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

}  // namespace aquarama::capture
