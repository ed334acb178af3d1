// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "common/place/angle.h"
#include "common/units/random_streams.h"
#include "master/behaviour/act/companion.h"
#include "master/behaviour/act/company.h"
#include "master/behaviour/act/home.h"
#include "master/behaviour/act/pursue.h"
#include "master/behaviour/act/routines.h"

namespace aquarama::behaviour {

namespace {

constexpr std::uint64_t kTicksOfPace = 5 * 60;
constexpr std::uint64_t kTicksOfTurn = 60;
constexpr float kTurns = 0.35F;      // the share of paces that begin with a turn for no reason
constexpr float kHoverPace = 0.15F;  // of slow

constexpr float kKeepCourse = 1.0F;  // weights against the unit vector of one's own course
constexpr float kGo = 0.7F;
constexpr float kGoHome = 2.0F;  // more, at the leash
constexpr float kTurn = 1.5F;

// What a fish drew for the pace that it is in.
struct Spell {
    std::uint32_t hash;
    std::uint64_t ticks;  // since it began
};
Spell spellOf(std::uint32_t seed, std::uint32_t fish, Tick tick) {
    const std::uint32_t own = hashOf(hashOf(seed, Stream::Pace), fish);
    const std::uint64_t now = tick.value + own % kTicksOfPace;
    return {hashOf(own, static_cast<std::uint32_t>(now / kTicksOfPace)), now % kTicksOfPace};
}

// A turn for no reason: 40 degrees if gradual, 100 if sharp, to either side.
glm::vec3 turnOf(const fish::SpeciesParameters& parameters, const Spell& spell, glm::vec3 course) {
    const std::uint32_t hash = hashOf(spell.hash, Stream::WanderTurn);
    if (spell.ticks >= kTicksOfTurn || unitOf(hash) >= kTurns) return {};
    const bool gradual = unitOf(hashOf(spell.hash, Stream::TurnSharpness)) <
                         static_cast<float>(parameters.habits.gradualShare);
    const float cosine = gradual ? 0.766F : -0.174F;
    const float sine = (gradual ? 0.643F : 0.985F) * ((hash & 1U) != 0 ? 1.0F : -1.0F);
    return {course.x * cosine - course.z * sine, 0, course.x * sine + course.z * cosine};
}

}  // namespace

float paceOf(const fish::SpeciesParameters& parameters,
             std::uint32_t seed,
             std::uint32_t fish,
             Tick tick) {
    const config::Paces& paces = parameters.habits.paces;
    const float drawn = unitOf(hashOf(spellOf(seed, fish, tick).hash));
    const auto hover = static_cast<float>(paces.hover);
    const float slow = hover + static_cast<float>(paces.slow);
    const float medium = slow + static_cast<float>(paces.medium);
    if (drawn < hover) return kHoverPace * parameters.slow;
    if (drawn < slow) return parameters.slow;
    return drawn < medium ? parameters.medium : parameters.fast;
}

fish::Course wander(const Situation& situation) {
    const Environment& environment = situation.environment;
    const fish::SpeciesParameters& parameters = situation.parameters;
    const Senses& senses = situation.senses;
    if (const auto course = keptCompany(situation)) return *course;
    const Bound bound = boundFor(environment, parameters, situation.fish, senses.position);
    const Spell spell = spellOf(environment.seed, situation.fish, environment.tick);
    const float calm = std::max(0.0F, 1 - senses.urgency);
    const glm::vec3 desired =
        senses.heading * kKeepCourse +
        place::directionOf(bound.towards, senses.heading) *
            ((kGo + kGoHome * bound.strayed) * calm) +
        turnOf(parameters, spell, senses.heading) * (kTurn * calm * (1 - bound.strayed)) +
        roomFrom(situation);
    const float pace = paceOf(parameters, environment.seed, situation.fish, environment.tick);
    // Far from home nobody hovers.
    return heading(situation, desired, std::max(pace, parameters.slow * bound.strayed));
}

}  // namespace aquarama::behaviour
