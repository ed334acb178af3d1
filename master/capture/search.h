// SPDX-License-Identifier: Apache-2.0
// The parameters that the search may change, as a unit cube.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "common/config/species.h"

namespace aquarama::capture {

// A point of the cube: each coordinate goes from a parameter's least value at 0 to its most at 1 by
// equal factors.
using SearchPoint = std::vector<double>;

// Parameters outside their range come out on its edge.
[[nodiscard]] SearchPoint pointOf(const config::Species& species);
[[nodiscard]] config::Species speciesAt(const SearchPoint& point, const config::Species& species);

// A search's evaluations, kept line by line as they are made: what makes it go on where it was
// interrupted.

struct SearchTrial {
    SearchPoint point;
    double miss = 0;  // of gait_objective.h
    double leastStrouhal = 0, mostStrouhal = 0;
    double leastStride = 0, mostStride = 0;  // body lengths a beat
    friend bool operator==(const SearchTrial&, const SearchTrial&) = default;
};

// A text file: a first line that says of which search, then a line for each trial. A last line that
// was not finished, as an interruption leaves it, is cut off.
class SearchJournal {
  public:
    // Opens or begins it. Throws Error when the file is of another search, is damaged, or cannot be
    // written.
    SearchJournal(std::filesystem::path path, const std::string& search);

    [[nodiscard]] const std::vector<SearchTrial>& trials() const { return trials_; }
    void add(const SearchTrial& trial);  // is in the file when this returns

  private:
    std::filesystem::path path_;
    std::vector<SearchTrial> trials_;
    std::ofstream file_;
};

// Finds muscles, tissue and water with which a species swims as living fish do.

// Told after each trial: how many there were, and the best of them.
using SearchProgress = std::function<void(std::size_t trials, const SearchTrial& best)>;

// From the species as it is, until every gait swims like a fish or so many trials were made; the
// best of them. Deterministic: trials that the journal holds are not simulated again, so that an
// interrupted search goes on to the end that it would have had. Throws Error when the journal holds
// the trials of another program.
[[nodiscard]] SearchTrial searchGaits(const config::Species& species,
                                      std::size_t mostTrials,
                                      SearchJournal& journal,
                                      const SearchProgress& progress);

// What a journal of this search begins with.
[[nodiscard]] std::string searchName(const std::string& speciesText);

}  // namespace aquarama::capture
