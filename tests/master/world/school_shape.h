// SPDX-License-Identifier: Apache-2.0
// The shape of a school at a moment, in the figures that observers of real ones publish.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/place/place.h"
#include "master/fish/fish_view.h"

namespace aquarama::world {

struct SchoolShape {
    glm::vec3 centre{};
    double polarisation = 0;      // |mean heading|: 1 when all swim one way (Tunstrom et al. 2013)
    double rotation = 0;          // the same of turning about the upright through the centre
    double nearestNeighbour = 0;  // mean, body lengths
    double largestGroup = 0;  // the share of the fish in the largest group linked by kLinkMetres
};

// Fish nearer than this see one another.
inline constexpr float kLinkMetres = 1.2F;

inline SchoolShape shapeOf(const fish::FishView& view, std::uint32_t first, std::uint32_t last) {
    const std::uint32_t count = last - first;
    SchoolShape shape;
    glm::vec3 heading{};
    for (std::uint32_t i = first; i < last; ++i) {
        shape.centre += view.position(i) / static_cast<float>(count);
        heading += view.heading(i) / static_cast<float>(count);
    }
    shape.polarisation = place::lengthOf(heading);
    std::vector<std::uint32_t> group(count);
    for (std::uint32_t i = 0; i < count; ++i) group[i] = i;
    const auto rootOf = [&](std::uint32_t i) {
        while (group[i] != i) i = group[i];
        return i;
    };
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 from = view.position(first + i) - shape.centre;
        const glm::vec3 course = view.heading(first + i);
        const double away = std::max(1e-3, std::hypot(double{from.x}, double{from.z}));
        shape.rotation += double{from.z * course.x - from.x * course.z} / away / count;
        float nearest = 1e9F;
        for (std::uint32_t j = 0; j < count; ++j) {
            const float distance =
                place::lengthOf(view.position(first + j) - view.position(first + i));
            if (j != i) nearest = std::min(nearest, distance);
            if (j < i && distance < kLinkMetres) group[rootOf(i)] = rootOf(j);
        }
        shape.nearestNeighbour += double{nearest / view.fish[first + i].length} / count;
    }
    std::vector<std::uint32_t> members(count);
    for (std::uint32_t i = 0; i < count; ++i) ++members[rootOf(i)];
    shape.largestGroup =
        static_cast<double>(*std::max_element(members.begin(), members.end())) / count;
    shape.rotation = std::abs(shape.rotation);
    return shape;
}

inline SchoolShape shapeOf(const fish::FishView& view) {
    return shapeOf(view, 0, static_cast<std::uint32_t>(view.size()));
}

}  // namespace aquarama::world
