// SPDX-License-Identifier: Apache-2.0
#include "guests/deed.h"

#include <cctype>

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

// The name of an intention in small letters.
std::string nameOf(v1::Explanation::Intention intention) {
    std::string name = v1::Explanation::Intention_Name(intention);
    for (char& letter : name) letter = static_cast<char>(std::tolower(letter));
    return name;
}

}  // namespace

FishDeed deedOf(const v1::Explanation& told) {
    if (!told.has_intention()) return {};
    FishDeed deed{.does = nameOf(told.intention()), .whom = speciesIn(told.target()), .saw = {}};
    if (!isOutOfFear(told.intention())) return deed;
    for (const v1::Sighting& sighting : told.seen())
        if (sighting.kind() == v1::Sighting::PREDATOR) deed.saw = speciesIn(sighting.name());
    return deed;
}

}  // namespace aquarama::guests
