// SPDX-License-Identifier: Apache-2.0
// The behaviour routines (Tu 1996, section 5.6), one step of each. A routine returns a course, may
// change the stage in `mind`, and reports events that change other things than the fish. Its input
// is constant meanwhile: fish may act in any order and on any thread. Speeds of courses are in body
// lengths a second.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "master/behaviour/perceive.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"
#include "master/surroundings/avoidance.h"

namespace aquarama::behaviour {

// Input of every routine; refers to objects of think().
struct Situation {
    const Environment& environment;
    const fish::SpeciesParameters& parameters;
    std::uint32_t fish;
    const Senses& senses;
    const fish::Feelings& feelings;
};

// Events of the thoughts of one job, in the order of thinking.
using DeferredEvents = std::vector<fish::DeferredEvent>;

// The last stage of a thought: one step of the routine of mind.intention.
[[nodiscard]] fish::Course act(const Situation& situation,
                               fish::Mind& mind,
                               DeferredEvents& events);

// Slows, or turns away from the fish in its sensitivity box, depending on where that one is and
// where it heads (section 5.6.1).
[[nodiscard]] fish::Course avoidFish(const Situation& situation, const fish::Mind& mind);

// Turns away from sand, rock, plant, surface or submarine. A schooling fish goes on schooling
// meanwhile; others attend to their way alone.
[[nodiscard]] fish::Course avoidObstacle(const Situation& situation, const fish::Mind& mind);
// The push of the surroundings as a way round the obstacle: a push straight back, which would only
// stop the fish, turns it to the side on which it gets past sooner.
[[nodiscard]] glm::vec3 wayRound(const Situation& situation);

// Pursues the particle of its intention and snaps at it: what is in a small cone before the mouth
// is drawn in with the water (section 5.6.3). The fish must sense food.
[[nodiscard]] fish::Course eat(const Situation& situation,
                               fish::Mind& mind,
                               DeferredEvents& events);
// A fast start needs so much room, in body lengths.
inline constexpr float kStartLengths = 2.5F;
// Whether the way is free for so many body lengths, straight ahead and in a direction, at this
// berth: so far a fish coasts after a fast start.
[[nodiscard]] bool hasRoom(const Situation& situation,
                           glm::vec3 direction,
                           float lengths,
                           const surroundings::Berth& berth);
// Whether suction reaches an object. `offset` is from the origin of the body frame, metres.
[[nodiscard]] bool isBeforeTheMouth(const Senses& senses, glm::vec3 offset);

// Flees from who charges it, and from all predators in sight, from nearer ones more, at full speed,
// and keeps clear of fish that flee beside it (section 5.6.4). A schooling fish leaves its school
// only as the predator comes near, so that a hollow opens about the attacker and closes behind it.
[[nodiscard]] fish::Course escape(const Situation& situation, const fish::Mind& mind);

// Values of Mind::stage while a predator hunts.
enum class HuntStage : std::uint8_t { Stalk, Rush };
// Whether a predator rushes at its prey.
[[nodiscard]] bool isRushing(const fish::Mind& mind);
// Hunting (section 5.6.5): a predator approaches its prey slowly, rushes at it from near, and snaps
// when it is at the mouth. Prey that turns more sharply escapes. The fish must see prey.
[[nodiscard]] fish::Course hunt(const Situation& situation,
                                fish::Mind& mind,
                                DeferredEvents& events);

// Values of Mind::stage while a fish hides: on its way and there, from a predator that passes and
// from one that rushes.
enum class HideStage : std::uint8_t { Dive, Hidden, DiveFromRush, HiddenFromRush };
[[nodiscard]] constexpr bool isFromRush(HideStage stage) {
    return stage == HideStage::DiveFromRush || stage == HideStage::HiddenFromRush;
}
[[nodiscard]] constexpr bool isThere(HideStage stage) {
    return stage == HideStage::Hidden || stage == HideStage::HiddenFromRush;
}
// Dives into its shelter, with a fast start where it is startled, and stays there with its head
// out.
[[nodiscard]] fish::Course hide(const Situation& situation, fish::Mind& mind);

// The place of a fish in the shelter that it senses, relative to the fish.
[[nodiscard]] glm::vec3 placeInShelter(const Situation& situation);
// The course through the water to a place, relative to the fish, and against the current there.
[[nodiscard]] fish::Course keepStation(const Situation& situation, glm::vec3 wish);

// Rests: goes slowly to its shelter and stays there; without one it stands low at its home.
[[nodiscard]] fish::Course rest(const Situation& situation);

// Keeps its place in the cloud over its home: the larger the fish the higher, lower in a strong
// current and where it is threatened, up-current of the home. Now and then it darts at what drifts
// by.
[[nodiscard]] fish::Course hover(const Situation& situation);

// Values of Mind::stage while a fish grazes: on its way to the patch; going down to a spot of it;
// swimming on, where the spot is too near to turn to; biting; done with the patch; and letting go
// of sand.
enum class GrazeStage : std::uint8_t { Travel, Settle, RunUp, Bite, Done, Puff };
[[nodiscard]] constexpr bool isAtPatch(GrazeStage stage) {
    return stage == GrazeStage::Settle || stage == GrazeStage::RunUp || stage == GrazeStage::Bite;
}
// Goes to its patch close over the ground, in file where it follows its shoal; bites at one spot
// after another, nose down; and lets go of sand on its way. Who leads a shoal or goes its own round
// is done with a patch after a while, or where little is left on it. The fish must have a patch.
[[nodiscard]] fish::Course graze(const Situation& situation,
                                 fish::Mind& mind,
                                 DeferredEvents& events);

// Charges the intruder of its territory, with a fast start where there is room for one. The fish
// must see an intruder.
[[nodiscard]] fish::Course charge(const Situation& situation,
                                  const fish::Mind& mind,
                                  DeferredEvents& events);
// Values of Mind::stage of a cleaner. A bite is one of skin: the client feels it.
enum class CleanStage : std::uint8_t { Inspect, Bite, Flee };
// Goes along the flank of its client and picks. One inspection in six ends in a bite, and the
// cleaner flees. Without a client it wanders about its home and now and then dances, as a sign.
[[nodiscard]] fish::Course clean(const Situation& situation, fish::Mind& mind);

// Values of Mind::stage of a client.
enum class VisitStage : std::uint8_t { Come, Wait, Pose, Chase };
// Comes to the station of a cleaner, waits while another poses, and poses there: hovers, tilted.
// One that was bitten chases the cleaner for a second. The fish must sense a cleaner.
[[nodiscard]] fish::Course visit(const Situation& situation, fish::Mind& mind);

// Leaves for water whose light and temperature suit its habits. Both change with height alone, so
// it climbs or dives.
[[nodiscard]] fish::Course leave(const Situation& situation);
// The nearest height (y, negative) within the water at which light and temperature suit the
// species, or are least bad.
[[nodiscard]] float suitableHeight(const Situation& situation);

// Mating (section 5.6.6): a fish follows one that courts nobody, displays to one that courts
// another, and goes through a courtship with one that courts it. Each stage has its time; then the
// fish gives up. The target of the mind must be a fish.
[[nodiscard]] fish::Course mate(const Situation& situation,
                                fish::Mind& mind,
                                DeferredEvents& events);

// Swims with the school: separation, alignment and cohesion with the nearest fish seen, and the
// common way of the school. No fish is controlled from outside.
[[nodiscard]] fish::Course school(const Situation& situation);
// Radius of a school of so many fish at ease, about its goal.
[[nodiscard]] float schoolRadiusMetres(std::size_t fish);
// The level that a fish keeps in a bait ball: -1 at its bottom, 1 at its top, more often near the
// middle. Without levels all would mill in one flat ring.
[[nodiscard]] float levelInBall(std::uint32_t seed, std::uint32_t fish);

// The routine of a fish at ease, by its Habits: its paces, home and partner, and random turns.
[[nodiscard]] fish::Course wander(const Situation& situation);
// The pace of a fish at ease, drawn by the shares of Habits::paces; a new one every five seconds.
[[nodiscard]] float paceOf(const fish::SpeciesParameters& parameters,
                           std::uint32_t seed,
                           std::uint32_t fish,
                           Tick tick);

}  // namespace aquarama::behaviour
