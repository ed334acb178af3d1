// SPDX-License-Identifier: Apache-2.0
// The living world: a school and those who keep to themselves perceive, decide and move, one tick
// at a time. Same options, same world, on any number of threads.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/motion/motion_state.h"
#include "common/motion/motor.h"
#include "common/units/ids.h"
#include "master/behaviour/neighbour_grid.h"
#include "master/behaviour/school_view.h"
#include "master/behaviour/steering.h"
#include "master/behaviour/surroundings.h"
#include "master/motor/gaits.h"
#include "master/motor/secondary_controller.h"
#include "master/world/worker_pool.h"

namespace aquarama {

// How long the fish of a species are: a bell curve, cut off.
struct FishLengths {
    float meanMetres = 0.24F;
    float deviationMetres = 0.012F;
    float leastMetres = 0.20F;
    float mostMetres = 0.28F;
};

// The fish of one species.
struct WorldSpecies {
    std::shared_ptr<const MotorTables> tables;
    std::uint32_t fish = 0;
    FishLengths lengths;
};

struct WorldOptions {
    std::uint32_t seed = 1;
    unsigned threads = 1;
    std::vector<WorldSpecies> cast;  // the first are the school, the others keep to themselves
};

class World {
  public:
    // Throws Error when there are no fish.
    explicit World(const WorldOptions& options);

    void advance();  // one tick; allocates nothing

    [[nodiscard]] Tick tick() const { return tick_; }
    [[nodiscard]] const MotionStates& states() const { return states_; }
    [[nodiscard]] const SchoolView& view() const { return view_; }  // as the last tick began
    [[nodiscard]] std::span<const FishTraits> traits() const { return traits_; }
    [[nodiscard]] std::size_t bytes() const;  // of all that grows with the school

    // States, commands and all that decisions remember; equal worlds have equal hashes.
    [[nodiscard]] std::uint64_t hash() const;
    void records(std::vector<FishRecord>& records) const;

  private:
    // Fish [first, last) are of one species; of the first kind is the school.
    struct Kind {
        std::shared_ptr<const MotorTables> tables;
        Gaits gaits;
        std::size_t first = 0, last = 0;
    };
    struct Chunk {  // a part of a kind, small enough to share out among threads
        std::size_t kind = 0;
        std::size_t first = 0, last = 0;
    };
    void addKind(const WorldSpecies& species);
    void begin();
    void look(const Kind& kind, std::size_t first, std::size_t last);
    void think(std::size_t kind, std::size_t first, std::size_t last);
    void steer(std::size_t kind, std::size_t first, std::size_t last);
    template <class Job>
    void inChunks(const Job& job);

    std::uint32_t seed_;
    Tick tick_;
    std::vector<Kind> kinds_;
    std::vector<Chunk> chunks_;
    Surroundings surroundings_;
    std::vector<FishTraits> traits_;
    MotionStates states_;
    MotorCommands commands_;
    Intentions intentions_;
    ControllerMemory memory_;
    SchoolView view_;
    NeighbourGrid grid_;
    Goal goal_;
    float schoolRadius_ = 0;
    WorkerPool pool_;
};

}  // namespace aquarama
