// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile_segment.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "common/base/log.h"
#include "master/capture/dynamics.h"

namespace aquarama::capture {

namespace {

constexpr std::size_t kCount = motion::kPhases;
// The swimming pose at the start of a turn is faded out over this share of the turn.
constexpr double kEntryShare = 0.2;

// The fish and its muscles are symmetric top to bottom, so the exact motion lies in a plane and the
// body frame only yaws. Pitch, roll and climb in a recording are rounding errors. They are removed
// here; else they would add up over hours of repetition.
struct PlanarMotion {
    double periodSeconds = 0;
    bool playsToEnd = false;
    double yawOffCourse = 0;           // of the first pose, left positive, radians
    std::array<double, kCount> yaw{};  // from phase k to k + 1, left positive, radians
    // From phase k to k + 1, in the body frame at phase k, body lengths; y is zero.
    std::array<glm::dvec3, kCount> translation{};
    std::array<NodeVectors, kCount + 1> poses{};  // in the body frame, body lengths
};

// The mirror image of a pose: `partner` gives the node that takes a node's place, `signs` is -1 for
// the coordinate that is reversed and 1 for the others.
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
    assert(recording.poses.size() == kCount + 1);
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

// In straight swimming the second half of a beat is the mirror image of the first. The mean of each
// phase and of the mirror image half a beat later has this symmetry exactly, so that a cycle
// neither turns nor drifts to a side.
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

// The weight of the correction at a phase: 1 at phase 0, falling smoothly to 0 at kEntryShare of
// the cycle.
double fadeAt(std::size_t k) {
    const double left = std::max(0.0, 1 - static_cast<double>(k) / kCount / kEntryShare);
    return left * left * (3 - 2 * left);
}

// A recorded turn begins in a swimming pose, with the body frame at some angle to the course, and
// ends straight. The correction makes the first pose equal to the last one and the first heading
// equal to the course. It fades out over kEntryShare. So the segment is closed, and its total yaw
// is the change of course.
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

// Left and right exchanged: a left turn becomes a right one.
PlanarMotion mirrored(const PlanarMotion& motion) {
    PlanarMotion mirror = motion;
    for (double& yaw : mirror.yaw) yaw = -yaw;
    for (glm::dvec3& translation : mirror.translation) translation.z = -translation.z;
    for (NodeVectors& pose : mirror.poses) pose = swappedLeftRight(pose);
    return mirror;
}

// To units of kPoseUnit. The comparison is written so that NaN throws too.
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

// Back to body lengths. Control points are computed from the quantised nodes, since these are what
// a reader of the repertoire has.
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
    assert(body.cage.vertices.size() == body::kControlPoints);
    std::vector<glm::vec3> cage(body.cage.vertices.size());
    segment.controlPoints.resize(motion::kPhases);
    for (std::size_t k = 0; k < kCount; ++k) {
        body::poseCage(body, nodesOf(segment.nodes.at(k)), cage);
        std::ranges::transform(cage, segment.controlPoints.at(k).begin(), quantised);
    }
}

}  // namespace aquarama::capture
