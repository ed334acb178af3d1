// SPDX-License-Identifier: Apache-2.0
// Who and what is where: all fish in a fine grid; predators, large bodies, willing mates and food
// in sparse grids of their own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/place/place.h"
#include "master/behaviour/perceive/kinds_about.h"
#include "master/behaviour/perceive/spatial_grid.h"
#include "master/fish/fish_view.h"
#include "master/fish/species_parameters.h"
#include "master/surroundings/food.h"

namespace aquarama::behaviour {

inline constexpr float kLargeBodyMetres = 0.6F;  // from this length a fish is a large body

class Grids {
  public:
    Grids(const place::Region& water, std::size_t fish, std::size_t food);

    // Makes the grids of predators and of large bodies as large as they need be for these fish,
    // of whom some may be away. rebuild() does so too where they are too small.
    void expect(const fish::FishView& view,
                std::span<const fish::SpeciesParameters> speciesParameters);

    // Of those that are there. Allocates nothing once expect() was told of these fish.
    void rebuild(const fish::FishView& view,
                 const surroundings::Food& particles,
                 std::span<const fish::SpeciesParameters> speciesParameters) {
        rebuild(
            view,
            particles,
            speciesParameters,
            [](std::size_t jobs, const auto& job) {
                for (std::size_t i = 0; i < jobs; ++i) job(i);
            },
            [](std::size_t, std::size_t) {});
    }
    // The same by share(jobs, job), which calls job(i) once for each of [0, jobs) in any order and
    // on any thread. Before fish [first, last) are looked at, it calls look(first, last).
    template <class Share, class Look>
    void rebuild(const fish::FishView& view,
                 const surroundings::Food& particles,
                 std::span<const fish::SpeciesParameters> speciesParameters,
                 const Share& share,
                 const Look& look) {
        const Points points = placesOf(view);
        share(fish.parts(), [&](std::size_t part) {
            const std::size_t first = SpatialGrid::firstOfPart(part);
            const std::size_t last = std::min(view.size(), SpatialGrid::firstOfPart(part + 1));
            look(first, last);
            mark(view, speciesParameters, first, last);
            fish.count(part, points, [&](std::size_t i) { return (marks_[i] & kPresent) != 0; });
        });
        fish.arrange();
        kinds.clear();
        share(fish.parts(), [&](std::size_t part) { fish.spread(part, points); });
        share(kSparseGrids + fish.buckets(), [&](std::size_t job) {
            if (job < kSparseGrids) return rebuildSparse(job, points, particles);
            const std::size_t bucket = job - kSparseGrids;
            fish.sort(bucket);
            kinds.note(fish, bucket, view.kind);
        });
    }

    [[nodiscard]] std::size_t bytes() const;

    SpatialGrid fish;
    KindsAbout kinds;  // of the cells of `fish`
    SpatialGrid predators;
    SpatialGrid large;
    SpatialGrid mates;
    SpatialGrid food;

  private:
    enum Mark : std::uint8_t { kPresent = 1, kPredator = 2, kLarge = 4, kMate = 8 };
    enum Sparse : std::size_t { kMates, kFood, kPredators, kLarges, kSparseGrids };

    void mark(const fish::FishView& view,
              std::span<const fish::SpeciesParameters> speciesParameters,
              std::size_t first,
              std::size_t last);
    [[nodiscard]] static Points placesOf(const fish::FishView& view) {
        constexpr std::size_t kStride = sizeof(fish::VisibleFish) / sizeof(float);
        if (view.size() == 0) return {};
        const glm::vec3& first = view.fish.front().position;
        return {&first.x, &first.y, &first.z, view.size(), kStride};
    }
    void rebuildSparse(std::size_t which,
                       const Points& fishPoints,
                       const surroundings::Food& particles);
    [[nodiscard]] std::span<const std::uint32_t> marked(Sparse which, Mark mark);
    void expect(SpatialGrid& grid, Sparse which, std::size_t count);

    place::Region water_;
    std::vector<std::uint8_t> marks_;  // of each fish
    std::vector<std::uint32_t> chosen_[kSparseGrids];
};

}  // namespace aquarama::behaviour
