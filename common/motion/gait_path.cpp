// SPDX-License-Identifier: Apache-2.0
#include "common/motion/gait_path.h"

#include <algorithm>
#include <cmath>

namespace aquarama::motion {
namespace {

constexpr std::size_t kCycle = kPhases;
constexpr double kNoWayBodyLengths = 1e-6;  // over some phases: too short to have a direction

void integrate(const ActionSegment& segment, GaitPath& path) {
    path.rotation[0] = glm::dquat(1, 0, 0, 0);
    for (std::size_t k = 0; k + 1 < kPathSamples; ++k) {
        const FrameIncrement& step = segment.increments[k % kCycle];
        const glm::dquat turn(step.rotation);
        path.translation[k + 1] =
            path.translation[k] + path.rotation[k] * glm::dvec3(step.translation);
        // The nearer of the two quaternions of a rotation, so that the path may be interpolated.
        path.rotation[k + 1] = glm::normalize(path.rotation[k] * (turn.w < 0 ? turn * -1.0 : turn));
    }
}

// The path with the cycle repeated before and after it.
glm::dquat rotationAt(const GaitPath& path, int phase) {
    if (phase >= 0) return path.rotation[static_cast<std::size_t>(phase)];
    const int inCycle = phase + kPhases;
    return glm::conjugate(path.rotation[kCycle]) * path.rotation[static_cast<std::size_t>(inCycle)];
}

// The mean of the frames within half a cycle of `phase`.
glm::dquat meanAt(const GaitPath& path, int phase) {
    constexpr int kHalf = kPhases / 2;
    glm::dquat sum = (rotationAt(path, phase - kHalf) + rotationAt(path, phase + kHalf)) * 0.5;
    for (int near = phase - kHalf + 1; near < phase + kHalf; ++near) {
        sum = sum + rotationAt(path, near);
    }
    return glm::normalize(sum);
}

// The least rotation that brings the body's x axis along the path at phase k; the path is taken
// over a sixteenth of a turn, less at its ends.
glm::dquat alongPath(const GaitPath& path, std::size_t k) {
    const std::size_t reach = std::clamp<std::size_t>(std::min(k, kCycle - k), 1, 2);
    const std::size_t from = k < reach ? k : k - reach;
    const std::size_t to = std::min(k + reach, kCycle);
    const glm::dvec3 way =
        glm::conjugate(path.rotation[k]) * (path.translation[to] - path.translation[from]);
    if (way.x < kNoWayBodyLengths) return {1, 0, 0, 0};
    const double length = std::sqrt(glm::dot(way, way));
    return glm::normalize(glm::dquat(1 + way.x / length, 0, -way.z / length, way.y / length));
}

// A turn that plays to its end is no cycle, and has no mean over one. Its frame looks along its
// path, from which the bent body points away; but at the end where the straight body does, since
// there the water soon takes what is left of a slip.
glm::dquat courseAt(const GaitPath& path, std::size_t k) {
    constexpr std::size_t kLastQuarter = kCycle / 4;
    const double left =
        std::min(1.0, static_cast<double>(kCycle - k) / static_cast<double>(kLastQuarter));
    const double share = left * left * (3 - 2 * left);
    const glm::dquat straight(1, 0, 0, 0);
    return path.rotation[k] * glm::normalize(straight * (1 - share) + alongPath(path, k) * share);
}

std::array<glm::dquat, kCycleSamples> meansOf(const GaitPath& path, bool playsToEnd) {
    std::array<glm::dquat, kCycleSamples> means{};
    for (std::size_t k = 0; k < kCycleSamples; ++k) {
        means[k] = playsToEnd ? courseAt(path, k) : meanAt(path, static_cast<int>(k));
    }
    return means;
}

// Central difference of the body frame's origin, taken in the second cycle, which has a first
// before it; seen in mean axes. Where a turn begins and ends, one side is not its own.
double forwardAt(const GaitPath& path, std::size_t k, bool playsToEnd) {
    const std::size_t at = kCycle + k % kCycle;
    const bool begins = playsToEnd && k == 0;
    const bool ends = playsToEnd && k == kCycle;
    const glm::dvec3 before = path.translation[begins ? at : at - 1];
    const glm::dvec3 after = path.translation[ends ? at : at + 1];
    const glm::dvec3 step = (after - before) * (begins || ends ? 1.0 : 0.5);
    const glm::dvec3 inBody = glm::conjugate(path.rotation[at]) * step;
    return (glm::conjugate(path.bodyFromMean[k]) * inBody).x;
}

}  // namespace

GaitPath pathOf(const ActionSegment& segment) {
    GaitPath path;
    integrate(segment, path);
    const auto means = meansOf(path, segment.playsToEnd);
    for (std::size_t k = 0; k < kCycleSamples; ++k) {
        path.bodyFromMean[k] = glm::conjugate(path.rotation[k]) * means[k];
    }
    for (std::size_t k = 0; k < kCycleSamples; ++k) {
        const std::size_t now = k % kCycle;
        const glm::dquat turn = glm::conjugate(means[now]) * means[now + 1];
        path.mean[k] = {glm::dvec3(turn.x, turn.y, turn.z) / turn.w,
                        forwardAt(path, k, segment.playsToEnd)};
    }
    return path;
}

}  // namespace aquarama::motion
