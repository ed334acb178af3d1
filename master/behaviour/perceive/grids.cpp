// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive/grids.h"

#include "master/behaviour/perceive/neighbours.h"

namespace aquarama {

namespace {

constexpr float kSparseCellMetres = 2.0F;

}  // namespace

Grids::Grids(const Region& water, std::size_t fishCount, std::size_t foodCount)
    : fish(water, kCellMetres, fishCount),
      predators(water, kSparseCellMetres, fishCount),
      large(water, kSparseCellMetres, fishCount),
      mates(water, kSparseCellMetres, fishCount),
      food(water, kCellMetres, foodCount) {
    chosen_.reserve(std::max(fishCount, foodCount));
}

void Grids::rebuild(const FishView& view, const Food& particles, std::span<const Nature> natures) {
    const Points fishPoints{view.x, view.y, view.z};
    const auto choose = [&](std::size_t count, const auto& isOne) {
        chosen_.clear();
        for (std::uint32_t i = 0; i < count; ++i)
            if (isOne(i)) chosen_.push_back(i);
        return std::span<const std::uint32_t>(chosen_);
    };
    const auto there = [&](std::uint32_t i) { return !view.shows(i, kAway); };
    fish.rebuild(fishPoints, choose(view.size(), there));
    predators.rebuild(fishPoints, choose(view.size(), [&](std::uint32_t i) {
                          return there(i) && natures[view.kind[i]].role == Role::Predator;
                      }));
    large.rebuild(fishPoints, choose(view.size(), [&](std::uint32_t i) {
                      return there(i) && view.length[i] >= kLargeBodyMetres;
                  }));
    mates.rebuild(fishPoints, choose(view.size(), [&](std::uint32_t i) {
                      return there(i) && view.shows(i, kWilling);
                  }));
    food.rebuild({particles.x, particles.y, particles.z},
                 choose(particles.size(), [&](std::uint32_t i) { return particles.isFree(i); }));
}

std::size_t Grids::bytes() const {
    return fish.bytes() + predators.bytes() + large.bytes() + mates.bytes() + food.bytes() +
           chosen_.capacity() * sizeof(chosen_[0]);
}

}  // namespace aquarama
