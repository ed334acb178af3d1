// SPDX-License-Identifier: Apache-2.0
// The species that have sheets, by their numbers, and the texts of sheets: both are data.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/config/species.h"
#include "drawings/sheet.h"

namespace aquarama::drawings {

// The list config/sheets.txt, and its species. Files are read at once; sheets are made when they
// are first asked for, and kept.
class Catalogue {
  public:
    // Throws Error where a file cannot be read, or the list has more than kMostSpecies.
    Catalogue();
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    // Throws Error, which says which there are, for a name that is not in the list.
    [[nodiscard]] const Sheet& sheetOf(const std::string& name);
    // Null where no species has the number.
    [[nodiscard]] const Sheet* sheetOf(int number);

  private:
    std::vector<std::string> names_;  // by number
    std::vector<config::Species> species_;
    std::map<int, Sheet> sheets_;
};

// The line of text of a sheet in a language ("de"). Throws Error, which says which there are.
[[nodiscard]] std::string lineIn(const std::string& language);

}  // namespace aquarama::drawings
