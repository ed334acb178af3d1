// SPDX-License-Identifier: Apache-2.0
// The living world: every fish perceives, feels, decides and moves, one tick at a time. Equal
// options and inputs give the same world on any number of threads.
// A fish that was eaten is absent for a while; then another of its species takes its index and
// length and comes in from afar, so that no species dies out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/base/worker_pool.h"
#include "common/config/scene.h"
#include "common/config/species.h"
#include "common/motion/motion_state.h"
#include "common/motion/motor.h"
#include "master/behaviour/perceive.h"
#include "master/behaviour/routines.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"
#include "master/surroundings/pilot.h"
#include "master/surroundings/surroundings.h"
#include "master/world/absences.h"
#include "master/world/events.h"
#include "master/world/fish_columns.h"
#include "master/world/world_state.h"

namespace aquarama::world {

// The first place of a new fish: in the water, clear of rocks and sand; of several drawn the one
// farthest from the eye, where all beyond 12 m count as hidden by haze.
[[nodiscard]] glm::vec3 arrivalPlace(const surroundings::Surroundings& surroundings,
                                     std::uint32_t fish,
                                     Tick tick);

// One species of a world and the number of its fish.
struct WorldSpecies {
    // Never null; shared, as several worlds may use one repertoire.
    std::shared_ptr<const motion::MotorTables> tables;
    std::uint32_t fish = 0;
    // So many of them, the last, wait out of sight for visitors' drawings.
    std::uint32_t drawings = 0;
    // Lengths of its fish, in metres.
    config::SizeRange size = {};
    // The name by which Habits::hunts and shadows refer to it.
    std::string name = {};
    config::Habits habits = {};
    // The place and mood in which its fish begin, if the scene sets them.
    std::optional<config::Start> start = {};
    // Wanted homes in plan (x, z), metres, if the scene sets them: one for each group.
    std::vector<glm::vec2> homes = {};
};

// All that a world is made of.
struct WorldOptions {
    std::uint32_t seed = 1;
    unsigned threads = 1;
    // All of the scene is used except its cast.
    config::Scene scene;
    // Whether fish with visitors' drawings may be eaten.
    bool drawingsMayBeEaten = false;
    // The first species is the school; it may have no fish.
    std::vector<WorldSpecies> cast;
    fish::Adaptation adaptation;
};

struct WaterAtTick;

// Where the school is or is drawn to: the middle of a bait ball, or that of its members.
class SchoolGoal {
  public:
    // For so many fish of a mean length, in metres, in the water of a world.
    SchoolGoal(const WorldOptions& options,
               const place::Region& water,
               std::size_t fish,
               float lengthMetres);

    // Sets the goal to that of a tick, by where the fish are.
    void moveTo(Tick tick, const motion::MotionStates& states);
    // The goal of the last moveTo(); before, that of tick 0 or the middle of the water.
    [[nodiscard]] const surroundings::Goal& goal() const { return goal_; }
    void goOnFrom(const surroundings::Goal& goal) { goal_ = goal; }
    // How the scene gathers the school.
    [[nodiscard]] config::Gathering gathering() const { return gathering_; }
    // Radius that the school fills around its goal.
    [[nodiscard]] float radiusMetres() const { return radiusMetres_; }

  private:
    config::Gathering gathering_;
    std::uint32_t seed_;
    std::size_t members_;  // of the school: the fish of the first species
    place::Region water_;
    float radiusMetres_;
    surroundings::Goal goal_;
};

// What the fish of a tick want done, performed once all have thought: of parts of the fish, in grid
// order, and of all together.
struct ThoughtEvents {
    std::vector<behaviour::DeferredEvents> slices;
    behaviour::DeferredEvents all;
};

// Owns everything that a tick changes. Called from one thread; its pool shares out the work of a
// tick. References that it returns stay valid; what they show changes with advance() and apply().
class World {
  public:
    // Throws Error for more than kMostSpecies species.
    explicit World(const WorldOptions& options);

