// SPDX-License-Identifier: Apache-2.0
#include "master/study/feeding.h"

#include <limits>

#include "common/units/hash.h"

namespace aquarama::study {

namespace {

constexpr std::uint32_t kPellets = 12;
constexpr std::uint32_t kPinches = 701;  // stream of the seed

// In the upper half of the water, not at its borders.
glm::vec3 placeOf(const place::Region& water, std::uint32_t hash) {
    const glm::vec3 share{
        signedUnitOf(hash), unitOf(hashOf(hash, 1)), signedUnitOf(hashOf(hash, 2))};
    return water.centre + water.halfExtent * share * 0.6F;
}

}  // namespace

void Feeding::before(world::World& world) {
    if (between_ == 0 || world.tick().value % between_ != 0) return;
    if (waits_) ticks_ += between_;
    const place::Region& water = world.surroundings().obstacles.water;
    world.apply(
        world::DropFood{placeOf(water, hashOf(hashOf(seed_, kPinches), pinches_)), kPellets});
    ++pinches_;
    waits_ = true;
    thrownAt_ = world.tick().value;
    eatenBefore_ = eaten_;
}

void Feeding::after(const world::World& world, std::uint64_t particlesEaten) {
    eaten_ = particlesEaten;
    if (!waits_ || eaten_ - eatenBefore_ < kPellets / 2) return;
    ticks_ += world.tick().value - thrownAt_;
    waits_ = false;
}

double Feeding::meanSeconds() const {
    const std::uint32_t timed = pinches_ - (waits_ ? 1 : 0);
    if (timed == 0) return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(ticks_) / timed / static_cast<double>(kTicksPerSecond);
}

}  // namespace aquarama::study
