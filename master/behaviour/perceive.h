// SPDX-License-Identifier: Apache-2.0
// All that a fish may look at while it thinks. Nothing in it changes meanwhile, so that fish may
// think in any order and on any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <glm/vec3.hpp>

#include "common/units/units.h"
#include "master/behaviour/grids.h"
#include "master/behaviour/neighbours.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"
#include "master/surroundings/surroundings.h"

namespace aquarama::behaviour {

struct Environment {
    const fish::FishView* view = nullptr;
    const Grids* grids = nullptr;
    const surroundings::Surroundings* surroundings = nullptr;
    std::span<const fish::SpeciesParameters> speciesParameters;  // by FishView::kind
    config::Gathering gathering = config::Gathering::None;
    surroundings::Goal goal;  // of the school, where the scene has it gather
    float schoolRadiusMetres = 0;
    std::uint32_t seed = 0;
    Tick tick;
    fish::Adaptation adaptation;
};

// What the nearness of food or of a mate adds to a drive (Tu 1996, section 5.2). Perception uses it
// too: what is too far off to change a mind is not searched for.

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

// What one fish perceives at one thought (Tu 1996, chapter 4; docs/minds.md). World axes, metres.

struct Sighting {
    std::uint32_t object = fish::kNobody;  // fish, or particle of food
    glm::vec3 offset{};                    // from the body's middle
    float distance = std::numeric_limits<float>::infinity();
    bool hunting = false;  // of a predator: it is after somebody
    [[nodiscard]] bool seen() const { return object != fish::kNobody; }
};

inline constexpr std::size_t kMostPredators = 4;

struct Senses {
    // Of itself.
    glm::vec3 position{};
    glm::vec3 heading{1, 0, 0};
    float speed = 0;   // metres a second
    float length = 0;  // metres

    Neighbours schoolmates;    // nearest in view, of its own species
    Neighbours others;         // nearest in view, of any other: one gives way to them
    Sighting collision;        // the fish most of whose middle line is in the sensitivity box
    float collisionShare = 0;  // how much of it
    std::array<Sighting, kMostPredators> predators;  // nearest first, not hidden
    std::size_t predatorCount = 0;
    Sighting prey;  // the one of least cost (predators)
    Sighting mate;  // nearest of its species and the other sex that is willing
    Sighting food;  // nearest particle, seen or smelt
    float submarineMetres = std::numeric_limits<float>::infinity();
    // Where the surroundings and the submarine push; its length is 0 in the open and from 1 on only
    // turning away matters.
    glm::vec3 push{};
    float urgency = 0;
    float hurry = 0;  // of who is in the way of a submarine that comes on, 0 to 1
    float light = 1;  // 0 to 1, where it is
    float celsius = 26;
    // How far light or warmth are outside what its habits like, in the whole light or in ten
    // degrees; below 0 it is at ease by so much.
    float discomfort = -1;
    float betterUp = 0;  // where its habits are better met: 1 up, -1 down, 0 nowhere in its water
};

// The first stage of a thought: from the environment to what one fish perceives of it.

// `mind` says whom it is attending to, so that a target is kept unless another is better by its
// persistence.
[[nodiscard]] Senses perceive(const Environment& environment,
                              const fish::SpeciesParameters& parameters,
                              std::uint32_t fish,
                              const fish::Mind& mind);

// Whether light and warmth suit a fish's habits, and where they would (Tu 1996, section 5.1).

// Writes light, celsius, discomfort and betterUp of a fish that has these habits (bits of Like).
void feelClimate(const surroundings::Surroundings& around,
                 const fish::SpeciesParameters& parameters,
                 std::uint8_t likes,
                 Senses& senses);

// Whom a fish takes for a mate (Tu 1996, section 5.6.6): one of its species and the other sex that
// is willing and about as long; of those a male prefers the nearer, a female the larger.

// The shorter of a pair is at least this share of the longer.
inline constexpr float kLeastSizeRatio = 0.7F;
// Libido below this, as after spawning, no mate in sight can raise.
inline constexpr float kTemptedFrom = 0.1F;

// `likes` are those of the fish that looks.
[[nodiscard]] bool suitsAsMate(const fish::FishView& view,
                               std::uint8_t likes,
                               std::uint32_t fish,
                               std::uint32_t other);

// So many times its distance it counts as far, 1 or more: one that courts another as farther, and
// so does everybody to one whose courtship is answered; to a female a smaller one as farther.
[[nodiscard]] float dearnessOfMate(const fish::FishView& view,
                                   std::uint8_t likes,
                                   std::uint32_t fish,
                                   std::uint32_t other);

}  // namespace aquarama::behaviour
