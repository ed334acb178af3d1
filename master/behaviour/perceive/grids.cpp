// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive/grids.h"

#include <algorithm>
#include <cstring>

#include "master/behaviour/perceive/neighbours.h"

namespace aquarama::behaviour {

namespace {

constexpr float kSparseCellMetres = 2.0F;
constexpr float kFoodCellMetres = 0.8F;

// In a wide sea cells grow, so that those without anybody neither cost time nor memory.
std::size_t mostCellsFor(std::size_t points) {
    constexpr std::size_t kFew = 4096;
    constexpr std::size_t kToPoint = 4;
    return std::max(kFew, points * kToPoint);
}

// Predators and large bodies are seen from so far that a search would pass many empty cells.
SpatialGrid farSeen(const place::Region& water, std::size_t points) {
    return {water, kSparseCellMetres, points, points / 2};
}

bool isPredator(const fish::FishView& view,
                std::span<const fish::SpeciesParameters> speciesParameters,
                std::size_t fish) {
    return speciesParameters[view.kind[fish]].habits.role == config::Role::Predator;
}

}  // namespace

Grids::Grids(const place::Region& water, std::size_t fishCount, std::size_t foodCount)
    : fish(water, kCellMetres, fishCount, mostCellsFor(fishCount)),
      kinds(fish),
      predators(farSeen(water, 0)),
      large(farSeen(water, 0)),
      mates(water, kSparseCellMetres, fishCount, mostCellsFor(fishCount)),
      food(water, kFoodCellMetres, foodCount, mostCellsFor(foodCount)),
      water_(water),
      marks_(fishCount) {
    fish.makeRoomForSteps();
    chosen_[kMates].reserve(fishCount);
    chosen_[kFood].reserve(foodCount);
}

void Grids::expect(SpatialGrid& grid, Sparse which, std::size_t count) {
    if (count <= chosen_[which].capacity()) return;
    chosen_[which].reserve(count);
    grid = farSeen(water_, chosen_[which].capacity());
}

void Grids::expect(const fish::FishView& view,
                   std::span<const fish::SpeciesParameters> speciesParameters) {
    std::size_t hunting = 0;
    std::size_t big = 0;
    for (std::size_t i = 0; i < view.size(); ++i) {
        hunting += isPredator(view, speciesParameters, i) ? 1 : 0;
        big += view.fish[i].length >= kLargeBodyMetres ? 1 : 0;
    }
    expect(predators, kPredators, hunting);
    expect(large, kLarges, big);
}

void Grids::mark(const fish::FishView& view,
                 std::span<const fish::SpeciesParameters> speciesParameters,
                 std::size_t first,
                 std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
        const std::uint8_t signs = view.signs[i];
        int marks = kPresent;
        if (isPredator(view, speciesParameters, i)) marks |= kPredator;
        if (view.fish[i].length >= kLargeBodyMetres) marks |= kLarge;
        if ((signs & fish::kWilling) != 0) marks |= kMate;
        marks_[i] = static_cast<std::uint8_t>((signs & fish::kAway) != 0 ? 0 : marks);
    }
}

// Few fish bear these marks, so eight are asked at a time.
std::span<const std::uint32_t> Grids::marked(Sparse which, Mark mark) {
    std::vector<std::uint32_t>& chosen = chosen_[which];
    chosen.clear();
    std::uint64_t eightMarks = 0;
    std::memset(&eightMarks, mark, sizeof(eightMarks));
    for (std::size_t first = 0; first < marks_.size(); first += sizeof(eightMarks)) {
        const std::size_t last = std::min(marks_.size(), first + sizeof(eightMarks));
        std::uint64_t eight = 0;
        std::memcpy(&eight, &marks_[first], last - first);
        if ((eight & eightMarks) == 0) continue;
        for (std::size_t i = first; i < last; ++i)
            if ((marks_[i] & mark) != 0) chosen.push_back(static_cast<std::uint32_t>(i));
    }
    return chosen;
}

void Grids::rebuildSparse(std::size_t which,
                          const Points& fishPoints,
                          const surroundings::Food& particles) {
    const auto of = [&](SpatialGrid& grid, Sparse sparse, Mark mark) {
        const std::size_t room = chosen_[sparse].capacity();
        const std::span<const std::uint32_t> chosen = marked(sparse, mark);
        if (chosen.size() > room) grid = farSeen(water_, chosen_[sparse].capacity());
        grid.rebuild(fishPoints, chosen);
    };
    if (which == kPredators) of(predators, kPredators, kPredator);
    if (which == kLarges) of(large, kLarges, kLarge);
    if (which == kMates) of(mates, kMates, kMate);
    if (which != kFood) return;
    std::vector<std::uint32_t>& there = chosen_[kFood];
    there.clear();
    for (std::uint32_t i = 0; i < particles.size(); ++i)
        if (particles.isFree(i)) there.push_back(i);
    food.rebuild({particles.x.data(), particles.y.data(), particles.z.data(), particles.size()},
                 there);
}

std::size_t Grids::bytes() const {
    std::size_t lists = marks_.size();
    for (const auto& chosen : chosen_) lists += chosen.capacity() * sizeof(std::uint32_t);
    return lists + fish.bytes() + kinds.bytes() + predators.bytes() + large.bytes() +
           mates.bytes() + food.bytes();
}

}  // namespace aquarama::behaviour
