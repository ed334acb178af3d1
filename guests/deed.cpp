// SPDX-License-Identifier: Apache-2.0
#include "guests/deed.h"

#include <algorithm>

namespace aquarama::guests {

namespace {

// Of "#12 blue_tang"; empty where it is no fish.
std::string speciesIn(const std::string& name) {
    const std::size_t space = name.find(' ');
    if (!name.starts_with('#') || space == std::string::npos) return {};
    return name.substr(space + 1);
}

// Whoever does one of these does it for the predator that it sees.
bool isOutOfFear(v1::Explanation::Intention intention) {
    return intention == v1::Explanation::HIDE || intention == v1::Explanation::ESCAPE ||
           intention == v1::Explanation::SCHOOL;
}

}  // namespace

FishDeed deedOf(const v1::Explanation& told) {
    FishDeed deed;
    if (!told.has_intention() || told.intention() == v1::Explanation::INTENTION_UNSPECIFIED)
        return deed;
    deed.does = v1::Explanation::Intention_Name(told.intention());
    std::ranges::transform(deed.does, deed.does.begin(), [](char letter) {
        return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    });
    deed.whom = speciesIn(told.target());
    for (const v1::Sighting& sighting : told.seen())
        if (sighting.kind() == v1::Sighting::PREDATOR && isOutOfFear(told.intention()))
            deed.saw = speciesIn(sighting.name());
    return deed;
}

}  // namespace aquarama::guests
