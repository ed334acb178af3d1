// SPDX-License-Identifier: Apache-2.0
// The memory of each fish from one thought to the next, its drives, and the events by which it
// changes other fish or the food.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "master/fish/fish_view.h"

namespace aquarama::fish {

// The behaviour routines, which a mind chooses from: those of Tu & Terzopoulos 1994, and Hover,
// Graze, Clean, Visit (to a cleaner), Charge, Rest and Hide of fish that live at the reef. Those
// from Escape on always interrupt (see interrupts()). Wander also stands for an empty memory.
enum class Intention : std::uint8_t {
    Wander,
    Hover,
    Graze,
    Clean,
    Visit,
    Leave,
    School,
    Eat,
    Mate,
    Charge,
    Rest,
    Hide,
    Escape,
    AvoidFish,
    AvoidObstacle
};
inline constexpr std::size_t kIntentions = 15;
// Its name for people, such as "avoid fish".
[[nodiscard]] const char* nameOf(Intention intention);

// Upper limit of the clocks of a mind. They are in ticks, advance at every thought and stop here.
inline constexpr std::uint32_t kLongAgo = 0x7fffffffU;

// Whether a fish heeds its fear. It is kept from one thought to the next, because fear ends at a
// lower value than it begins at (kHysteresis).
enum class Alarm : std::uint8_t {
    Calm,
    // Afraid, but shelters in its school.
    Together,
    // More afraid: flees by itself.
    Alone,
};

// The memory of one fish. Only the thought of that fish writes it, except for the world's events:
// meals, catches, spawning and the arrival of a new fish.
struct Mind {
    Intention intention = Intention::Wander;
    // Target of the intention: a fish (Mate, Charge, Clean, Visit, AvoidFish, Escape, Eat of a
    // predator), a particle of food (Eat of the others), a site (Hide, Rest) or a patch of turf
    // (Graze); kNobody where the routine has none.
    std::uint32_t target = kNobody;
    // Ticks for which it has had the present aim (aimOf()); interruptions count too.
    std::uint32_t pursued = 0;
    // The one-item memory: what was interrupted and will be resumed.
    Intention remembered = Intention::Wander;
    std::uint32_t rememberedTarget = kNobody;
    std::uint32_t sinceRemembered = kLongAgo;
    std::uint32_t sinceMeal = kLongAgo;
    std::uint32_t sinceSpawning = kLongAgo;
    // Predators: since the present chase began, or since the last one ended.
    std::uint32_t sinceChase = kLongAgo;
    // Of those that graze: since it came to its patch.
    std::uint32_t sinceArrival = kLongAgo;
    // Of those that hold a territory: since it last began or ended a charge.
    std::uint32_t sinceCharge = kLongAgo;
    // Since it was last with a cleaner; of a cleaner, since it last cleaned.
    std::uint32_t sinceCleaning = 0;
    Alarm alarm = Alarm::Calm;
    // Of those that graze: the spot of the patch, by its index.
    std::uint8_t spot = 0;
    // Particles or prey eaten since the last meal was digested; n_e of the thesis.
    std::uint16_t eaten = 0;
    // Bits of Like.
    std::uint8_t likes = 0;
    // Stage of a routine that has stages: CourtshipStage, HuntStage, HideStage, GrazeStage,
    // CleanStage, VisitStage, or that of eat().
    std::uint8_t stage = 0;
    // Bites of turf since they last counted as a particle.
    std::uint8_t bites = 0;
    // Of who leads a shoal: thoughts for which it remembers that one of its shoal was charged;
    // kChargedTwice where that has happened again meanwhile.
    std::uint8_t charged = 0;
    // Ticks in that stage.
    std::uint32_t sinceStage = 0;
    // Tick of the last thought.
    std::uint64_t thoughtAt = 0;
};

// Values of Mind::charged: after the first charge (10 s) and after the second.
inline constexpr std::uint8_t kChargedOnce = 75;
inline constexpr std::uint8_t kChargedTwice = 255;

// Habits of a single fish, drawn at its beginning (behaviour::likesOf()), as bits of Mind::likes. A
// fish never has two that contradict each other.
enum Like : std::uint8_t {
    kLikesBrightness = 1,
    kLikesDarkness = 2,
    kLikesWarmth = 4,
    kLikesCold = 8,
    kLikesSchooling = 16,
    kIsFemale = 32,
};

// Whether an intention interrupts another one: collision and fear do. The other intentions are
// aims, which the fish resumes afterwards.
[[nodiscard]] constexpr bool interrupts(Intention intention, Alarm alarm) {
    return intention >= Intention::Escape ||
           (intention == Intention::School && alarm == Alarm::Together);
}

// Whether an intention is resumed after an interruption. The others come back by themselves.
[[nodiscard]] constexpr bool isResumed(Intention intention) {
    return intention >= Intention::School || intention == Intention::Graze ||
           intention == Intention::Clean || intention == Intention::Visit;
}

// The aim of a fish: a routine and its target.
struct Aim {
    Intention intention = Intention::Wander;
    std::uint32_t target = kNobody;
    friend bool operator==(const Aim&, const Aim&) = default;
};
// The aim of a fish. While it is interrupted this is the remembered aim, if there is one.
[[nodiscard]] constexpr Aim aimOf(const Mind& mind) {
    if (interrupts(mind.intention, mind.alarm) && mind.remembered != Intention::Wander)
        return {mind.remembered, mind.rememberedTarget};
    return {mind.intention, mind.target};
}

// The minds of all fish, by index. Stored as an array of structures, because a thought needs the
// whole of one mind.
class Minds {
  public:
    // These work as in a vector with one mind for each fish.
    void resize(std::size_t fish) { minds_.resize(fish); }
    [[nodiscard]] std::size_t size() const { return minds_.size(); }
    [[nodiscard]] const Mind& operator[](std::size_t fish) const { return minds_[fish]; }
    [[nodiscard]] Mind& operator[](std::size_t fish) { return minds_[fish]; }
    // Equal for equal minds on every machine.
    [[nodiscard]] std::uint64_t hash() const;
    // Memory in use.
    [[nodiscard]] std::size_t bytes() const;

