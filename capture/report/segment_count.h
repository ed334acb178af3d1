// SPDX-License-Identifier: Apache-2.0
// How many segments a repertoire needs: a script whose speeds and turns come from a continuous
// range is given to replicas whose repertoires have more or fewer segments.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/config/species.h"
#include "common/motion/repertoire.h"

namespace aquarama::report {

// The segments of a repertoire, as grades from 0 to 1. A grade of speed is slow at 0, medium at 0.5
// and fast at 1; a grade of a turn is no turn at 0, gradual at 0.5 and sharp at 1. There is a right
// turn for each left one, compiled from it.
struct Vocabulary {
    std::vector<double> speeds;
    std::vector<double> turns;
    // Number of segments; each turn counts to both sides.
    [[nodiscard]] std::size_t segments() const { return speeds.size() + 2 * turns.size(); }
};

// The errors of a replica with one vocabulary over the script.
struct VocabularyErrors {
    std::size_t segments = 0;
    std::size_t bytes = 0;        // of the segments in memory, with control points
    double shapeWithin = 0;       // root mean square, body lengths
    double pathError = 0;         // median over the commands, share of the path
    double turnHeadingError = 0;  // root mean square over the turns, radians
};

// The errors with 1, 3, 5, 7 (as every repertoire here has), 11 and 15 segments, over a script of
// at least `seconds` that depends on the seed. The replica plays the segment of the nearest grade,
// at the commanded beat frequency. `repertoire` is that of the species. Throws Error where a
// segment cannot be captured. Every grade of the vocabularies is captured in the call.
[[nodiscard]] std::vector<VocabularyErrors> compareVocabularies(
    const config::Species& species,
    const motion::Repertoire& repertoire,
    std::uint64_t seed,
    double seconds);

// The results of compareVocabularies() for one species.
struct SpeciesVocabularies {
    std::string species;
    std::vector<VocabularyErrors> errors;
};

}  // namespace aquarama::report
