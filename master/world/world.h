// SPDX-License-Identifier: Apache-2.0
// How many live: who was eaten is away for a while, then another of its species comes from afar in
// its place, so that no species dies out. It bears the same index and length.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "common/config/scene.h"
#include "common/config/species.h"
#include "common/motion/motion_state.h"
#include "common/motion/motor.h"
#include "common/units/units.h"
#include "common/units/worker_pool.h"
#include "master/behaviour/perceive.h"
#include "master/behaviour/routines.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"
#include "master/surroundings/pilot.h"
#include "master/surroundings/surroundings.h"
#include "master/world/events.h"

namespace aquarama::world {

// What happened since tick 0.
struct WorldCounts {
    std::uint64_t meals = 0;    // particles of food that were eaten
    std::uint64_t catches = 0;  // fish that were
    std::uint64_t spawnings = 0;
    std::uint64_t returns = 0;  // others that came instead of those eaten
    friend bool operator==(const WorldCounts&, const WorldCounts&) = default;
};

struct Absence {
    std::uint32_t fish = 0;
    Tick until;
};

// With room for all fish that somebody hunts; in the order in which they were eaten.
[[nodiscard]] std::vector<Absence> makeAbsences(
    std::span<const fish::SpeciesParameters> speciesParameters);
// 20 to 60 seconds from now.
[[nodiscard]] Absence absenceFrom(std::uint32_t seed, std::uint32_t fish, Tick now);

// Where one comes into sight: of places in the water, clear of rocks and sand, one that is as far
// from the eye as the water reaches, or in the haze more than 12 m away.
[[nodiscard]] glm::vec3 arrivalPlace(const surroundings::Surroundings& surroundings,
                                     std::uint32_t fish,
                                     Tick tick);

// The living world: every fish perceives, feels, decides and moves, one tick at a time. Same
// options and inputs, same world, on any number of threads.

// The fish of one species.
struct WorldSpecies {
    std::shared_ptr<const motion::MotorTables> tables;
    std::uint32_t fish = 0;
    config::SizeRange size = {};
    std::string name = {};  // as Habits::hunts has it
    config::Habits habits = {};
    std::optional<config::Start> start = {};
};

struct WorldOptions {
    std::uint32_t seed = 1;
    unsigned threads = 1;
    config::Scene scene;             // all of it but the cast
    std::vector<WorldSpecies> cast;  // the school first; may be without fish
    fish::Adaptation adaptation;
};

class World {
  public:
    // Throws Error for a cast of more kinds than kMostSpecies.
    explicit World(const WorldOptions& options);

    void apply(const WorldInput& input);  // between two ticks
    void advance();                       // one tick; allocates nothing

    [[nodiscard]] Tick tick() const { return tick_; }
    [[nodiscard]] const motion::MotionStates& states() const { return states_; }
    [[nodiscard]] const motion::MotorCommands& commands() const { return commands_; }
    [[nodiscard]] const fish::Minds& minds() const { return minds_; }
    [[nodiscard]] const fish::Courses& courses() const { return courses_; }
    [[nodiscard]] const surroundings::Surroundings& surroundings() const { return surroundings_; }
    [[nodiscard]] const surroundings::Pilot& pilot() const { return pilot_; }
    [[nodiscard]] std::span<const fish::SpeciesParameters> speciesParameters() const {
        return speciesParameters_;
    }
    [[nodiscard]] const fish::FishView& view() const { return view_; }  // as the last tick began
    // As the fish saw it that thought in the last tick.
    [[nodiscard]] behaviour::Environment environment() const;
    [[nodiscard]] std::span<const motion::FishTraits> traits() const { return traits_; }
    [[nodiscard]] const WorldCounts& counts() const { return counts_; }
    [[nodiscard]] std::size_t bytes() const;  // of all that grows with the school

    // States, commands and all that minds remember; equal worlds have equal hashes.
    [[nodiscard]] std::uint64_t hash() const;
    void records(std::vector<motion::FishRecord>& records) const;

  private:
    // Fish [first, last) are of one species; of the first kind is the school.
    struct Kind {
        std::shared_ptr<const motion::MotorTables> tables;
        fish::Gaits gaits;
        std::size_t first = 0, last = 0;
    };
    struct Chunk {  // a part of a kind, small enough to share out among threads
        std::size_t kind = 0;
        std::size_t first = 0, last = 0;
    };
    struct Slice {  // a part of those in the grid, as they stand there
        behaviour::DeferredEvents events;
    };
    void addKind(const WorldSpecies& species, const std::vector<WorldSpecies>& cast);
    void begin(const WorldOptions& options);
    void beginTick();
    void look(const Kind& kind, std::size_t first, std::size_t last);
    void makeRoomForEvents();
    void thinkAll();
    void swim(const Chunk& chunk);
    void performEvents();
    void perform(const fish::DeferredEvent& event);
    void feed(std::uint32_t fish);
    void receive();
    void arrive(std::uint32_t fish);
    [[nodiscard]] surroundings::Goal goal() const;
    void moveSubmarine();
    void showSubmarine();

    std::uint32_t seed_;
    Tick tick_;
    config::Gathering gathering_;
    glm::vec3 middle_;  // of the scene's own water, before it grew
    fish::Adaptation adaptation_;
    std::vector<Kind> kinds_;
    std::vector<fish::SpeciesParameters> speciesParameters_;  // one for each kind
    std::vector<Chunk> chunks_;
    std::vector<Slice> slices_;
    behaviour::DeferredEvents events_;  // of all slices
    std::vector<motion::FishTraits> traits_;
    surroundings::Surroundings surroundings_;
    surroundings::Voyage voyage_;
    surroundings::Pilot pilot_;
    motion::MotionStates states_;
    motion::MotorCommands commands_;
    fish::Minds minds_;
    fish::Courses courses_;
    fish::ControllerMemory memory_;
    fish::FishView view_;
    Meals meals_;
    std::vector<Absence> absences_;
    WorldCounts counts_;
    behaviour::Grids grids_;
    surroundings::Goal goal_;
    float schoolRadius_ = 0;
    WorkerPool pool_;
};

}  // namespace aquarama::world