    // Copies its state between two ticks, or goes on from one of a world with equal options.
    void save(WorldState& state) const;
    void restore(const WorldState& state);
    // Applies an input, between two ticks.
    void apply(const WorldInput& input);
    // One tick. Order: food and view, thoughts, motion, events. Allocates nothing in a steady
    // world.
    void advance();

    // The state after the last tick.
    [[nodiscard]] Tick tick() const { return tick_; }
    [[nodiscard]] const motion::MotionStates& states() const { return columns_.states; }
    [[nodiscard]] const motion::MotorCommands& commands() const { return columns_.commands; }
    [[nodiscard]] const fish::Minds& minds() const { return columns_.minds; }
    [[nodiscard]] const fish::Courses& courses() const { return columns_.courses; }
    [[nodiscard]] const surroundings::Surroundings& surroundings() const { return surroundings_; }
    [[nodiscard]] const surroundings::Pilot& pilot() const { return pilot_; }
    [[nodiscard]] std::span<const fish::SpeciesParameters> speciesParameters() const {
        return speciesParameters_;
    }
    // The view of all fish when the last tick began.
    [[nodiscard]] const fish::FishView& view() const { return columns_.view; }
    // The environment that fish saw in the last tick. Points into this world.
    [[nodiscard]] behaviour::Environment environment() const;
    [[nodiscard]] std::span<const motion::FishTraits> traits() const { return columns_.traits; }
    [[nodiscard]] const WorldCounts& counts() const { return counts_; }
    // Memory of all that grows with the number of fish.
    [[nodiscard]] std::size_t bytes() const;

    // Hash of all state that decides how the world goes on: equal worlds have equal hashes.
    [[nodiscard]] std::uint64_t hash() const;
    // Writes the published record of every fish, by index.
    void records(std::vector<motion::FishRecord>& records) const;
    // The fish that were put elsewhere than their motor took them, in the last tick or just before
    // it, by index; some more than once.
    [[nodiscard]] std::span<const std::uint32_t> placed() const;

  private:
    // A species: its fish are [first, last). The first kind is the school.
    struct Kind {
        std::shared_ptr<const motion::MotorTables> tables;
        fish::Gaits gaits;
        std::size_t first = 0, last = 0;
    };
    // Part of a kind, small enough to share out among threads.
    struct Chunk {
        std::size_t kind = 0;
        std::size_t first = 0, last = 0;
    };
    void addKind(const WorldSpecies& species, const std::vector<WorldSpecies>& cast);
    // Steps of construction and of a tick; each says at its definition what it does.
    void begin(const WorldOptions& options);
    void live(std::uint64_t ticks);
    void beginTick();
    void look(const Kind& kind, std::size_t first, std::size_t last, double timeOfDay);
    void makeRoomForEvents();
    void thinkAll();
    void findRushes();
    [[nodiscard]] bool thinks(std::uint32_t fish) const;
    void swim(const Chunk& chunk);
    void swallow();
    void performEvents();
    void perform(const fish::DeferredEvent& event);
    void bite(std::uint32_t fish, std::uint32_t patch);
    void receive();
    void arrive(std::uint32_t fish);
    [[nodiscard]] WaterAtTick waterNow() const;
    void moveSubmarine();
    void showSubmarine();

    std::uint32_t seed_;
    Tick tick_;
    std::uint64_t unseen_ = 0;  // ticks until the show begins
    fish::Adaptation adaptation_;
    std::vector<Kind> kinds_;
    std::vector<fish::SpeciesParameters> speciesParameters_;  // one for each kind
    std::vector<Chunk> chunks_;
    ThoughtEvents events_;
    FishColumns columns_;
    surroundings::Surroundings surroundings_;
    surroundings::Voyage voyage_;
    surroundings::Pilot pilot_;
    Meals meals_;
    std::vector<Absence> absences_;
    WorldCounts counts_;
    behaviour::Grids grids_;
    SchoolGoal school_;
    WorkerPool pool_;
};

// Goes on from the bytes of a state (encodeState()). Throws Error where they are none of such a
// world, and leaves it as it was; `source` names them in it.
void restore(World& world, std::span<const std::byte> bytes, const std::string& source);

}  // namespace aquarama::world
