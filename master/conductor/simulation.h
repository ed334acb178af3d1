// SPDX-License-Identifier: Apache-2.0
// All that the conductor knows of the world.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/units.h"
#include "common/motion/motion_state.h"
#include "common/net/clock.h"
#include "common/school/school_state.h"
#include "common/wire/state_codec.h"
#include "master/fish/minds.h"
#include "master/world/events.h"

namespace aquarama::conductor {

// The world at one tick, as it is sent: one record a fish, in the order of the school.
struct Snapshot {
    Tick tick;
    net::Moment due{};  // live: when the world was like this; set by the tick thread
    std::uint64_t hash = 0;
    wire::Eye eye;
    float timeOfDay = 0.5F;  // share of the day, 0 to 1: 0 and 1 are midnight
    std::vector<motion::FishRecord> fish;
    wire::FoodCloud food;
    // By which the motor moved the fish in this tick, and those that were put elsewhere, by index,
    // in any order. No commands: all were.
    motion::MotorCommands commands = {};
    std::vector<std::uint32_t> placed = {};
};

// The nearest thing of a kind that a fish sees.
struct NearestSeen {
    // What it is to the fish.
    enum class Kind : std::uint8_t { Predator, Food, Mate, Prey };
    Kind kind = Kind::Predator;
    std::string name;           // "#12 tang", "particle 7"
    float distanceLengths = 0;  // in body lengths of the fish that sees it
    float degreesRight = 0;     // from its heading about the vertical, -180 to 180
};

// What goes on in the mind of a fish, within the bounds of v1::Explanation. All texts are printable
// ASCII.
struct Explanation {
    std::vector<std::string> lines = {};  // none: there is no such fish
    // The values in the lines. A fish that is away has no intention, and the others are empty.
    std::optional<fish::Intention> intention = {};
    std::string target = {};   // of the intention: "#12 tang", "particle 7"; empty: none
    float pursuedSeconds = 0;  // how long it has had the intention
    fish::Feelings feelings = {};
    std::vector<NearestSeen> seen = {};
};

// The fish of a species that wait for visitors' drawings, or wear one: [first, last).
struct DrawingSlots {
    std::string species;  // name
    std::uint32_t first = 0, last = 0;
    // Numbers of the drawings that they wear, by fish; 0: none, or it leaves.
    std::vector<std::uint32_t> worn = {};
};

// A species whose fish patrol, and come before the wall by a cue.
struct Hunter {
    std::string species;   // name
    std::uint32_t at = 0;  // its place in the cast
};

// What a standby is sent of the journal.
struct JournalPiece {
    wire::Packet entries;  // of a recording, whole; empty: nothing has happened
    Tick tick;             // of the world, after them
    bool begins = false;   // with the recording's beginning and a save
};

// Called from the tick thread only.
class Simulation {
  public:
    virtual ~Simulation() = default;
    virtual void advance() = 0;  // by one tick
    // Applies an input between two ticks: the only way in which the world is changed from outside.
    virtual void apply(const world::WorldInput& input) = 0;
    [[nodiscard]] virtual Tick tick() const = 0;
    // Hash of all that the next tick depends on.
    [[nodiscard]] virtual std::uint64_t hash() const = 0;
    [[nodiscard]] virtual Snapshot snapshot() const = 0;
    [[nodiscard]] virtual Explanation explain(std::uint32_t fish) const = 0;
    // Whether its day follows the hall's clock, which world::SetClock brings to it.
    [[nodiscard]] virtual bool followsHall() const { return false; }
    // Of each species that has any. They never change.
    [[nodiscard]] virtual std::vector<DrawingSlots> drawingSlots() const { return {}; }
    // Those that world::ReleaseHunter calls. They never change.
    [[nodiscard]] virtual std::vector<Hunter> hunters() const { return {}; }
    // Of all fish, by species, or of none: what their commands are coded by. They never change.
    [[nodiscard]] virtual std::vector<school::RecordedRates> recordedRates() const { return {}; }
    // A standby begins to simulate along: followed() has all from now on, the whole world first.
    virtual void beginFollowed() {}
    // What the standby is to have since the last call, from any thread; nothing where it has not
    // begun, or its beginning is not ready yet.
    [[nodiscard]] virtual std::optional<JournalPiece> followed() { return std::nullopt; }
};

}  // namespace aquarama::conductor
