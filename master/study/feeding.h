// SPDX-License-Identifier: Apache-2.0
// A visitor who feeds at regular times, with a watch.
#pragma once

#include <cstdint>

#include "master/world/world.h"

namespace aquarama::study {

class Feeding {
  public:
    // Between pinches; 0: never feeds.
    Feeding(std::uint64_t ticksBetween, std::uint32_t seed) : between_(ticksBetween), seed_(seed) {}
    void before(world::World& world);  // each tick
    void after(const world::World& world, std::uint64_t particlesEaten);
    // Until half of a pinch was eaten; a pinch of which less was eaten counts with all its time.
    // NaN where none was thrown.
    [[nodiscard]] double meanSeconds() const;

  private:
    std::uint64_t between_;
    std::uint32_t seed_;
    std::uint32_t pinches_ = 0;
    std::uint64_t eaten_ = 0, eatenBefore_ = 0, thrownAt_ = 0;
    bool waits_ = false;  // for the half
    std::uint64_t ticks_ = 0;
};

}  // namespace aquarama::study
