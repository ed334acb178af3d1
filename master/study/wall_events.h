// SPDX-License-Identifier: Apache-2.0
// What happens on the wall that a visitor notices: events by kind, and whether they are in view.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/world/world.h"

namespace aquarama::study {

// The kinds of events. A new one has a line here, and a line and a function in wall_events.cpp.
enum class WallEvent : std::uint8_t {
    Flight,       // fish begin to flee
    FastStart,    // a fish makes a fast start and does not flee
    Chase,        // a predator begins to hunt
    Courtship,    // a fish begins to court
    FeedingRush,  // several begin to go for food
    Split,        // a school parts
    Meeting,      // parts of a school meet
    Dive,         // several begin to dive into shelter
    Cleaning,     // a cleaner begins to inspect a client
    GrazeStop,    // a shoal, or a fish on its round, begins to graze at a patch
    Charge,       // the owner of a territory begins to charge
    Shadowing,    // a fish begins to ride beside another
    Flip,         // a cloud has turned to face the other way
};
inline constexpr std::size_t kWallEvents = 13;
// The words for a kind in tables.
[[nodiscard]] const char* nameOf(WallEvent kind);

// A fish that begins something belongs to the event of its kind in which another near by does the
// same, or did so long ago.
inline constexpr double kOneEventSeconds = 3;
// Near by, metres. Flights spread: of a school 2 m wide all flee from one predator.
inline constexpr float kNearMetres = 2;
inline constexpr float kNearInFlightMetres = 4;
// So many fish that begin to go for food within a second, near by, make a feeding rush.
inline constexpr std::size_t kFishOfARush = 5;
// So many that begin to dive within kOneEventSeconds, near by, make a dive.
inline constexpr std::size_t kFishOfADive = 3;
// Who leads fewer fish than a shoal has makes no stop that is noticed.
inline constexpr std::uint32_t kFishOfAShoal = 3;

// An event and the tick at which it was first noticed.
struct NotedEvent {
    WallEvent kind = WallEvent::Flight;
    Tick tick;
    // Whether any fish of it was in view.
    bool isInView = false;
};

// What a fish does at one moment, as far as events depend on it.
struct Deed {
    fish::Intention intention{};
    // Its aim, which interruptions do not end.
    fish::Intention aim{};
    bool isPredator = false;
    bool isStartled = false;
    // Flees from the owner of a territory, not from a hunter.
    bool isExpelled = false;
    // Is a cleaner beside its client.
    bool inspects = false;
    // Leads a shoal, or goes its own round, and is at its patch.
    bool stopsToGraze = false;
    // Rides beside another fish (ridesBesideAnother()).
    bool shadows = false;
};

// What a watch looks at: a world after a tick, or one that a test made up.
struct WatchedFish {
    const fish::FishView& view;
    const fish::Minds& minds;
    std::span<const fish::SpeciesParameters> species;
    Tick tick;
};
// Refers to the world.
[[nodiscard]] WatchedFish watchedFishOf(const world::World& world);

// Number of parts of fish [first, last) by their groups (groupsOf()): of groups that hold at least
// three fish and a tenth of those that are there.
[[nodiscard]] std::uint32_t partsOf(const fish::FishView& view,
                                    std::size_t first,
                                    std::size_t last,
                                    std::span<const std::uint32_t> groups);

// Watches all fish of one world. It only reads.
class EventWatch {
  public:
    // Whether a fish is in view now; asked only for fish that begin something.
    using Sees = std::function<bool(std::uint32_t fish)>;
    // Ticks between two calls of note(). What fish do lasts from one thought to the next at least.
    static constexpr std::uint64_t kTicksBetweenLooks = 4;

    explicit EventWatch(const WatchedFish& now);

    // Notes what fish began since the last call.
    void note(const WatchedFish& now, const Sees& sees);
    // Notes splits and meetings of schools, of species most of whose fish swim in one. Call it
    // every second, with the groups of groupsOf().
    void noteSchools(const WatchedFish& now,
                     std::span<const std::uint32_t> groups,
                     const Sees& sees);
    // Notes the clouds that have turned by more than 90 degrees since they last settled. Call it
    // every second.
    void noteClouds(const WatchedFish& now, const Sees& sees);
    // All events so far, in the order in which they were noticed.
    [[nodiscard]] std::span<const NotedEvent> all() const { return events_; }

  private:
    static constexpr std::size_t kNoEvent = SIZE_MAX;
    // A fish that does something of a kind, or did when it was last seen doing so, and the event
    // that this belongs to: an index, or kNoEvent.
    struct Actor {
        std::uint32_t fish = fish::kNobody;
        glm::vec3 place{};
        Tick began, seen;
        bool isInView = false;
        std::size_t event = kNoEvent;
    };
    // The number of parts of a school, and another that it may have had for a while.
    struct Parts {
        std::uint32_t settled = 0;
        std::uint32_t other = 0;
        std::uint32_t seconds = 0;
        // Counts a second; whether another number than the settled one has lasted.
        [[nodiscard]] bool settlesAt(std::uint32_t count);
    };
    // The fish about one home, the way in plan that they last settled to face (a unit vector, or
    // 0), and for how long they have faced another one.
    struct Cloud {
        std::uint32_t first = 0, last = 0;
        glm::vec3 facing{};
        std::uint32_t seconds = 0;
    };
    void follow(const WatchedFish& now, std::size_t kind, const std::vector<Deed>& deeds);
    void begin(std::size_t kind, Actor actor);
    [[nodiscard]] std::vector<Actor*> near(std::size_t kind, const Actor& actor);

    std::vector<NotedEvent> events_;
    Tick lastLook_;
    // By fish; by kind, oldest first.
    std::vector<Deed> before_;
    std::array<std::vector<Actor>, kWallEvents> actors_;
    // By species.
    std::vector<Parts> parts_;
    std::vector<Cloud> clouds_;
};

}  // namespace aquarama::study
