// SPDX-License-Identifier: Apache-2.0
// What recorder and playback have in common: another simulation stands behind them and is seen
// through them; they differ in how it advances and in what reaches it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "master/conductor/simulation.h"

namespace aquarama::simulation {

class SimulationDecorator : public conductor::Simulation {
  public:
    [[nodiscard]] Tick tick() const override { return world_.tick(); }
    [[nodiscard]] std::uint64_t hash() const override { return world_.hash(); }
    [[nodiscard]] conductor::Snapshot snapshot() const override { return world_.snapshot(); }
    [[nodiscard]] std::vector<std::string> explain(std::uint32_t fish) const override {
        return world_.explain(fish);
    }

  protected:
    explicit SimulationDecorator(conductor::Simulation& world) : world_(world) {}
    conductor::Simulation& world_;
};

}  // namespace aquarama::simulation
