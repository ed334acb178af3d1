// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/compile_segment.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "common/units/error.h"
#include "master/capture/dynamics/body_frame.h"

namespace aquarama {

namespace {

constexpr std::size_t kCount = kPhases;
// Share of a sharp turn in which its first pose, a swimming one, is faded out.
constexpr double kEntryShare = 0.2;

// A fish and its muscles are their own mirror images top to bottom, so it moves in a plane: its
// frame only yaws. What the simulation shows beside that is rounding, and left out it cannot add up
// over hours to a roll or a climb.
struct PlanarMotion {
    double periodSeconds = 0;
    bool playsToEnd = false;
    std::array<double, kCount> yaw{};  // from phase k to k + 1, left positive, radians
    std::array<glm::dvec3, kCount> translation{};
    std::array<NodeVectors, kCount + 1> poses{};  // body frame
};

// In a mirror: nodes change places and one coordinate its sign.
NodeVectors mirrored(const NodeVectors& pose, int (*partner)(int), const glm::dvec3& signs) {
    NodeVectors image{};
    for (int i = 0; i < kNodalPoints; ++i)
        image.at(static_cast<std::size_t>(i)) =
            signs * pose.at(static_cast<std::size_t>(partner(i)));
    return image;
}
NodeVectors swappedLeftRight(const NodeVectors& pose) {
    return mirrored(pose, mirroredLeftRight, {1, 1, -1});
}
NodeVectors swappedTopBottom(const NodeVectors& pose) {
    return mirrored(pose, mirroredTopBottom, {1, -1, 1});
}

NodeVectors blended(const NodeVectors& a, const NodeVectors& b, double shareOfB) {
    NodeVectors mean{};
    for (std::size_t i = 0; i < mean.size(); ++i) mean.at(i) = glm::mix(a.at(i), b.at(i), shareOfB);
    return mean;
}

// Eq. 6-8, with the rotation in the body frame: R' = R * dR (the paper's eq. 6 is in world axes,
// which is right only for a fish that swims level).
PlanarMotion planarMotionOf(const Recording& recording) {
    PlanarMotion motion{.periodSeconds = recording.periodSeconds,
                        .playsToEnd = recording.playsToEnd};
    for (std::size_t k = 0; k <= kCount; ++k) {
        const NodeVectors pose = inBodyFrame(recording.poses.at(k));
        motion.poses.at(k) = blended(pose, swappedTopBottom(pose), 0.5);
    }
    for (std::size_t k = 0; k < kCount; ++k) {
        const PoseFrame now = frameOf(recording.poses.at(k));
        const PoseFrame next = frameOf(recording.poses.at(k + 1));
        const glm::dmat3 bodyFromWorld = glm::transpose(now.worldFromBody);
        const glm::dvec3 heading = bodyFromWorld * next.worldFromBody[0];
        motion.yaw.at(k) = std::atan2(-heading.z, heading.x);
        motion.translation.at(k) =
            glm::dvec3(1, 0, 1) * (bodyFromWorld * (next.origin - now.origin));
    }
    return motion;
}

// Swimming straight, the second half of a beat is the mirror image of the first: the mean of both
// neither turns nor drifts.
PlanarMotion straightened(const PlanarMotion& motion) {
    PlanarMotion straight = motion;
    for (std::size_t k = 0; k < kCount; ++k) {
        const std::size_t half = (k + kCount / 2) % kCount;
        straight.yaw.at(k) = (motion.yaw.at(k) - motion.yaw.at(half)) / 2;
        straight.translation.at(k) =
            (motion.translation.at(k) + glm::dvec3(1, 1, -1) * motion.translation.at(half)) / 2.0;
        straight.poses.at(k) =
            blended(motion.poses.at(k), swappedLeftRight(motion.poses.at(half)), 0.5);
    }
    straight.poses.back() = straight.poses.front();
    return straight;
}

// Makes the last pose the first one again. A cycle lacks only what its warm-up left, so the gap is
// spread over all of it; a sharp turn begins in a swimming pose and ends straight, so it fades in
// from straight.
PlanarMotion closed(const PlanarMotion& motion) {
    PlanarMotion result = motion;
    for (std::size_t k = 0; k <= kCount; ++k) {
        const double phase = static_cast<double>(k) / kCount;
        const double fade = std::max(0.0, 1 - phase / kEntryShare);
        const double share = motion.playsToEnd ? fade * fade * (3 - 2 * fade) : -phase;
        for (std::size_t i = 0; i < std::size_t{kNodalPoints}; ++i)
            result.poses.at(k).at(i) +=
                share * (motion.poses.back().at(i) - motion.poses.front().at(i));
    }
    return result;
}

// A turn to the other side. A cyclic one begins half a beat later, so that the same phase still
// means the same stroke of the tail.
PlanarMotion mirroredTurn(const PlanarMotion& motion) {
    PlanarMotion mirror = motion;
    const std::size_t shift = motion.playsToEnd ? 0 : kCount / 2;
    for (std::size_t k = 0; k < kCount; ++k) {
        const std::size_t from = (k + shift) % kCount;
        mirror.yaw.at(k) = -motion.yaw.at(from);
        mirror.translation.at(k) = glm::dvec3(1, 1, -1) * motion.translation.at(from);
        mirror.poses.at(k) = swappedLeftRight(motion.poses.at(from));
    }
    mirror.poses.back() = mirror.poses.front();
    return mirror;
}

std::array<std::int16_t, 3> quantised(const glm::vec3& point) {
    std::array<std::int16_t, 3> integers{};
    for (std::size_t c = 0; c < 3; ++c) {
        const float value = std::round(point[static_cast<int>(c)] / kPoseUnit);
        if (!(std::abs(value) <= 32767))
            throw Error(
                "a captured fish reaches further than its own length; change its species file");
        integers.at(c) = static_cast<std::int16_t>(value);
    }
    return integers;
}

NodalPoints toFloats(const NodeVectors& pose) {
    NodalPoints nodes{};
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes.at(i) = glm::vec3(pose.at(i));
    return nodes;
}

ActionSegment segmentOf(const FishBody& body, const PlanarMotion& motion) {
    ActionSegment segment;
    segment.periodSeconds = static_cast<float>(motion.periodSeconds);
    segment.playsToEnd = motion.playsToEnd;
    std::vector<glm::vec3> cage(body.cage.vertices.size());
    for (std::size_t k = 0; k < kCount; ++k) {
        segment.increments.at(k) = {
            glm::quat(glm::angleAxis(motion.yaw.at(k), glm::dvec3(0, 1, 0))),
            glm::vec3(motion.translation.at(k))};
        const NodalPoints nodes = toFloats(motion.poses.at(k));
        std::ranges::transform(nodes, segment.nodes.at(k).begin(), quantised);
        poseCage(body, nodes, cage);  // eq. 9
        std::ranges::transform(cage, segment.controlPoints.emplace_back().begin(), quantised);
    }
    return segment;
}

}  // namespace

ActionSegment compileForward(const FishBody& body, const Recording& recording) {
    return segmentOf(body, straightened(planarMotionOf(recording)));
}

ActionSegment compileLeftTurn(const FishBody& body, const Recording& recording) {
    return segmentOf(body, closed(planarMotionOf(recording)));
}

ActionSegment compileRightTurn(const FishBody& body, const Recording& leftTurn) {
    return segmentOf(body, mirroredTurn(closed(planarMotionOf(leftTurn))));
}

}  // namespace aquarama
