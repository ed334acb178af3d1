// SPDX-License-Identifier: Apache-2.0

#include "master/capture/compile_segment.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "common/units/log.h"
#include "master/capture/dynamics.h"

namespace aquarama::capture {

namespace {

constexpr std::size_t kCount = motion::kPhases;
// Share of a turn in which its first pose, a swimming one, is faded out.
constexpr double kEntryShare = 0.2;

// A fish and its muscles are their own mirror images top to bottom, so it moves in a plane: its
// frame only yaws. What the simulation shows beside that is rounding, and left out it cannot add up
// over hours to a roll or a climb.
struct PlanarMotion {
    double periodSeconds = 0;
    bool playsToEnd = false;
    double yawOffCourse = 0;           // of the first pose, left positive, radians
    std::array<double, kCount> yaw{};  // from phase k to k + 1, left positive, radians
    std::array<glm::dvec3, kCount> translation{};
    std::array<NodeVectors, kCount + 1> poses{};  // body frame
};

// In a mirror: nodes change places and one coordinate its sign.
NodeVectors mirrored(const NodeVectors& pose, int (*partner)(int), const glm::dvec3& signs) {
    NodeVectors image{};
    for (int i = 0; i < body::kNodalPoints; ++i)
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
PlanarMotion planarMotionOf(const RecordedCycle& recording) {
    PlanarMotion motion{.periodSeconds = recording.periodSeconds,
                        .playsToEnd = recording.playsToEnd,
                        .yawOffCourse = yawRadians(
                            recording.course, frameOf(recording.poses.front()).worldFromBody[0])};
    for (std::size_t k = 0; k <= kCount; ++k) {
        const NodeVectors pose = inBodyFrame(recording.poses.at(k));
        motion.poses.at(k) = blended(pose, swappedTopBottom(pose), 0.5);
    }
    for (std::size_t k = 0; k < kCount; ++k) {
        const PoseFrame now = frameOf(recording.poses.at(k));
        const PoseFrame next = frameOf(recording.poses.at(k + 1));
        const glm::dmat3 bodyFromWorld = glm::transpose(now.worldFromBody);
        motion.yaw.at(k) = yawRadians(now.worldFromBody[0], next.worldFromBody[0]);
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

// How much of the entry is replaced at a phase: all of it at first, nothing from kEntryShare on.
double fadeAt(std::size_t k) {
    const double left = std::max(0.0, 1 - static_cast<double>(k) / kCount / kEntryShare);
    return left * left * (3 - 2 * left);
}

// A turn begins in a swimming pose, at whatever angle to its course the beat has there, and ends
// straight. So that its last pose is its first one again and the whole of it is the change of
// course, it fades in from a straight fish on course.
PlanarMotion fadedIn(const PlanarMotion& motion) {
    PlanarMotion result = motion;
    for (std::size_t k = 0; k <= kCount; ++k) {
        for (std::size_t i = 0; i < std::size_t{body::kNodalPoints}; ++i)
            result.poses.at(k).at(i) +=
                fadeAt(k) * (motion.poses.back().at(i) - motion.poses.front().at(i));
        if (k == kCount) break;
        result.yaw.at(k) += motion.yawOffCourse * (fadeAt(k) - fadeAt(k + 1));
        result.translation.at(k) =
            glm::angleAxis(motion.yawOffCourse * fadeAt(k), glm::dvec3(0, 1, 0)) *
            motion.translation.at(k);
    }
    return result;
}

PlanarMotion mirrored(const PlanarMotion& motion) {
    PlanarMotion mirror = motion;
    for (double& yaw : mirror.yaw) yaw = -yaw;
    for (glm::dvec3& translation : mirror.translation) translation.z = -translation.z;
    for (NodeVectors& pose : mirror.poses) pose = swappedLeftRight(pose);
    return mirror;
}

std::array<std::int16_t, 3> quantised(const glm::vec3& point) {
    std::array<std::int16_t, 3> integers{};
    for (std::size_t c = 0; c < 3; ++c) {
        const float value = std::round(point[static_cast<int>(c)] / motion::kPoseUnit);
        if (!(std::abs(value) <= 32767))
            throw Error(
                "a captured fish reaches further than its own length; change its species file");
        integers.at(c) = static_cast<std::int16_t>(value);
    }
    return integers;
}

body::NodalPoints nodesOf(const motion::NodalPose& pose) {
    body::NodalPoints nodes{};
    for (std::size_t i = 0; i < nodes.size(); ++i)
        nodes.at(i) = motion::kPoseUnit * glm::vec3(pose.at(i)[0], pose.at(i)[1], pose.at(i)[2]);
    return nodes;
}

motion::ActionSegment segmentOf(const PlanarMotion& motion) {
    motion::ActionSegment segment;
    segment.periodSeconds = static_cast<float>(motion.periodSeconds);
    segment.playsToEnd = motion.playsToEnd;
    for (std::size_t k = 0; k < kCount; ++k) {
        segment.increments.at(k) = {
            glm::quat(glm::angleAxis(motion.yaw.at(k), glm::dvec3(0, 1, 0))),
            glm::vec3(motion.translation.at(k))};
        std::ranges::transform(motion.poses.at(k), segment.nodes.at(k).begin(), quantised);
    }
    return segment;
}

}  // namespace

motion::ActionSegment compileForward(const RecordedCycle& recording) {
    return segmentOf(straightened(planarMotionOf(recording)));
}

motion::ActionSegment compileLeftTurn(const RecordedCycle& recording) {
    return segmentOf(fadedIn(planarMotionOf(recording)));
}

motion::ActionSegment compileRightTurn(const RecordedCycle& leftTurn) {
    return segmentOf(mirrored(fadedIn(planarMotionOf(leftTurn))));
}

void addControlPoints(const body::FishBody& body, motion::ActionSegment& segment) {
    std::vector<glm::vec3> cage(body.cage.vertices.size());
    segment.controlPoints.resize(motion::kPhases);
    for (std::size_t k = 0; k < kCount; ++k) {
        body::poseCage(body, nodesOf(segment.nodes.at(k)), cage);
        std::ranges::transform(cage, segment.controlPoints.at(k).begin(), quantised);
    }
}

}  // namespace aquarama::capture
