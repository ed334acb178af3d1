// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/hunter_cues.h"

#include <algorithm>

namespace aquarama::conductor {

void HunterCues::enter(std::vector<Hunter> hunters) {
    hunters_ = std::move(hunters);
    called_.clear();
}

std::string HunterCues::call(const std::string& species) {
    const auto hunter = std::ranges::find(hunters_, species, &Hunter::species);
    if (hunter != hunters_.end()) {
        called_.push_back({hunter->at});
        return {};
    }
    if (hunters_.empty()) return "no hunter patrols in this scene; set one that has a shark";
    std::string known;
    for (const Hunter& one : hunters_) known += (known.empty() ? "" : ", ") + one.species;
    return "no " + species + " patrols in this scene, only " + known;
}

}  // namespace aquarama::conductor
