// SPDX-License-Identifier: Apache-2.0
// What recorder and playback have in common: another simulation stands behind them and is seen
// through them; they differ in how it advances and in what reaches it.
#pragma once

#include <cstdint>
#include <vector>

#include "master/conductor/simulation.h"

namespace aquarama::simulation {

class SimulationDecorator : public conductor::Simulation {
  public:
    [[nodiscard]] Tick tick() const override { return world_.tick(); }
    void records(std::vector<motion::FishRecord>& fish) const override { world_.records(fish); }
    void food(wire::FoodCloud& cloud) const override { world_.food(cloud); }
    [[nodiscard]] wire::Eye eye() const override { return world_.eye(); }
    [[nodiscard]] float daylight() const override { return world_.daylight(); }
    [[nodiscard]] std::uint64_t hash() const override { return world_.hash(); }
    [[nodiscard]] wire::Explanation explain(std::uint32_t fish) const override {
        return world_.explain(fish);
    }

  protected:
    explicit SimulationDecorator(conductor::Simulation& world) : world_(world) {}
    conductor::Simulation& world_;
};

}  // namespace aquarama::simulation
