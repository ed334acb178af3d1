// SPDX-License-Identifier: Apache-2.0
// The world as the conductor knows it.
#pragma once

#include <string>
#include <vector>

#include "master/conductor/simulation.h"
#include "master/world/world.h"

namespace aquarama::simulation {

class LivingWorld : public conductor::Simulation {
  public:
    explicit LivingWorld(const world::WorldOptions& options);
    void advance() override { world_.advance(); }
    void apply(const world::WorldInput& input) override { world_.apply(input); }
    [[nodiscard]] Tick tick() const override { return world_.tick(); }
    [[nodiscard]] std::uint64_t hash() const override { return world_.hash(); }
    [[nodiscard]] conductor::Snapshot snapshot() const override;
    [[nodiscard]] std::vector<std::string> explain(std::uint32_t fish) const override;

    [[nodiscard]] const world::World& world() const { return world_; }

  private:
    world::World world_;
    std::vector<std::string> species_;  // their names, in the order of the cast
};

}  // namespace aquarama::simulation
