// SPDX-License-Identifier: Apache-2.0
// How few segments are enough: one script whose speeds and turns come from a continuous range,
// given to replicas that know more or fewer segments.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/config/species.h"
#include "common/motion/repertoire.h"

namespace aquarama::report {

// Grades of speed go from slow, 0, over medium to fast, 1; those of turns from none, 0, over
// gradual to sharp, 1. A turn to the right is made of the one to the left.
struct Vocabulary {
    std::vector<double> speeds;
    std::vector<double> turns;
    [[nodiscard]] std::size_t segments() const { return speeds.size() + 2 * turns.size(); }
};

struct VocabularyErrors {
    std::size_t segments = 0;
    std::size_t bytes = 0;        // with control points
    double shapeWithin = 0;       // root mean square, body lengths
    double pathError = 0;         // median over the commands, share of the path
    double turnHeadingError = 0;  // root mean square over the turns, radians
};

// With 1, 3, 5, 7 (as every repertoire here has), 11 and 15 segments. The replica plays the segment
// of the nearest grade, at the beat that was asked for.
[[nodiscard]] std::vector<VocabularyErrors> compareVocabularies(
    const config::Species& species,
    const motion::Repertoire& repertoire,
    std::uint64_t seed,
    double seconds);

struct SpeciesVocabularies {
    std::string species;
    std::vector<VocabularyErrors> errors;
};

}  // namespace aquarama::report
