// SPDX-License-Identifier: Apache-2.0
// A search's evaluations, kept line by line as they are made: what makes it go on where it was
// interrupted.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "master/capture/search/search_space.h"

namespace aquarama::search {

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

}  // namespace aquarama::search
