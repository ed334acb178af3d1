// SPDX-License-Identifier: Apache-2.0
// What a fish's body asks for by itself, before anything in sight adds to it (Tu 1996, section
// 5.2): perception searches only for what is wanted, and a fish shows whether it would mate.
#pragma once

#include "master/fish/minds.h"
#include "master/fish/species_parameters.h"

namespace aquarama::fish {

// What a fish feels at one thought, each 0 to 1: feel() of master/behaviour/mental_state.h.
struct Feelings {
    float hunger = 0, libido = 0;
    float fear = 0;          // of all predators in sight together
    float greatestFear = 0;  // of the most dangerous one
};

// r of Tu & Terzopoulos 1994: hunger or libido above this is heeded.
inline constexpr float kDesire = 0.25F;

// A threshold that was passed holds until the value falls below this share of it, so that no fish
// dithers about it.
inline constexpr float kHysteresis = 0.8F;

// 1 - n_e R / alpha, within 0 to 1: R is the share of the last meal that is not digested.
[[nodiscard]] float innerHunger(const SpeciesParameters& parameters, const Mind& mind);

// More than twice the appetite in the stomach: nothing makes it hungry.
[[nodiscard]] bool isGorged(const SpeciesParameters& parameters, const Mind& mind);

// p1 dt (1 - H), within 0 to 1; always 0 for those who never mate.
[[nodiscard]] float innerLibido(const SpeciesParameters& parameters,
                                const Mind& mind,
                                float hunger);

// Only pacifists mate (Tu & Terzopoulos 1994).
[[nodiscard]] bool mates(const SpeciesParameters& parameters);

// Lets one thought's time pass: all clocks of the mind go on, a digested meal is forgotten.
void passTime(const SpeciesParameters& parameters, Mind& mind);

// So hungry and in such a mood, both 0 to 1, as a scene may want it to begin.
void setMood(const SpeciesParameters& parameters, float hunger, float libido, Mind& mind);

}  // namespace aquarama::fish
