// SPDX-License-Identifier: Apache-2.0
// What each fish remembers from one thought to the next, and what it did that others must learn of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "master/fish/fish_view.h"

namespace aquarama::fish {

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

// Fear that is heeded, kept from one thought to the next so that it ends later than it began.
enum class Alarm : std::uint8_t {
    Calm,
    Together,  // afraid, in the shelter of the school
    Alone,     // more afraid: it flees by itself
};

struct Mind {
    Intention intention = Intention::Wander;
    // What it is about: a fish (Mate, Eat of a predator, School, AvoidFish), or a particle of food
    // (Eat of the others).
    std::uint32_t target = kNobody;
    std::uint32_t pursued = 0;  // its aim, for so long; interruptions count in
    // The one-item memory: what was interrupted and will be resumed.
    Intention remembered = Intention::Wander;
    std::uint32_t rememberedTarget = kNobody;
    std::uint32_t sinceRemembered = kLongAgo;
    std::uint32_t sinceMeal = kLongAgo;
    std::uint32_t sinceSpawning = kLongAgo;
    // Of a predator: since its chase began, or since the last one ended, whichever was later.
    std::uint32_t sinceChase = kLongAgo;
    Alarm alarm = Alarm::Calm;
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

// Collision and fear interrupt what a fish is about; the other intentions are aims of its own.
[[nodiscard]] constexpr bool interrupts(Intention intention, Alarm alarm) {
    return intention >= Intention::Escape ||
           (intention == Intention::School && alarm == Alarm::Together);
}

struct Aim {
    Intention intention = Intention::Wander;
    std::uint32_t target = kNobody;
    friend bool operator==(const Aim&, const Aim&) = default;
};
// What a fish is about, seen through an interruption.
[[nodiscard]] constexpr Aim aimOf(const Mind& mind) {
    if (interrupts(mind.intention, mind.alarm) && mind.remembered != Intention::Wander)
        return {mind.remembered, mind.rememberedTarget};
    return {mind.intention, mind.target};
}

// Of all fish: each mind by itself, as a thought needs the whole of it.
class Minds {
  public:
    void resize(std::size_t fish) { minds_.resize(fish); }
    [[nodiscard]] std::size_t size() const { return minds_.size(); }
    [[nodiscard]] const Mind& operator[](std::size_t fish) const { return minds_[fish]; }
    [[nodiscard]] Mind& operator[](std::size_t fish) { return minds_[fish]; }
    [[nodiscard]] std::uint64_t hash() const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    std::vector<Mind> minds_;
};

// What a fish did at this tick to something that others see too. Events are applied after all have
// thought, in the order of the fish; of two that want the same the first has it.
enum class DeferredEventKind : std::uint8_t { EatParticle, EatFish, Spawn };
struct DeferredEvent {
    DeferredEventKind kind = DeferredEventKind::EatParticle;
    std::uint32_t fish = kNobody;
    std::uint32_t object = kNobody;  // particle, prey or mate
};

// What a fish's body asks for by itself, before anything in sight adds to it (Tu 1996, section
// 5.2): perception searches only for what is wanted, and a fish shows whether it would mate.

// What a fish feels at one thought, each 0 to 1: feel() of master/behaviour/mental_state.h.
struct Feelings {
    float hunger = 0, libido = 0;
    float fear = 0;          // of all predators in sight together
    float greatestFear = 0;  // of the most dangerous one
};

// r of Tu & Terzopoulos 1994: hunger or libido above this is heeded.
inline constexpr float kDesire = 0.25F;

// A threshold that was passed holds until the value falls below this share of it, so that no fish
// dithers about it.
inline constexpr float kHysteresis = 0.8F;

// 1 - n_e R / alpha, within 0 to 1: R is the share of the last meal that is not digested.
[[nodiscard]] float innerHunger(const SpeciesParameters& parameters, const Mind& mind);

// More than twice the appetite in the stomach: nothing makes it hungry.
[[nodiscard]] bool isGorged(const SpeciesParameters& parameters, const Mind& mind);

// p1 dt (1 - H), within 0 to 1; always 0 for those who never mate.
[[nodiscard]] float innerLibido(const SpeciesParameters& parameters,
                                const Mind& mind,
                                float hunger);

// Only pacifists mate (Tu & Terzopoulos 1994).
[[nodiscard]] bool mates(const SpeciesParameters& parameters);

// Lets one thought's time pass: all clocks of the mind go on, a digested meal is forgotten.
void passTime(const SpeciesParameters& parameters, Mind& mind);

// So hungry and in such a mood, both 0 to 1, as a scene may want it to begin.
void setMood(const SpeciesParameters& parameters, float hunger, float libido, Mind& mind);

// From a fish's mind to what others see of its mood.

// Writes all signs of a fish but kAway, which is kept, and whom it courts.
void showMood(const SpeciesParameters& parameters,
              const Minds& minds,
              std::uint32_t fish,
              FishView& view);

}  // namespace aquarama::fish
