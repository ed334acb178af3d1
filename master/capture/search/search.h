// SPDX-License-Identifier: Apache-2.0
// Finds muscles, tissue and water with which a species swims as living fish do.
#pragma once

#include <functional>

#include "common/config/species.h"
#include "master/capture/search/search_journal.h"

namespace aquarama::search {

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

}  // namespace aquarama::search