  private:
    std::vector<Mind> minds_;
};

// An action that changes more than the fish itself. A thought only reports it. The world applies
// all events of a tick afterwards, in the order of the fish: of two fish that want the same thing
// the first gets it.
enum class DeferredEventKind : std::uint8_t { EatParticle, EatFish, Spawn, Bite, PuffSand, Charge };
struct DeferredEvent {
    DeferredEventKind kind = DeferredEventKind::EatParticle;
    std::uint32_t fish = kNobody;
    // The particle, the prey, the mate, the patch of turf or who is charged; kNobody of a puff of
    // sand.
    std::uint32_t object = kNobody;
};

// Inner drives (Tu 1996, section 5.2): what the body asks for, before any stimulus in sight adds to
// it. Perception uses them to search only for what is wanted, and they decide whether a fish shows
// that it would mate.

// The feelings of one thought, each 0 to 1. Computed by behaviour::feel(), not kept.
struct Feelings {
    float hunger = 0, libido = 0;
    // The sum over all predators in sight.
    float fear = 0;
    // Fear of the most dangerous predator alone.
    float greatestFear = 0;
    // Of species that hide: how near the nearest danger is to where the fish would dive, which
    // is 1.
    float threat = 0;
};

// Threshold r of Tu & Terzopoulos 1994: a fish heeds hunger or libido above this value.
inline constexpr float kDesire = 0.25F;

// Hysteresis of all thresholds of feelings: once passed, a threshold is lowered to this share, so
// that a fish does not switch back and forth.
inline constexpr float kHysteresis = 0.8F;

// Inner hunger 1 - n_e R / alpha, clamped to 0 to 1 (Tu 1996, section 5.2). n_e is Mind::eaten,
// alpha the appetite, R the share of the last meal that is not digested yet.
[[nodiscard]] float innerHunger(const SpeciesParameters& parameters, const Mind& mind);

// Whether the fish ate more than twice its appetite: then no food tempts it.
[[nodiscard]] bool isGorged(const SpeciesParameters& parameters, const Mind& mind);

// Inner libido p1 dt (1 - H), at most 1: dt is the time since it spawned, in seconds, H the given
// hunger, half of it for predators. Always 0 for species that do not mate.
[[nodiscard]] float innerLibido(const SpeciesParameters& parameters,
                                const Mind& mind,
                                float hunger);

// Whether the species mates.
[[nodiscard]] bool mates(const SpeciesParameters& parameters);

// Whether it does so at this time of day: one that spawns in a rush at sunset and dusk only.
[[nodiscard]] bool matesAt(const SpeciesParameters& parameters, double timeOfDay);

// Advances all clocks of the mind by the ticks since its last thought; forgets a meal that is
// digested. Called once per thought, before perception.
void passTime(const SpeciesParameters& parameters, std::uint32_t ticks, Mind& mind);

// Sets stomach and clocks so that inner hunger and libido have the given values, both 0 to 1. A
// scene may begin a fish so. A libido above 1 - hunger cannot be reached.
void setMood(const SpeciesParameters& parameters, float hunger, float libido, Mind& mind);

// The signs of a mood, derived from the mind.

// Writes the signs of a fish, except kAway, which is kept; its stage and the fish that it courts,
// except for prey that does not mate now. `mates` is matesAt() now. Touches only this fish's
// elements.
void showMood(const SpeciesParameters& parameters,
              const Minds& minds,
              std::uint32_t fish,
              bool mates,
              FishView& view);

}  // namespace aquarama::fish
