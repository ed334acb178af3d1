// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/feel/temperament.h"

#include "common/place/noise.h"
#include "common/units/ids.h"

namespace aquarama {

namespace {

// Streams of one seed: what a number is drawn for.
enum Draw : std::uint32_t {
    Brightness = 501,
    Darkness,
    Warmth,
    Cold,
    Schooling,
    Female,
    Meal,
    Spawning
};

float share(std::uint32_t seed, std::uint32_t fish, Draw draw) {
    return unitOf(hashOf(hashOf(hashOf(seed, draw), fish)));
}

}  // namespace

std::uint8_t likesOf(const Nature& nature, std::uint32_t seed, std::uint32_t fish) {
    const HabitShares& shares = nature.habits.shares;
    unsigned likes = 0;
    const auto draw = [&](Draw what, double of, unsigned like) {
        if (share(seed, fish, what) < static_cast<float>(of)) likes |= like;
    };
    draw(Brightness, shares.brightness, kLikesBrightness);
    draw(Darkness, shares.darkness, kLikesDarkness);
    draw(Warmth, shares.warmth, kLikesWarmth);
    draw(Cold, shares.cold, kLikesCold);
    draw(Schooling, shares.schooling, kLikesSchooling);
    draw(Female, shares.female, kIsFemale);
    for (const unsigned both : {kLikesBrightness | kLikesDarkness, kLikesWarmth | kLikesCold})
        if ((likes & both) == both) likes &= ~both;
    return static_cast<std::uint8_t>(likes);
}

Mind freshMind(const Nature& nature, std::uint32_t seed, std::uint32_t fish) {
    Mind mind;
    mind.likes = likesOf(nature, seed, fish);
    mind.eaten = static_cast<std::uint16_t>(nature.appetite);
    const float digested = 1 / nature.digestion * static_cast<float>(kTicksPerSecond);
    mind.sinceMeal = static_cast<std::uint32_t>(share(seed, fish, Meal) * 0.5F * digested);
    mind.sinceSpawning = static_cast<std::uint32_t>(share(seed, fish, Spawning) * 60 * 120);
    return mind;
}

}  // namespace aquarama
