// SPDX-License-Identifier: Apache-2.0
#include "master/study/occupation.h"

#include <array>
#include <bit>
#include <cassert>

#include <glm/geometric.hpp>

namespace aquarama::study {

namespace {

// The cosine of 30 degrees, and the least speed of both that ride, metres a second.
constexpr float kSameWay = 0.87F;
constexpr float kSwims = 0.05F;
// Of its slow gait, the share below which a fish stands at its post; and the sine of the angle from
// which it hangs head down.
constexpr float kStands = 0.5F;
constexpr float kHeadDown = 0.4F;

bool isOneWayWith(const fish::VisibleFish& one, const fish::VisibleFish& other) {
    return one.speed > kSwims && other.speed > kSwims &&
           glm::dot(one.heading, other.heading) > kSameWay;
}

Occupation atEase(const StudiedFish& of, std::uint32_t fish) {
    const fish::SpeciesParameters& species = of.species[of.view.kind[fish]];
    if (species.habits.hunt.ambush) {
        if (ridesBesideAnother(of, fish)) return Occupation::Shadow;
        const fish::VisibleFish& seen = of.view.fish[fish];
        const bool stands = seen.speed < kStands * species.slow * seen.length;
        if (stands || seen.heading.y < -kHeadDown) return Occupation::LieInWait;
    }
    return Occupation::Patrol;
}

}  // namespace

const char* nameOf(Occupation occupation) {
    constexpr std::array<const char*, kOccupations - fish::kIntentions> kNames{
        "inspect", "shadow", "lie in wait", "patrol"};
    const auto number = static_cast<std::size_t>(occupation);
    assert(number < kOccupations);
    return number < fish::kIntentions ? fish::nameOf(static_cast<fish::Intention>(number))
                                      : kNames.at(number - fish::kIntentions);
}

bool ridesBesideAnother(const StudiedFish& of, std::uint32_t fish) {
    const fish::VisibleFish& own = of.view.fish[fish];
    for (std::uint64_t kinds = of.species[of.view.kind[fish]].shadows; kinds != 0;
         kinds &= kinds - 1) {
        const fish::SpeciesParameters& hosts = of.species[std::size_t(std::countr_zero(kinds))];
        for (std::uint32_t host = hosts.first; host < hosts.last; ++host) {
            const fish::VisibleFish& other = of.view.fish[host];
            if (!of.view.shows(host, fish::kAway) && isOneWayWith(own, other) &&
                glm::distance(own.position, other.position) < kBesideMetres)
                return true;
        }
    }
    return false;
}

bool inspects(const StudiedFish& of, std::uint32_t fish) {
    const fish::Aim aim = fish::aimOf(of.minds[fish]);
    if (aim.intention != fish::Intention::Clean || aim.target == fish::kNobody) return false;
    return glm::distance(of.view.position(fish), of.view.position(aim.target)) <
           of.view.fish[aim.target].length;
}

bool isSheltered(const StudiedFish& of, std::uint32_t fish) {
    const fish::Intention aim = fish::aimOf(of.minds[fish]).intention;
    return !of.species[of.view.kind[fish]].habits.hidesIn.empty() &&
           (aim == fish::Intention::Hide || aim == fish::Intention::Rest);
}

Occupation occupationOf(const StudiedFish& of, std::uint32_t fish) {
    assert(!of.view.shows(fish, fish::kAway));
    const fish::Intention present = of.minds[fish].intention;
    const bool isInTheWay =
        present == fish::Intention::AvoidFish || present == fish::Intention::AvoidObstacle;
    const fish::Intention does = isInTheWay ? fish::aimOf(of.minds[fish]).intention : present;
    const bool hunts = of.species[of.view.kind[fish]].habits.role == config::Role::Predator;
    if (hunts && (does == fish::Intention::Wander || (isInTheWay && does == present)))
        return atEase(of, fish);
    if (inspects(of, fish)) return Occupation::Inspect;
    return static_cast<Occupation>(does);
}

}  // namespace aquarama::study
