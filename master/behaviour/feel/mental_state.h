// SPDX-License-Identifier: Apache-2.0
// Hunger, libido and fear (Tu & Terzopoulos 1994, section 6.1; Tu 1996, section 5.2), each 0 to 1.
#pragma once

#include "master/behaviour/perceive/senses.h"
#include "master/fish/minds.h"
#include "master/fish/nature.h"

namespace aquarama {

struct Feelings {
    float hunger = 0, libido = 0;
    float fear = 0;          // of all predators in sight together
    float greatestFear = 0;  // of the most dangerous one
};

// What in sight adds to a drive: nothing from `far` on, all of it at `near`, steeper when nearer
// (Tu 1996; distances of the closest food or mate, in body lengths of the fish).
struct StimulusRange {
    float farBodyLengths, nearBodyLengths;
};
inline constexpr StimulusRange kFoodStimulus{8, 2};
inline constexpr StimulusRange kMateStimulus{16, 4};
inline constexpr float kHungerStimulus = 0.8F;  // a_h
inline constexpr float kLibidoStimulus = 0.5F;  // a_l

// 0 to 1; an infinite distance gives 0.
[[nodiscard]] float stimulusOf(const StimulusRange& range, float bodyLengths);

// Hunger H = 1 - n_e R / alpha + a_h S_h, libido L = s (1 - H) + a_l S_l, fear F = sum of
// min(D0 / d, 1) over the predators in sight.
[[nodiscard]] Feelings feel(const Nature& nature, const Mind& mind, const Senses& senses);

}  // namespace aquarama
