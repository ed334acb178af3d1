// SPDX-License-Identifier: Apache-2.0
#include "common/motion/warp_plans.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include <glm/vec3.hpp>

namespace aquarama::motion {
namespace {

// The least step of a warp. A repertoire that hardly moves would otherwise warp for seconds; this
// keeps K within its 8 bits.
constexpr float kSmallestStepBodyLengths = 1.0F / 128.0F;

// Nodal points, and both pectoral fins: their angles times kFinReachBodyLengths. In body lengths.
constexpr std::size_t kPoints = body::kNodalPoints + 2;
using Pose = std::array<glm::vec3, kPoints>;
// A fin that beats as fast as any moves no more than a tail does, so that a warp gives it time.
constexpr float kFinReachBodyLengths = 0.05F;
// [point][axis][phase]: one pose is compared with all of a cycle at once. The last phase repeats
// the first.
using PhaseValues = std::array<float, kPhases + 1>;
using Cycle = std::array<std::array<PhaseValues, 3>, kPoints>;
// [phase of A][phase of B]: the largest squared travel from one pose to the other, either way.
using Travels = std::array<PhaseValues, kPhases + 1>;

Cycle cycleOf(const ActionSegment& segment) {
    Cycle cycle;
    for (std::size_t k = 0; k <= kPhases; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t i = 0; i < body::kNodalPoints; ++i)
                cycle[i][axis][k] = segment.nodes[k % kPhases][i][axis] * kPoseUnit;
            for (std::size_t side = 0; side < 2; ++side)
                cycle[body::kNodalPoints + side][axis][k] =
                    segment.fins[k % kPhases][side][axis] * (kFinUnit * kFinReachBodyLengths);
        }
    return cycle;
}

Pose sampleAt(const Cycle& cycle, std::size_t k) {
    Pose pose;
    for (std::size_t i = 0; i < kPoints; ++i)
        pose[i] = {cycle[i][0][k], cycle[i][1][k], cycle[i][2][k]};
    return pose;
}

// How far a warp between a pose and each of a cycle has to move a nodal point, at most, squared.
// The paper compares node 22, the tail; we compare every nodal point, since a tail that comes back
// to its place may leave the head far from its own.
PhaseValues squaredTravels(const Pose& pose, const Cycle& cycle) {
    PhaseValues most{};
    for (std::size_t i = 0; i < kPoints; ++i) {
        const auto& [x, y, z] = cycle[i];
        for (std::size_t m = 0; m <= kPhases; ++m) {
            const glm::vec3 d = pose[i] - glm::vec3(x[m], y[m], z[m]);
            most[m] = std::max(most[m], (d.x * d.x + d.y * d.y) + d.z * d.z);
        }
    }
    return most;
}

// How far any point of a cycle moves, squared, from sample k to a phase in 1/65536 of a cycle,
// which lies between two samples; the cycle repeats.
float squaredStep(const Cycle& cycle, std::size_t k, unsigned phase) {
    const std::size_t cell = (phase & 0xFFFFU) >> kPhaseCellBits;
    const float share = static_cast<float>(phase & 1023U) * kPhaseCellUnit;
    const Pose now = sampleAt(cycle, k), before = sampleAt(cycle, cell),
               after = sampleAt(cycle, cell + 1);
    float most = 0;
    for (std::size_t i = 0; i < kPoints; ++i) {
        const glm::vec3 d = now[i] - (before[i] + share * (after[i] - before[i]));
        most = std::max(most, (d.x * d.x + d.y * d.y) + d.z * d.z);
    }
    return most;
}

// The longest distance that any nodal point moves in a tick of any segment but a fast start: a warp
// of such steps is no faster than the fish's other motion.
float largestStep(const std::vector<Cycle>& cycles,
                  const std::array<std::int16_t, kActions>& phaseRates) {
    float most = kSmallestStepBodyLengths * kSmallestStepBodyLengths;
    for (std::size_t action = 0; action < cycles.size(); ++action) {
        if (isStart(static_cast<Action>(action))) continue;
        for (unsigned k = 0; k < kPhases; ++k) {
            const unsigned next = (k << kPhaseCellBits) + static_cast<unsigned>(phaseRates[action]);
            most = std::max(most, squaredStep(cycles[action], k, next));
        }
    }
    return std::sqrt(most);
}

Travels travelsBetween(const Cycle& a, const Cycle& b) {
    Travels travels;
    for (std::size_t k = 0; k <= kPhases; ++k) travels[k] = squaredTravels(sampleAt(a, k), b);
    return travels;
}

Travels transposed(const Travels& travels) {
    Travels other;
    for (std::size_t k = 0; k <= kPhases; ++k)
        for (std::size_t m = 0; m <= kPhases; ++m) other[m][k] = travels[k][m];
    return other;
}

// The largest travel from anywhere within a cell: travel is convex in the phase there, so its ends
// bound it.
float travelFromCell(const Travels& travels, std::size_t cell, std::size_t to) {
    return std::max(travels[cell][to], travels[cell + 1][to]);
}

// The length of a warp is a byte.
constexpr int kMostFrames = 255;

// The entry phase whose pose is nearest, and as many frames as keep each step within `step`
// (section 4.2).
WarpPlan planToPhase(const Travels& travels, std::size_t cell, std::size_t entry, float step) {
    const float steps = std::sqrt(travelFromCell(travels, cell, entry)) / step;
    const auto frames = static_cast<int>(steps);  // ceil(steps) - 1, but for whole numbers
    return {static_cast<std::uint16_t>(entry << kPhaseCellBits),
            static_cast<std::uint8_t>(std::min(frames, kMostFrames))};
}

WarpPlan planToCycle(const Travels& travels, std::size_t cell, float step) {
    std::size_t entry = 0;
    for (std::size_t m = 1; m < kPhases; ++m) {
        if (travelFromCell(travels, cell, m) < travelFromCell(travels, cell, entry)) entry = m;
    }
    return planToPhase(travels, cell, entry, step);
}

// A fast start is not delayed: two frames lead to it at most, or a tenth of a long one.
int mostFramesToStart(std::int16_t rate) {
    return std::clamp(65536 / (10 * rate), 2, kMostFrames);
}

// A turn plays from the first frame of the warp on, at its phase rate: the first phase to which all
// steps are within `step`, or the last one that a warp of so many frames can reach.
WarpPlan planToTurn(
    const Travels& travels, std::size_t cell, float step, std::int16_t rate, int mostFrames) {
    int ticks = 0;
    float steps = 0;
    do {
        ++ticks;
        // The pose lies between two samples, and travel to it is at most that to the farther.
        const auto next = static_cast<std::size_t>(ticks * rate) >> kPhaseCellBits;
        steps = std::sqrt(std::max(travelFromCell(travels, cell, next),
                                   travelFromCell(travels, cell, next + 1))) /
                step;
    } while (steps > static_cast<float>(ticks) && ticks <= mostFrames &&
             (ticks + 1) * rate <= 0xFFFF);
    return {static_cast<std::uint16_t>(ticks * rate), static_cast<std::uint8_t>(ticks - 1)};
}

}  // namespace

