// SPDX-License-Identifier: Apache-2.0
#include "master/fish/drives.h"

#include <algorithm>
#include <cmath>

#include "common/units/ids.h"
#include "master/fish/courses.h"

namespace aquarama::fish {

namespace {

constexpr float kTicksASecond = static_cast<float>(kTicksPerSecond);

float seconds(std::uint32_t ticks) {
    return static_cast<float>(ticks) / kTicksASecond;
}

std::uint32_t ticksOf(float seconds) {
    return static_cast<std::uint32_t>(
        std::min(seconds * kTicksASecond, static_cast<float>(kLongAgo) / 2));
}

// R of the thesis: 1 after a meal, 0 when it is digested.
float undigested(const SpeciesParameters& parameters, const Mind& mind) {
    return std::max(0.0F, 1 - parameters.habits.digestionPerSecond * seconds(mind.sinceMeal));
}

}  // namespace

float innerHunger(const SpeciesParameters& parameters, const Mind& mind) {
    const float stomach = static_cast<float>(mind.eaten) * undigested(parameters, mind);
    return std::clamp(1 - stomach / parameters.habits.appetiteParticles, 0.0F, 1.0F);
}

bool isGorged(const SpeciesParameters& parameters, const Mind& mind) {
    return static_cast<float>(mind.eaten) > 2 * parameters.habits.appetiteParticles;
}

float innerLibido(const SpeciesParameters& parameters, const Mind& mind, float hunger) {
    if (!mates(parameters)) return 0;
    return std::min(1.0F, parameters.habits.libidoPerSecond * seconds(mind.sinceSpawning)) *
           (1 - hunger);
}

bool mates(const SpeciesParameters& parameters) {
    return parameters.habits.role == config::Role::Pacifist &&
           parameters.habits.libidoPerSecond > 0;
}

void passTime(const SpeciesParameters& parameters, Mind& mind) {
    for (std::uint32_t* ticks : {&mind.pursued,
                                 &mind.sinceRemembered,
                                 &mind.sinceMeal,
                                 &mind.sinceSpawning,
                                 &mind.sinceChase,
                                 &mind.sinceStage})
        if (*ticks < kLongAgo) *ticks += kTicksBetweenThoughts;
    if (undigested(parameters, mind) <= 0) mind.eaten = 0;
}

void setMood(const SpeciesParameters& parameters, float hunger, float libido, Mind& mind) {
    const float meal = std::max(1.0F, std::ceil(parameters.habits.appetiteParticles));
    const float left =
        std::clamp((1 - hunger) * parameters.habits.appetiteParticles / meal, 0.0F, 1.0F);
    mind.eaten = static_cast<std::uint16_t>(meal);
    mind.sinceMeal = ticksOf((1 - left) / parameters.habits.digestionPerSecond);
    const float growth = parameters.habits.libidoPerSecond * std::max(1 - hunger, 0.0F);
    mind.sinceSpawning = growth > 0 ? ticksOf(libido / growth) : 0;
}

}  // namespace aquarama::fish
