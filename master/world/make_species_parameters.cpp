// SPDX-License-Identifier: Apache-2.0
#include "master/world/make_species_parameters.h"

#include <algorithm>
#include <string>

namespace aquarama::world {

namespace {

bool names(const std::vector<std::string>& list, const std::string& name) {
    return std::ranges::find(list, name) != list.end();
}

std::uint64_t kindsNamed(const std::vector<WorldSpecies>& cast,
                         const std::vector<std::string>& list) {
    std::uint64_t kinds = 0;
    for (std::size_t i = 0; i < cast.size(); ++i)
        if (names(list, cast[i].name)) kinds |= std::uint64_t{1} << i;
    return kinds;
}

std::uint64_t huntersOf(const std::vector<WorldSpecies>& cast, const std::string& name) {
    std::uint64_t kinds = 0;
    for (std::size_t i = 0; i < cast.size(); ++i)
        if (names(cast[i].habits.hunts, name)) kinds |= std::uint64_t{1} << i;
    return kinds;
}

}  // namespace

fish::SpeciesParameters makeSpeciesParameters(const std::vector<WorldSpecies>& cast,
                                              std::size_t kind,
                                              const fish::Gaits& gaits,
                                              std::size_t first,
                                              std::size_t last) {
    const config::Habits& habits = cast[kind].habits;
    return {.kind = static_cast<std::uint8_t>(kind),
            .first = static_cast<std::uint32_t>(first),
            .last = static_cast<std::uint32_t>(last),
            .hunts = kindsNamed(cast, habits.hunts),
            .huntedBy = huntersOf(cast, cast[kind].name),
            .shadows = kindsNamed(cast, habits.shadows),
            .slow = gaits.speed[fish::indexOf(motion::Action::ForwardSlow)],
            .medium = gaits.speed[fish::indexOf(motion::Action::ForwardMedium)],
            .fast = gaits.speed[fish::indexOf(motion::Action::ForwardFast)],
            .habits = habits};
}

}  // namespace aquarama::world
