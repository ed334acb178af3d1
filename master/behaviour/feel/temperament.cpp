// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/feel/temperament.h"

#include "common/place/noise.h"
#include "common/units/ids.h"

namespace aquarama::behaviour {

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

constexpr float kTicks = static_cast<float>(kTicksPerSecond);

float share(std::uint32_t seed, std::uint32_t fish, Draw draw) {
    return place::unitOf(place::hashOf(place::hashOf(place::hashOf(seed, draw), fish)));
}

}  // namespace

std::uint8_t likesOf(const fish::Nature& nature, std::uint32_t seed, std::uint32_t fish) {
    const config::HabitShares& shares = nature.habits.shares;
    unsigned likes = 0;
    const auto draw = [&](Draw what, double of, unsigned like) {
        if (share(seed, fish, what) < static_cast<float>(of)) likes |= like;
    };
    draw(Brightness, shares.brightness, fish::kLikesBrightness);
    draw(Darkness, shares.darkness, fish::kLikesDarkness);
    draw(Warmth, shares.warmth, fish::kLikesWarmth);
    draw(Cold, shares.cold, fish::kLikesCold);
    draw(Schooling, shares.schooling, fish::kLikesSchooling);
    draw(Female, shares.female, fish::kIsFemale);
    for (const unsigned both : {unsigned{fish::kLikesBrightness} | unsigned{fish::kLikesDarkness},
                                unsigned{fish::kLikesWarmth} | unsigned{fish::kLikesCold}})
        if ((likes & both) == both) likes &= ~both;
    return static_cast<std::uint8_t>(likes);
}

fish::Mind freshMind(const fish::Nature& nature, std::uint32_t seed, std::uint32_t fish) {
    fish::Mind mind;
    mind.likes = likesOf(nature, seed, fish);
    // Who finds enough eats until it is gorged, then digests; who hunts is seldom so lucky.
    const bool grazes = nature.role != config::Role::Predator;
    mind.eaten = static_cast<std::uint16_t>(grazes ? 2 * nature.appetite + 1 : nature.appetite);
    const float digested = kTicks / nature.digestion;
    mind.sinceMeal = static_cast<std::uint32_t>(share(seed, fish, Meal) * digested);
    if (nature.libido > 0)
        mind.sinceSpawning =
            static_cast<std::uint32_t>(share(seed, fish, Spawning) * kTicks / nature.libido);
    return mind;
}

}  // namespace aquarama::behaviour
