// SPDX-License-Identifier: Apache-2.0
#include "master/study/school_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

namespace aquarama::study {

namespace {

constexpr double kRadiansOfPhase = 2 * std::numbers::pi / 65536;
constexpr int kInStepPhase = 65536 / 16;

// Around the cycle.
int phaseBetween(std::uint16_t a, std::uint16_t b) {
    return std::abs(static_cast<std::int16_t>(static_cast<std::uint16_t>(a - b)));
}

std::vector<std::size_t> present(const fish::FishView& view, std::size_t first, std::size_t last) {
    std::vector<std::size_t> fish;
    for (std::size_t i = first; i < last; ++i)
        if (!view.shows(i, fish::kAway)) fish.push_back(i);
    return fish;
}

float distanceToNearest(const fish::FishView& view,
                        const std::vector<std::size_t>& all,
                        std::size_t one) {
    float nearest = std::numeric_limits<float>::max();
    for (const std::size_t other : all)
        if (other != one)
            nearest = std::min(nearest, glm::distance(view.position(one), view.position(other)));
    return nearest;
}

}  // namespace

SchoolFigures schoolFigures(const fish::FishView& view, std::size_t first, std::size_t last) {
    const std::vector<std::size_t> fish = present(view, first, last);
    SchoolFigures figures;
    if (fish.size() < 2) return figures;
    const float share = 1 / static_cast<float>(fish.size());
    glm::vec3 middle{}, heading{}, momentum{};
    for (const std::size_t i : fish) middle += view.position(i) * share;
    for (const std::size_t i : fish) {
        const glm::vec3 from = view.position(i) - middle;
        const float distance = glm::length(from);
        heading += view.heading(i) * share;
        if (distance > 0) momentum += glm::cross(from / distance, view.heading(i)) * share;
        figures.radiusMetres += static_cast<double>(distance * distance * share);
        figures.nearestNeighbour +=
            static_cast<double>(distanceToNearest(view, fish, i) / view.fish[i].length * share);
    }
    figures.polarisation = static_cast<double>(glm::length(heading));
    figures.rotation = static_cast<double>(glm::length(momentum));
    figures.radiusMetres = std::sqrt(figures.radiusMetres);
    return figures;
}

Synchrony synchronyOf(const motion::MotionStates& states, std::size_t first, std::size_t last) {
    double sine = 0, cosine = 0;
    double alike = 0, inStep = 0;
    for (std::size_t i = first; i < last; ++i) {
        sine += std::sin(states.phase[i] * kRadiansOfPhase);
        cosine += std::cos(states.phase[i] * kRadiansOfPhase);
        for (std::size_t j = i + 1; j < last; ++j) {
            if (states.segment[i] != states.segment[j]) continue;
            ++alike;
            if (phaseBetween(states.phase[i], states.phase[j]) < kInStepPhase) ++inStep;
        }
    }
    const auto fish = static_cast<double>(last - first);
    if (fish < 2) return {};
    const double pairs = fish * (fish - 1) / 2;
    return {std::hypot(sine, cosine) / fish, alike / pairs, inStep / pairs};
}

}  // namespace aquarama::study
