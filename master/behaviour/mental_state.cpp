// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>

#include "common/base/random_streams.h"
#include "common/base/units.h"
#include "master/behaviour/perceive.h"
#include "master/behaviour/think.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

namespace {

// Share of the fear of a predator that is after nobody.
constexpr float kFearOfIdle = 0.5F;

// Always 0 for species that do not mate now, whatever is in sight.
float libidoOf(const fish::SpeciesParameters& parameters,
               const fish::Mind& mind,
               const Senses& senses,
               float hunger) {
    if (!fish::mates(parameters) || !senses.hour.mates) return 0;
    const float stimulus = stimulusOf(kMateStimulus, senses.mate.distance / senses.length);
    return std::min(1.0F, fish::innerLibido(parameters, mind, hunger) + kLibidoStimulus * stimulus);
}

// A stimulus raises the hunger of all but predators; those hunt by inner hunger alone.
float hungerOf(const fish::SpeciesParameters& parameters,
               const fish::Mind& mind,
               const Senses& senses) {
    if (fish::isGorged(parameters, mind)) return 0;
    const float inner = fish::innerHunger(parameters, mind);
    if (parameters.habits.role == config::Role::Predator) return inner;
    const float stimulus = stimulusOf(kFoodStimulus, senses.food.distance / senses.length);
    return std::min(1.0F, inner + kHungerStimulus * stimulus);
}

// Whether a predator may be after this fish: it rushes, or stalks and does not pass by.
bool isAfterIt(const Sighting& predator) {
    return predator.rushing || (predator.hunting && !predator.passesBy);
}

// Fear of one predator, F_i = min(D0 / d_i, 1) (Tu). A predator that is after nobody frightens
// less, and so does one that stalks another fish: fish watch it and go on feeding (threat
// sensitivity: Helfman 1989, Behav. Ecol. Sociobiol. 24:47).
float fearOf(const fish::SpeciesParameters& parameters, const Sighting& predator) {
    const float heeded = predator.heeded * (isAfterIt(predator) ? 1.0F : kFearOfIdle);
    return heeded * std::min(parameters.habits.fear.metres / predator.distance, 1.0F);
}

// The distance at which a fish dives from a danger, metres: it grows with the predator, with the
// way to the shelter and with the fish; less where the predator passes by (docs/minds.md).
constexpr float kDiveMetres = 0.25F;
constexpr float kPerPredatorLength = 0.25F;
constexpr float kPerWay = 0.5F;
constexpr float kPerLength = 2;
constexpr float kPassingBy = 0.6F;
constexpr float kRushed = 1.5F;

// 1 at the distance of diving and nearer, 0 at twice that distance.
float threatOf(const Senses& senses, const Sighting& predator) {
    float dives = kDiveMetres + kPerPredatorLength * predator.length +
                  kPerWay * senses.shelter.site.distance + kPerLength * senses.length;
    if (predator.rushing)
        dives *= kRushed;
    else if (predator.passesBy)
        dives *= kPassingBy;
    dives *= predator.heeded;
    return std::clamp((2 * dives - predator.distance) / dives, 0.0F, 1.0F);
}

// Of its schoolmates so many must dive for a fish to dive too.
constexpr std::size_t kDiversFollowed = 2;

// At the beginning a fish was with a cleaner up to so long ago.
constexpr float kCleaningSpreadSeconds = 300;

constexpr float kTicks = static_cast<float>(kTicksPerSecond);

// By the length where the species says so; else the females are spread evenly over the fish in
// their order, so that of a pair of neighbours one is a female at a share of a half.
bool isFemale(const fish::SpeciesParameters& parameters, std::uint32_t fish, float length) {
    const config::HabitShares& shares = parameters.habits.shares;
    if (shares.maleFromMetres) return length < *shares.maleFromMetres;
    if (shares.femaleFromMetres) return length >= *shares.femaleFromMetres;
    const auto before = [&](std::uint32_t count) {
        return static_cast<std::uint32_t>(static_cast<double>(count) * shares.female);
    };
    const std::uint32_t place = fish - parameters.first;
    return before(place + 1) > before(place);
}

// A number of 0 to 1 for one fish and stream.
float share(std::uint32_t seed, std::uint32_t fish, Stream draw) {
    return unitOf(hashOf(hashOf(hashOf(seed, draw), fish)));
}

}  // namespace

fish::Feelings feel(const fish::SpeciesParameters& parameters,
                    const fish::Mind& mind,
                    const Senses& senses) {
    fish::Feelings feelings;
    feelings.hunger = hungerOf(parameters, mind, senses);
    feelings.libido = libidoOf(parameters, mind, senses, feelings.hunger);
    for (std::size_t i = 0; i < senses.predatorCount; ++i) {
        const float fear = fearOf(parameters, senses.predators[i]);
        feelings.fear = std::min(1.0F, feelings.fear + fear);
        feelings.greatestFear = std::max(feelings.greatestFear, fear);
        if (senses.shelter.site.seen())
            feelings.threat = std::max(feelings.threat, threatOf(senses, senses.predators[i]));
    }
    if (senses.shelter.site.seen() && senses.shelter.diving >= kDiversFollowed) feelings.threat = 1;
    return feelings;
}

std::uint8_t likesOf(const fish::SpeciesParameters& parameters,
                     std::uint32_t seed,
                     std::uint32_t fish,
                     float length) {
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
    if (isFemale(parameters, fish, length)) likes |= fish::kIsFemale;
    for (const unsigned both : {unsigned{fish::kLikesBrightness} | unsigned{fish::kLikesDarkness},
                                unsigned{fish::kLikesWarmth} | unsigned{fish::kLikesCold}})
        if ((likes & both) == both) likes &= ~both;
    return static_cast<std::uint8_t>(likes);
}

fish::Mind freshMind(const fish::SpeciesParameters& parameters,
                     std::uint32_t seed,
                     std::uint32_t fish,
                     float length) {
    assert(parameters.habits.hunger.digestionPerSecond > 0);
    fish::Mind mind;
    mind.likes = likesOf(parameters, seed, fish, length);
    // A fish that finds food at all times eats until it is gorged, then digests; a predator eats
    // just its appetite.
    const bool grazes = parameters.habits.role != config::Role::Predator;
    mind.eaten =
        static_cast<std::uint16_t>(grazes ? 2 * parameters.habits.hunger.appetiteParticles + 1
                                          : parameters.habits.hunger.appetiteParticles);
    const float digested = kTicks / parameters.habits.hunger.digestionPerSecond;
    mind.sinceMeal = static_cast<std::uint32_t>(share(seed, fish, Stream::SinceMeal) * digested);
    if (parameters.habits.libidoPerSecond > 0)
        mind.sinceSpawning = static_cast<std::uint32_t>(share(seed, fish, Stream::SinceSpawning) *
                                                        kTicks / parameters.habits.libidoPerSecond);
    mind.sinceCleaning = static_cast<std::uint32_t>(share(seed, fish, Stream::SinceCleaning) *
                                                    kCleaningSpreadSeconds * kTicks);
    return mind;
}

}  // namespace aquarama::behaviour
