// SPDX-License-Identifier: Apache-2.0
// Fish as straight round rods: whether two of them are in each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "master/fish/fish_view.h"

namespace aquarama::study {

// The body frame's origin is this share of the length behind the nose.
inline constexpr float kNoseAhead = 0.385F;

struct Rod {
    glm::vec3 origin{};          // of the body frame, metres
    glm::vec3 heading{1, 0, 0};  // unit vector
    float length = 0;            // metres
    float halfWidth = 0;         // metres, the greatest of the body
};

// Of all fish but those that are away, whose length is 0. Half-widths are given by kind, in body
// lengths.
void rodsOf(const fish::FishView& view, std::span<const float> halfWidths, std::vector<Rod>& rods);

// Between the middle lines from nose to tail, metres.
[[nodiscard]] float distanceBetween(const Rod& a, const Rod& b);

// Of the shorter one's middle line, the share that is nearer to the other's than their half-widths
// together; 0 where they do not overlap.
[[nodiscard]] float overlapOf(const Rod& a, const Rod& b);

}  // namespace aquarama::study