WarpPlans planWarps(const Repertoire& repertoire,
                    const std::array<std::int16_t, kActions>& phaseRates) {
    assert(std::ranges::all_of(phaseRates, [](std::int16_t rate) { return rate > 0; }));
    std::vector<Cycle> cycles;
    for (const ActionSegment& segment : repertoire.segments) cycles.push_back(cycleOf(segment));
    const float step = largestStep(cycles, phaseRates);
    WarpPlans plans;
    const auto planFromTo = [&](std::size_t from, std::size_t to, const Travels& travels) {
        const auto next = static_cast<Action>(to);
        for (std::size_t cell = 0; cell < kPhases; ++cell) {
            WarpPlan& plan = plans[from][cell][to];
            if (repertoire.segments[to].playsToEnd)
                plan = planToTurn(travels,
                                  cell,
                                  step,
                                  phaseRates[to],
                                  isStart(next) ? mostFramesToStart(phaseRates[to]) : kMostFrames);
            else
                plan = planToCycle(travels, cell, step);
        }
    };
    for (std::size_t a = 0; a < kActions; ++a) {
        for (std::size_t b = a; b < kActions; ++b) {
            const Travels travels = travelsBetween(cycles[a], cycles[b]);
            planFromTo(a, b, travels);
            planFromTo(b, a, transposed(travels));
        }
    }
    return plans;
}

}  // namespace aquarama::motion
