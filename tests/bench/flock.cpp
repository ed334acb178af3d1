// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/flock.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace aquarama::bench {

namespace {

glm::vec3 positionOf(const Flock& flock, std::size_t boid) {
    return {flock[Flock::X][boid], flock[Flock::Y][boid], flock[Flock::Z][boid]};
}

glm::vec3 headingOf(const Flock& flock, std::size_t boid) {
    return {
        flock[Flock::HeadingX][boid], flock[Flock::HeadingY][boid], flock[Flock::HeadingZ][boid]};
}

glm::vec3 unitOf(glm::vec3 v) {
    const float length = glm::length(v);
    return length > 1e-10F ? v / length : glm::vec3{0};
}

glm::vec3 truncated(glm::vec3 v, float most) {
    const float length = glm::length(v);
    return length > most ? v * (most / length) : v;
}

bool inNeighbourhood(glm::vec3 offset, glm::vec3 heading, float reach, float cosine) {
    const float distance = glm::length(offset);
    if (distance < kAlwaysNear) return true;
    return distance <= reach && glm::dot(heading, offset / distance) > cosine;
}

glm::vec3 steering(const Flock& flock, std::size_t boid) {
    const glm::vec3 position = positionOf(flock, boid);
    const glm::vec3 heading = headingOf(flock, boid);
    glm::vec3 separation{0};
    glm::vec3 alignment{0};
    glm::vec3 cohesion{0};
    for (std::size_t other = 0; other < flock.size(); ++other) {
        if (other == boid) continue;
        const glm::vec3 offset = positionOf(flock, other) - position;
        if (inNeighbourhood(offset, heading, kSeparationReach, kSeparationCosine))
            separation -= offset / glm::dot(offset, offset);
        if (inNeighbourhood(offset, heading, kAlignmentReach, kAlignmentCosine))
            alignment += headingOf(flock, other) - heading;
        if (inNeighbourhood(offset, heading, kCohesionReach, kCohesionCosine)) cohesion += offset;
    }
    return kSeparation * unitOf(separation) + kAlignment * unitOf(alignment) +
           kCohesion * unitOf(cohesion);
}

}  // namespace

float flockRadius(std::size_t boids, double neighbours) {
    return kFlockReach *
           static_cast<float>(std::cbrt(static_cast<double>(boids) / (neighbours + 1)));
}

Flock makeFlock(std::size_t boids, float radius) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> share(-1, 1);
    const auto inBall = [&] {
        for (;;) {
            const glm::vec3 point{share(random), share(random), share(random)};
            if (glm::length(point) <= 1) return point;
        }
    };
    Flock flock(boids);
    for (std::size_t i = 0; i < boids; ++i) {
        const glm::vec3 position = 0.99F * radius * inBall();
        const glm::vec3 heading = unitOf(inBall());
        for (int axis = 0; axis < 3; ++axis) {
            flock.columns[static_cast<std::size_t>(axis)][i] = position[axis];
            flock.columns[static_cast<std::size_t>(Flock::HeadingX + axis)][i] = heading[axis];
        }
        flock[Flock::Speed][i] = 0.3F * kMostSpeed;
    }
    return flock;
}

FlockStep::FlockStep(std::size_t boids, float radius)
    : radius_(radius),
      grid_({{0, 0, 0}, glm::vec3{radius}}, kFlockReach, boids, 4 * boids),
      sorted_(boids) {
    grid_.makeRoomForSteps();
}

void FlockStep::sort(Flock& flock) {
    const behaviour::Points points = flock.points();
    for (std::size_t part = 0; part < grid_.parts(); ++part)
        grid_.count(part, points, [](std::size_t) { return true; });
    grid_.arrange();
    for (std::size_t part = 0; part < grid_.parts(); ++part) grid_.spread(part, points);
    for (std::size_t bucket = 0; bucket < grid_.buckets(); ++bucket) grid_.sort(bucket);
    const std::uint32_t* const index = grid_.index();
    std::copy_n(grid_.x(), flock.size(), sorted_[Flock::X]);
    std::copy_n(grid_.y(), flock.size(), sorted_[Flock::Y]);
    std::copy_n(grid_.z(), flock.size(), sorted_[Flock::Z]);
    for (const auto column : {Flock::HeadingX, Flock::HeadingY, Flock::HeadingZ, Flock::Speed})
        for (std::size_t slot = 0; slot < flock.size(); ++slot)
            sorted_[column][slot] = flock[column][index[slot]];
}

double FlockStep::neighboursOf(const Flock& flock) {
    Flock copy = flock;
    sort(copy);
    constexpr float kReachSquared = kFlockReach * kFlockReach;
    std::size_t pairs = 0;
    for (std::size_t boid = 0; boid < copy.size(); ++boid) {
        const glm::vec3 from = positionOf(copy, boid);
        grid_.visitAround(from, kReachSquared, [&](const behaviour::SpatialGrid::Candidates& row) {
            for (std::size_t i = 0; i < row.index.size(); ++i) {
                const glm::vec3 offset = glm::vec3{row.x[i], row.y[i], row.z[i]} - from;
                pairs += row.index[i] != boid && glm::dot(offset, offset) <= kReachSquared ? 1 : 0;
            }
        });
    }
    return static_cast<double>(pairs) / static_cast<double>(copy.size());
}

std::array<float, Flock::kColumns> flockReference(const Flock& flock,
                                                  std::size_t boid,
                                                  float radius) {
    const glm::vec3 force = truncated(steering(flock, boid), kMostForce);
    const glm::vec3 velocity = truncated(
        flock[Flock::Speed][boid] * headingOf(flock, boid) + force * kFlockSeconds, kMostSpeed);
    glm::vec3 position = positionOf(flock, boid) + velocity * kFlockSeconds;
    const float distance = glm::length(position);
    if (distance > radius) position -= position * (2 * radius / distance);
    const glm::vec3 heading = unitOf(velocity);
    return {
        position.x, position.y, position.z, heading.x, heading.y, heading.z, glm::length(velocity)};
}

}  // namespace aquarama::bench
