// SPDX-License-Identifier: Apache-2.0
#include "master/fish/signs.h"

#include "master/fish/drives.h"

namespace aquarama::fish {

namespace {

bool wouldMate(const SpeciesParameters& parameters, const Mind& mind, Intention aim) {
    if (!mates(parameters)) return false;
    return aim == Intention::Mate ||
           innerLibido(parameters, mind, innerHunger(parameters, mind)) > kDesire;
}

// Of a kind that neither mates nor hunts only this much differs from fish to fish.
unsigned moodOf(std::uint8_t likes, Intention aim) {
    return ((likes & kIsFemale) != 0 ? unsigned{kFemale} : 0U) |
           (aim == Intention::School ? unsigned{kSchooling} : 0U);
}

}  // namespace

void showMood(const SpeciesParameters& parameters,
              const Minds& minds,
              std::uint32_t fish,
              FishView& view) {
    const unsigned away = view.signs[fish] & unsigned{kAway};
    const Mind& mind = minds[fish];
    if (parameters.habits.role ==
        config::Role::Prey) {  // most fish are; they need but three bytes of their mind
        const bool schools =
            mind.intention == Intention::School || mind.remembered == Intention::School;
        view.signs[fish] = static_cast<std::uint8_t>(
            away | moodOf(mind.likes, schools ? Intention::School : mind.intention));
        return;
    }
    const Aim aim = aimOf(mind);
    unsigned signs = away | moodOf(mind.likes, aim.intention);
    if (wouldMate(parameters, mind, aim.intention)) signs |= kWilling;
    if (parameters.habits.role == config::Role::Predator && aim.intention == Intention::Eat)
        signs |= kHunting;
    view.signs[fish] = static_cast<std::uint8_t>(signs);
    view.stage[fish] = mind.stage;
    view.partner[fish] = aim.intention == Intention::Mate ? aim.target : kNobody;
}

}  // namespace aquarama::fish
