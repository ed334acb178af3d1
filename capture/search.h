// SPDX-License-Identifier: Apache-2.0
// The search for muscles, tissue and water with which a species swims as living fish do: its
// parameters as a unit cube, its journal, and the optimisation.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/base/output_file.h"
#include "common/config/species.h"

namespace aquarama::capture {

// A point of the cube. Each coordinate, 0 to 1, is a parameter on a logarithmic scale from its
// least value to its greatest.
using SearchPoint = std::vector<double>;

// The point of a species; parameters outside of their range are moved to its edge.
[[nodiscard]] SearchPoint pointOf(const config::Species& species);
// The species with the parameters of a point. Coordinates are clamped to 0 .. 1.
[[nodiscard]] config::Species speciesAt(const SearchPoint& point, const config::Species& species);

// Where a search begins: its first start at the species as it is, each other one at a point of the
// cube by chance, the same for each number.
[[nodiscard]] config::Species beginningOf(std::uint32_t start, const config::Species& species);

// The journal: the evaluations of a search, written line by line as they are made, so that an
// interrupted search can continue.

// One evaluation. The extremes are over the three gaits.
struct SearchTrial {
    SearchPoint point;
    double miss = 0;  // missOf() in gait_trial.h
    double leastStrouhal = 0, mostStrouhal = 0;
    double leastStride = 0, mostStride = 0;  // body lengths a beat
    friend bool operator==(const SearchTrial&, const SearchTrial&) = default;
};

// A text file: the first line names the search, then there is a line for each trial. A last line
// that was not finished, as an interruption leaves it, is cut off. One process writes it at a time.
class SearchJournal {
  public:
    // Opens the file or creates it. `search` is the first line, see searchName(). Throws Error when
    // the file is of another search, is damaged, or cannot be written.
    SearchJournal(std::filesystem::path path, const std::string& search);

    // All trials of the file, in order.
    [[nodiscard]] const std::vector<SearchTrial>& trials() const { return trials_; }
    // The trial has been handed to the file when this returns. Throws Error when that fails.
    void add(const SearchTrial& trial);

  private:
    std::filesystem::path path_;
    std::vector<SearchTrial> trials_;
    GrowingFile file_;
};

// The optimisation.

// Called after each trial, on the thread of the search: how many there were, and the best of them.
using SearchProgress = std::function<void(std::size_t trials, const SearchTrial& best)>;

// Starts from the species as it is. Ends when every gait swims like a living fish or after
// mostTrials trials, at least 1; returns the best of them. Deterministic: trials that the journal
// holds are not simulated again, so an interrupted search ends as it would have without the
// interruption. Throws Error when the trials of the journal are not those that this program would
// make. What `progress` throws ends the search and is passed on.
[[nodiscard]] SearchTrial searchGaits(const config::Species& species,
                                      std::size_t mostTrials,
                                      SearchJournal& journal,
                                      const SearchProgress& progress);

// The first line of a journal: the version of the search and the digest of the species file.
[[nodiscard]] std::string searchName(const std::string& speciesText);

// Changes numbers in the text of a species file and leaves the rest, comments and layout, as it is.

// The text with the value of one field replaced, in four significant digits. `field` is the path to
// it, as in {"swim", "slow", "gain"}; the first field with this path is changed. Throws Error when
// the text has none.
[[nodiscard]] std::string withNumber(const std::string& text,
                                     const std::vector<std::string>& field,
                                     double value);

// The text with all parameters that the search may change, and the strengths of the turns, set to
// those of `species`. Throws Error when a field is missing.
[[nodiscard]] std::string withGaitsOf(const config::Species& species, std::string text);

}  // namespace aquarama::capture
