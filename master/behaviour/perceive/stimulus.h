// SPDX-License-Identifier: Apache-2.0
// What the nearness of food or of a mate adds to a drive (Tu 1996, section 5.2). Perception uses it
// too: what is too far off to change a mind is not searched for.
#pragma once

namespace aquarama::behaviour {

// The stimulus is s = 1 / d: nothing at `far` and beyond, all of it at `near`, steeper when nearer.
// Distances of the closest one, in body lengths of the fish that senses it.
struct StimulusRange {
    float farBodyLengths, nearBodyLengths;
};
inline constexpr StimulusRange kFoodStimulus{8, 2};
inline constexpr StimulusRange kMateStimulus{16, 4};
inline constexpr float kHungerStimulus = 0.8F;  // a_h
inline constexpr float kLibidoStimulus = 0.5F;  // a_l

// S, 0 to 1: (s - q1) / (2 q2 - q1 - s) between q1 and q2. An infinite distance gives 0.
[[nodiscard]] constexpr float stimulusOf(const StimulusRange& range, float bodyLengths) {
    const float q1 = 1 / range.farBodyLengths;
    const float q2 = 1 / range.nearBodyLengths;
    const float s = 1 / bodyLengths;
    if (s < q1) return 0;
    if (s > q2) return 1;
    return (s - q1) / (2 * q2 - q1 - s);
}

// The distance at which the stimulus is S, above 0; 0 for one that no distance gives.
[[nodiscard]] constexpr float bodyLengthsOf(const StimulusRange& range, float stimulus) {
    if (stimulus > 1) return 0;
    const float q1 = 1 / range.farBodyLengths;
    const float q2 = 1 / range.nearBodyLengths;
    return (1 + stimulus) / (q1 + stimulus * (2 * q2 - q1));
}

}  // namespace aquarama::behaviour
