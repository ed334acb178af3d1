// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/temperament.h"

#include "common/units/ids.h"
#include "common/units/random_streams.h"

namespace aquarama::behaviour {

namespace {

// Streams of one seed: what a number is drawn for.
constexpr float kTicks = static_cast<float>(kTicksPerSecond);

float share(std::uint32_t seed, std::uint32_t fish, Stream draw) {
    return unitOf(hashOf(hashOf(hashOf(seed, draw), fish)));
}

}  // namespace

std::uint8_t likesOf(const fish::SpeciesParameters& parameters,
                     std::uint32_t seed,
                     std::uint32_t fish) {
    const config::HabitShares& shares = parameters.habits.shares;
    unsigned likes = 0;
    const auto draw = [&](Stream what, double of, unsigned like) {
        if (share(seed, fish, what) < static_cast<float>(of)) likes |= like;
    };
    draw(Stream::LikesBrightness, shares.brightness, fish::kLikesBrightness);
    draw(Stream::LikesDarkness, shares.darkness, fish::kLikesDarkness);
    draw(Stream::LikesWarmth, shares.warmth, fish::kLikesWarmth);
    draw(Stream::LikesCold, shares.cold, fish::kLikesCold);
    draw(Stream::LikesSchooling, shares.schooling, fish::kLikesSchooling);
    draw(Stream::IsFemale, shares.female, fish::kIsFemale);
    for (const unsigned both : {unsigned{fish::kLikesBrightness} | unsigned{fish::kLikesDarkness},
                                unsigned{fish::kLikesWarmth} | unsigned{fish::kLikesCold}})
        if ((likes & both) == both) likes &= ~both;
    return static_cast<std::uint8_t>(likes);
}

fish::Mind freshMind(const fish::SpeciesParameters& parameters,
                     std::uint32_t seed,
                     std::uint32_t fish) {
    fish::Mind mind;
    mind.likes = likesOf(parameters, seed, fish);
    // Who finds enough eats until it is gorged, then digests; who hunts is seldom so lucky.
    const bool grazes = parameters.habits.role != config::Role::Predator;
    mind.eaten = static_cast<std::uint16_t>(grazes ? 2 * parameters.habits.appetiteParticles + 1
                                                   : parameters.habits.appetiteParticles);
    const float digested = kTicks / parameters.habits.digestionPerSecond;
    mind.sinceMeal = static_cast<std::uint32_t>(share(seed, fish, Stream::SinceMeal) * digested);
    if (parameters.habits.libidoPerSecond > 0)
        mind.sinceSpawning = static_cast<std::uint32_t>(share(seed, fish, Stream::SinceSpawning) *
                                                        kTicks / parameters.habits.libidoPerSecond);
    return mind;
}

}  // namespace aquarama::behaviour
