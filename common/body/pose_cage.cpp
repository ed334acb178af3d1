// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cassert>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/body/fish_body.h"

namespace aquarama {

namespace {

constexpr std::size_t kKnots = 7;  // nose, five rings, tail
constexpr float kLastStation = 1.2F;

// The bent axis of the fish and, at each knot, which way its right is.
struct Spine {
    std::array<float, kKnots> stations{};
    std::array<glm::vec3, kKnots> centres{};
    std::array<glm::vec3, kKnots> slopes{};  // of centre by station
    std::array<glm::vec3, kKnots> right{};
};

// Second-order difference on uneven stations; one-sided at the ends.
glm::vec3 slopeAt(const Spine& spine, std::size_t k) {
    const auto& s = spine.stations;
    const auto& c = spine.centres;
    if (k == 0) return (c[1] - c[0]) / (s[1] - s[0]);
    if (k == kKnots - 1) return (c[k] - c[k - 1]) / (s[k] - s[k - 1]);
    const float before = s[k] - s[k - 1];
    const float after = s[k + 1] - s[k];
    return (before * before * c[k + 1] + (after * after - before * before) * c[k] -
            after * after * c[k - 1]) /
           (before * after * (before + after));
}

Spine spineOf(const FishBody& body, const NodalPoints& n) {
    Spine spine;
    spine.centres[0] = n[0];
    for (std::size_t r = 0; r < 5; ++r) {
        const std::size_t a = 1 + 4 * r;
        spine.stations[r + 1] = body.ringStations[r];
        spine.centres[r + 1] = (n[a] + n[a + 1] + n[a + 2] + n[a + 3]) / 4.0F;
        spine.right[r + 1] = glm::normalize(n[a + 1] + n[a + 2] - n[a] - n[a + 3]);
    }
    spine.stations[6] = 1;
    spine.centres[6] = (n[21] + n[22]) / 2.0F;
    spine.right[0] = spine.right[1];
    const glm::vec3 tail =
        glm::normalize(glm::cross(n[21] - n[22], spine.centres[5] - spine.centres[6]));
    spine.right[6] = glm::dot(tail, spine.right[5]) < 0 ? -tail : tail;
    for (std::size_t k = 0; k < kKnots; ++k) spine.slopes[k] = slopeAt(spine, k);
    return spine;
}

// Cubic Hermite between knots, straight on behind the tail.
glm::vec3 place(const Spine& spine, glm::vec3 rest) {
    const float s = std::clamp(rest.x, 0.0F, kLastStation);
    std::size_t i = 0;
    while (i < kKnots - 2 && s >= spine.stations[i + 1]) ++i;
    const float h = spine.stations[i + 1] - spine.stations[i];
    const float beyond = (s - spine.stations[i]) / h;
    const float t = std::min(beyond, 1.0F);
    const glm::vec3 c0 = spine.centres[i];
    const glm::vec3 c1 = spine.centres[i + 1];
    const glm::vec3 m0 = h * spine.slopes[i];
    const glm::vec3 m1 = h * spine.slopes[i + 1];
    const float t2 = t * t;
    const float t3 = t2 * t;
    const glm::vec3 centre = (2 * t3 - 3 * t2 + 1) * c0 + (t3 - 2 * t2 + t) * m0 +
                             (3 * t2 - 2 * t3) * c1 + (t3 - t2) * m1 + (beyond - t) * m1;
    const glm::vec3 tailwards =
        (6 * t2 - 6 * t) * (c0 - c1) + (3 * t2 - 4 * t + 1) * m0 + (3 * t2 - 2 * t) * m1;
    const glm::vec3 forward = -glm::normalize(tailwards);
    const glm::vec3 side = glm::mix(spine.right[i], spine.right[i + 1], t);
    const glm::vec3 right = glm::normalize(side - forward * glm::dot(side, forward));
    return centre + rest.y * glm::cross(right, forward) + rest.z * right;
}

}  // namespace

void poseCage(const FishBody& body, const NodalPoints& nodes, std::span<glm::vec3> controlPoints) {
    assert(controlPoints.size() == body.cage.vertices.size());
    const Spine spine = spineOf(body, nodes);
    for (std::size_t i = 0; i < controlPoints.size(); ++i)
        controlPoints[i] = place(spine, body.cage.vertices[i].rest);
}

}  // namespace aquarama
