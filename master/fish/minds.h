// SPDX-License-Identifier: Apache-2.0
// What each fish remembers from one thought to the next, and what it did that others must learn of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "master/fish/fish_view.h"

namespace aquarama {

// The routines of Tu & Terzopoulos 1994. Wander also stands for an empty memory.
enum class Intention : std::uint8_t {
    Wander,
    Leave,
    School,
    Eat,
    Mate,
    Escape,
    AvoidFish,
    AvoidObstacle
};
inline constexpr std::size_t kIntentions = 8;

// Times are in ticks, counted up at every thought, and stop at kLongAgo.
inline constexpr std::uint32_t kLongAgo = 0x7fffffffU;

struct Mind {
    Intention intention = Intention::Wander;
    // What it is about: a fish (Mate, Eat of a predator, School, AvoidFish), or a particle of food
    // (Eat of the others).
    std::uint32_t target = kNobody;
    std::uint32_t pursued = 0;  // for so long
    // The one-item memory: what was interrupted and will be resumed.
    Intention remembered = Intention::Wander;
    std::uint32_t rememberedTarget = kNobody;
    std::uint32_t sinceRemembered = kLongAgo;
    std::uint32_t sinceMeal = kLongAgo;
    std::uint32_t sinceSpawning = kLongAgo;
    std::uint16_t eaten = 0;       // particles since the last one was digested
    std::uint8_t likes = 0;        // of Like
    std::uint8_t stage = 0;        // of the routine that has stages: courtship, hunt
    std::uint32_t sinceStage = 0;  // ticks in it
};

// Habits that a fish drew for itself, as bits of Mind::likes; it never draws two that contradict
// each other.
enum Like : std::uint8_t {
    kLikesBrightness = 1,
    kLikesDarkness = 2,
    kLikesWarmth = 4,
    kLikesCold = 8,
    kLikesSchooling = 16,
    kIsFemale = 32,
};

struct Minds {  // structure of arrays, as Mind
    std::vector<Intention> intention, remembered;
    std::vector<std::uint32_t> target, rememberedTarget;
    std::vector<std::uint32_t> pursued, sinceRemembered, sinceMeal, sinceSpawning, sinceStage;
    std::vector<std::uint16_t> eaten;
    std::vector<std::uint8_t> likes, stage;

    void resize(std::size_t fish);
    [[nodiscard]] std::size_t size() const { return intention.size(); }
    [[nodiscard]] Mind at(std::size_t fish) const;
    void set(std::size_t fish, const Mind& mind);
    [[nodiscard]] std::uint64_t hash() const;
    [[nodiscard]] std::size_t bytes() const;
};

// What a fish did at this tick to something that others see too. Deeds are done after all have
// thought, in the order of the fish; of two that want the same the first has it.
enum class DeedKind : std::uint8_t { EatParticle, EatFish, Spawn };
struct Deed {
    DeedKind kind = DeedKind::EatParticle;
    std::uint32_t fish = kNobody;
    std::uint32_t object = kNobody;  // particle, prey or mate
};

}  // namespace aquarama
