// SPDX-License-Identifier: Apache-2.0
#include "common/motion/warp_plan.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace aquarama::motion {
namespace {

// A repertoire that hardly moves would warp for seconds; this step keeps K within its 8 bits.
constexpr float kSmallestStepBodyLengths = 1.0F / 128.0F;

using Pose = std::array<glm::vec3, body::kNodalPoints>;  // body lengths
using Cycle = std::array<Pose, kPhases + 1>;             // the last pose repeats the first
// [phase of A][phase of B]: the largest squared travel from one pose to the other.
using Travels = std::array<std::array<float, kPhases>, kPhases + 1>;

Cycle cycleOf(const ActionSegment& segment) {
    Cycle cycle;
    for (std::size_t k = 0; k < cycle.size(); ++k) {
        for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
            const auto& d = segment.nodes[k % kPhases][i];
            cycle[k][i] = glm::vec3(d[0], d[1], d[2]) * kPoseUnit;
        }
    }
    return cycle;
}

// The paper watches node 22, the tail; we watch every nodal point, since a tail that comes back to
// its place may leave the head far from its own.
float squaredTravel(const Pose& a, const Pose& b) {
    float most = 0;
    for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
        const glm::vec3 d = a[i] - b[i];
        most = std::max(most, (d.x * d.x + d.y * d.y) + d.z * d.z);
    }
    return most;
}

Pose poseAt(const Cycle& cycle, unsigned phase) {
    const std::size_t cell = (phase & 0xFFFFU) >> kPhaseCellBits;
    const float share = static_cast<float>(phase & 1023U) * kPhaseCellUnit;
    Pose pose;
    for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
        pose[i] = cycle[cell][i] + share * (cycle[cell + 1][i] - cycle[cell][i]);
    }
    return pose;
}

// The furthest that any nodal point moves in a tick of any segment: what the eye knows already.
float largestStep(const std::vector<Cycle>& cycles,
                  const std::array<std::int16_t, kActions>& phaseRates) {
    float most = kSmallestStepBodyLengths * kSmallestStepBodyLengths;
    for (std::size_t action = 0; action < cycles.size(); ++action) {
        for (unsigned k = 0; k < kPhases; ++k) {
            const Pose next = poseAt(
                cycles[action], (k << kPhaseCellBits) + static_cast<unsigned>(phaseRates[action]));
            most = std::max(most, squaredTravel(cycles[action][k], next));
        }
    }
    return std::sqrt(most);
}

Travels travelsBetween(const Cycle& a, const Cycle& b) {
    Travels travels;
    for (std::size_t k = 0; k <= kPhases; ++k) {
        for (std::size_t m = 0; m < kPhases; ++m) travels[k][m] = squaredTravel(a[k], b[m]);
    }
    return travels;
}

// Travel within the cell is convex in the phase, so its ends bound it.
float travelFromCell(const Travels& travels, std::size_t cell, std::size_t to) {
    return std::max(travels[cell][to], travels[cell + 1][to]);
}

WarpPlan planFor(const Travels& travels, std::size_t cell, bool enterAtStart, float step) {
    std::size_t entry = 0;
    for (std::size_t m = 1; m < kPhases && !enterAtStart; ++m) {
        if (travelFromCell(travels, cell, m) < travelFromCell(travels, cell, entry)) entry = m;
    }
    const float steps = std::sqrt(travelFromCell(travels, cell, entry)) / step;
    const auto frames = static_cast<int>(steps);  // ceil(steps) - 1, but for whole numbers
    return {static_cast<std::uint16_t>(entry << kPhaseCellBits),
            static_cast<std::uint8_t>(std::min(frames, 255))};
}

}  // namespace

WarpPlans planWarps(const Repertoire& repertoire,
                    const std::array<std::int16_t, kActions>& phaseRates) {
    std::vector<Cycle> cycles;
    for (const ActionSegment& segment : repertoire.segments) cycles.push_back(cycleOf(segment));
    const float step = largestStep(cycles, phaseRates);
    WarpPlans plans;
    for (std::size_t from = 0; from < kActions; ++from) {
        for (std::size_t to = 0; to < kActions; ++to) {
            const Travels travels = travelsBetween(cycles[from], cycles[to]);
            const bool enterAtStart = repertoire.segments[to].playsToEnd;
            for (std::size_t cell = 0; cell < kPhases; ++cell) {
                plans[from][cell][to] = planFor(travels, cell, enterAtStart, step);
            }
        }
    }
    return plans;
}

}  // namespace aquarama::motion
