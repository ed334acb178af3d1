// SPDX-License-Identifier: Apache-2.0
// A flock by the rules of OpenSteer's Boids demonstration (Reynolds 1999) on the neighbour search
// of the product: the yardstick for what a thought about neighbours costs. Left out is what does
// not search: banking, the smoothing of accelerations, curvature.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "master/behaviour/perceive/spatial_grid.h"

namespace aquarama::bench {

inline constexpr float kSeparationReach = 5.0F, kSeparationCosine = -0.707F, kSeparation = 12.0F;
inline constexpr float kAlignmentReach = 7.5F, kAlignmentCosine = 0.7F, kAlignment = 8.0F;
inline constexpr float kCohesionReach = 9.0F, kCohesionCosine = -0.15F, kCohesion = 8.0F;
inline constexpr float kFlockReach = kCohesionReach;  // the farthest
inline constexpr float kAlwaysNear = 1.5F;            // three radii: whatever the angle
inline constexpr float kMostForce = 27.0F, kMostSpeed = 9.0F;
inline constexpr float kFlockSeconds = 1.0F / 60;

struct Flock {  // structure of arrays; OpenSteer's units
    enum Column : std::size_t { X, Y, Z, HeadingX, HeadingY, HeadingZ, Speed, kColumns };
    std::array<std::vector<float>, kColumns> columns;

    explicit Flock(std::size_t boids) {
        for (auto& column : columns) column.resize(boids + behaviour::kMostLanes);
    }
    [[nodiscard]] const float* operator[](Column column) const { return columns[column].data(); }
    [[nodiscard]] float* operator[](Column column) { return columns[column].data(); }
    [[nodiscard]] std::size_t size() const { return columns[X].size() - behaviour::kMostLanes; }
    [[nodiscard]] behaviour::Points points() const {
        return {(*this)[X], (*this)[Y], (*this)[Z], size()};
    }
};

// Of so many boids with so many neighbours each, on average, within kFlockReach.
[[nodiscard]] float flockRadius(std::size_t boids, double neighbours);
// Strewn evenly through a ball, headings at random.
[[nodiscard]] Flock makeFlock(std::size_t boids, float radius);

class FlockStep {
  public:
    FlockStep(std::size_t boids, float radius);

    // One step of every boid: sorts them, then each thinks and moves. Boids change places in
    // memory: those of a cell come to stand together.
    void run(Flock& flock);
    // Only the sorting.
    void sort(Flock& flock);
    [[nodiscard]] double neighboursOf(const Flock& flock);  // on average, within kFlockReach
    // Who stood where the boid at this place stands now, before the last step.
    [[nodiscard]] std::uint32_t formerPlaceOf(std::size_t place) const {
        return grid_.index()[place];
    }

  private:
    float radius_;
    behaviour::SpatialGrid grid_;
    Flock sorted_;
};

// The same of one boid by plain code, by asking every other.
[[nodiscard]] std::array<float, Flock::kColumns> flockReference(const Flock& flock,
                                                                std::size_t boid,
                                                                float radius);

// All that a step's vectors need to know.
struct FlockThoughts {
    const behaviour::SpatialGrid* grid;
    const Flock* sorted;
    Flock* next;
    float radius;
};

}  // namespace aquarama::bench
