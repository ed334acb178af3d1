// SPDX-License-Identifier: Apache-2.0
// The living world: every fish perceives, feels, decides and moves, one tick at a time. Same
// options and inputs, same world, on any number of threads.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/config/scene.h"
#include "common/config/species.h"
#include "common/motion/motion_state.h"
#include "common/motion/motor.h"
#include "common/units/ids.h"
#include "common/units/worker_pool.h"
#include "master/behaviour/act/routines.h"
#include "master/behaviour/perceive/environment.h"
#include "master/fish/adaptation.h"
#include "master/fish/courses.h"
#include "master/fish/fish_view.h"
#include "master/fish/gaits.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"
#include "master/pilot/pilot.h"
#include "master/world/input.h"
#include "master/world/meals.h"
#include "master/world/population.h"

namespace aquarama::world {

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
    [[nodiscard]] const pilot::Pilot& pilot() const { return pilot_; }
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
    pilot::Voyage voyage_;
    pilot::Pilot pilot_;
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
