// SPDX-License-Identifier: Apache-2.0
#include "capture/compile_segment.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "capture/dynamics.h"
#include "common/base/log.h"

namespace aquarama::capture {

namespace {

constexpr std::size_t kCount = motion::kPhases;
// The swimming pose at the start of a turn is faded out over this share of the turn.
constexpr double kEntryShare = 0.2;

// One cycle as a fish swam it. Lengths are body lengths.
struct FrameMotion {
    double periodSeconds = 0;
    bool playsToEnd = false;
    double yawOffCourse = 0;  // of the first pose, left positive, radians
    // From phase k to k + 1, in the body frame at phase k.
    std::array<glm::dquat, kCount> rotation{};
    std::array<glm::dvec3, kCount> translation{};
    std::array<NodeVectors, kCount + 1> poses{};  // in the body frame
    std::array<std::array<glm::dvec3, 2>, kCount + 1> fins{};
};

// A reflection in a plane through the body axis: `partner` gives the node that takes a node's
// place, `signs` is -1 for the coordinate that is reversed and 1 for the others.
struct Mirror {
    int (*partner)(int);
    glm::dvec3 signs;
};
constexpr Mirror kLeftRight{mirroredLeftRight, {1, 1, -1}};
constexpr Mirror kTopBottom{mirroredTopBottom, {1, -1, 1}};

NodeVectors reflected(const NodeVectors& pose, const Mirror& mirror) {
    NodeVectors image{};
    for (int i = 0; i < body::kNodalPoints; ++i)
        image.at(static_cast<std::size_t>(i)) =
            mirror.signs * pose.at(static_cast<std::size_t>(mirror.partner(i)));
    return image;
}

// A rotation turns the other way about the axes that lie in the plane.
glm::dquat reflected(const glm::dquat& q, const Mirror& mirror) {
    return {q.w, -mirror.signs.x * q.x, -mirror.signs.y * q.y, -mirror.signs.z * q.z};
}

NodeVectors blended(const NodeVectors& a, const NodeVectors& b, double shareOfB) {
    NodeVectors mean{};
    for (std::size_t i = 0; i < mean.size(); ++i) mean.at(i) = glm::mix(a.at(i), b.at(i), shareOfB);
    return mean;
}

// How a body frame is taken from a pose in the world.
using FrameOf = PoseFrame (*)(const NodeVectors&);

// The body frame turned level, about its origin: the roll and pitch of a fish that banks are in its
// pose.
PoseFrame levelFrameOf(const NodeVectors& pose) {
    constexpr glm::dvec3 kUp{0, 1, 0};
    PoseFrame frame = frameOf(pose);
    const glm::dvec3 z = glm::normalize(glm::cross(frame.worldFromBody[0], kUp));
    frame.worldFromBody = {glm::cross(kUp, z), kUp, z};
    return frame;
}

NodeVectors inFrame(const NodeVectors& pose, const PoseFrame& frame) {
    NodeVectors inside{};
    for (std::size_t i = 0; i < pose.size(); ++i)
        inside.at(i) = glm::transpose(frame.worldFromBody) * (pose.at(i) - frame.origin);
    return inside;
}

// Eq. 6-8, with the rotation in the body frame: R' = R * dR (the paper's eq. 6 is in world axes,
// which is right only for a fish that swims level).
FrameMotion frameMotionOf(const RecordedCycle& recording, FrameOf frameAt = frameOf) {
    assert(recording.poses.size() == kCount + 1);
    FrameMotion motion{.periodSeconds = recording.periodSeconds,
                       .playsToEnd = recording.playsToEnd,
                       .yawOffCourse = yawRadians(
                           recording.course, frameOf(recording.poses.front()).worldFromBody[0])};
    for (std::size_t k = 0; k <= kCount; ++k)
        motion.poses.at(k) = inFrame(recording.poses.at(k), frameAt(recording.poses.at(k)));
    if (!recording.fins.empty()) std::ranges::copy(recording.fins, motion.fins.begin());
    for (std::size_t k = 0; k < kCount; ++k) {
        const PoseFrame now = frameAt(recording.poses.at(k));
        const PoseFrame next = frameAt(recording.poses.at(k + 1));
        const glm::dmat3 bodyFromWorld = glm::transpose(now.worldFromBody);
        motion.rotation.at(k) = glm::normalize(glm::quat_cast(bodyFromWorld * next.worldFromBody));
        motion.translation.at(k) = bodyFromWorld * (next.origin - now.origin);
    }
    return motion;
}

// The mean of each phase and of the mirror image `later` phases on. A motion that has this symmetry
// then has it exactly; else the rounding errors of the simulation would add up over hours of
// repetition, and the fish would turn, drift, lean or climb.
FrameMotion symmetric(const FrameMotion& motion, const Mirror& mirror, std::size_t later) {
    FrameMotion even = motion;
    const auto afterwards = [&](std::size_t k) { return later == 0 ? k : (k + later) % kCount; };
    for (std::size_t k = 0; k <= kCount; ++k)
        even.poses.at(k) =
            blended(motion.poses.at(k), reflected(motion.poses.at(afterwards(k)), mirror), 0.5);
    for (std::size_t k = 0; k < kCount; ++k) {
        const std::size_t other = afterwards(k);
        even.rotation.at(k) =
            glm::normalize(motion.rotation.at(k) + reflected(motion.rotation.at(other), mirror));
        even.translation.at(k) =
            (motion.translation.at(k) + mirror.signs * motion.translation.at(other)) / 2.0;
    }
    return even;
}
FrameMotion planar(const FrameMotion& motion) {
    return symmetric(motion, kTopBottom, 0);
}
// The path alone is level; the poses stay as they are.
FrameMotion level(const FrameMotion& motion) {
    FrameMotion path = planar(motion);
    path.poses = motion.poses;
    return path;
}
// The same at any time: left and right move alike.
FrameMotion twinned(const FrameMotion& motion) {
    return symmetric(motion, kLeftRight, 0);
}
FrameMotion straightened(const FrameMotion& motion) {
    return symmetric(motion, kLeftRight, kCount / 2);
}

// Without the way of the whole cycle.
FrameMotion inPlace(const FrameMotion& motion) {
    glm::dvec3 way{};
    for (const glm::dvec3& step : motion.translation) way += step;
    FrameMotion still = motion;
    for (glm::dvec3& step : still.translation) step -= way / double{kCount};
    return still;
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
FrameMotion fadedIn(const FrameMotion& motion) {
    constexpr glm::dvec3 kUp{0, 1, 0};
    FrameMotion result = motion;
    for (std::size_t k = 0; k <= kCount; ++k) {
        for (std::size_t i = 0; i < std::size_t{body::kNodalPoints}; ++i)
            result.poses.at(k).at(i) +=
                fadeAt(k) * (motion.poses.back().at(i) - motion.poses.front().at(i));
        if (k == kCount) break;
        result.rotation.at(k) =
            motion.rotation.at(k) *
            glm::angleAxis(motion.yawOffCourse * (fadeAt(k) - fadeAt(k + 1)), kUp);
        result.translation.at(k) =
            glm::angleAxis(motion.yawOffCourse * fadeAt(k), kUp) * motion.translation.at(k);
    }
    return result;
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

// To units of kFinUnit; no fin turns by more than 3.2 radians.
motion::FinAngles quantisedAngles(const glm::dvec3& pose) {
    motion::FinAngles angles{};
    for (std::size_t c = 0; c < 3; ++c)
        angles.at(c) =
            static_cast<std::int16_t>(std::lround(std::clamp(pose[static_cast<int>(c)], -3.2, 3.2) /
                                                  static_cast<double>(motion::kFinUnit)));
    return angles;
}

// Back to body lengths. Control points are computed from the quantised nodes, since these are what
// a reader of the repertoire has.
body::NodalPoints nodesOf(const motion::NodalPose& pose) {
    body::NodalPoints nodes{};
    for (std::size_t i = 0; i < nodes.size(); ++i)
        nodes.at(i) = motion::kPoseUnit * glm::vec3(pose.at(i)[0], pose.at(i)[1], pose.at(i)[2]);
    return nodes;
}

motion::FrameIncrements incrementsOf(const FrameMotion& motion) {
    motion::FrameIncrements increments{};
    for (std::size_t k = 0; k < kCount; ++k)
        increments.at(k) = {glm::quat(motion.rotation.at(k)), glm::vec3(motion.translation.at(k))};
    return increments;
}

motion::ActionSegment segmentOf(const FrameMotion& motion) {
    motion::ActionSegment segment;
    segment.periodSeconds = static_cast<float>(motion.periodSeconds);
    segment.playsToEnd = motion.playsToEnd;
    segment.increments = incrementsOf(motion);
    for (std::size_t k = 0; k < kCount; ++k)
        std::ranges::transform(motion.poses.at(k), segment.nodes.at(k).begin(), quantised);
    for (std::size_t k = 0; k < kCount; ++k)
        std::ranges::transform(motion.fins.at(k), segment.fins.at(k).begin(), quantisedAngles);
    return segment;
}

void reflect(motion::FrameIncrements& increments, const Mirror& mirror) {
    for (motion::FrameIncrement& step : increments) {
        step.rotation = glm::quat(reflected(glm::dquat(step.rotation), mirror));
        step.translation *= glm::vec3(mirror.signs);
    }
}

motion::ActionSegment reflected(const motion::ActionSegment& segment, const Mirror& mirror) {
    motion::ActionSegment image = segment;
    reflect(image.increments, mirror);
    for (std::size_t k = 0; k < kCount; ++k)
        for (int i = 0; i < body::kNodalPoints; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                image.nodes.at(k).at(static_cast<std::size_t>(i)).at(c) = static_cast<std::int16_t>(
                    mirror.signs[static_cast<int>(c)] *
                    segment.nodes.at(k).at(static_cast<std::size_t>(mirror.partner(i))).at(c));
    // Left and right fins change places; upside down, they twist the other way.
    for (motion::FinAnglePair& fins : image.fins) {
        if (mirror.signs.z < 0) std::swap(fins[0], fins[1]);
        if (mirror.signs.y < 0)
            for (motion::FinAngles& fin : fins) fin[2] = static_cast<std::int16_t>(-fin[2]);
    }
    image.controlPoints.clear();
    return image;
}

}  // namespace

motion::ActionSegment compileForward(const RecordedCycle& recording) {
    return segmentOf(straightened(planar(frameMotionOf(recording))));
}

motion::ActionSegment compileRowed(const RecordedCycle& recording) {
    return segmentOf(twinned(level(frameMotionOf(recording))));
}

motion::ActionSegment compileRowedSlope(const RecordedCycle& recording) {
    return segmentOf(twinned(frameMotionOf(recording)));
}

motion::ActionSegment compileHover(const RecordedCycle& recording) {
    return segmentOf(inPlace(twinned(level(frameMotionOf(recording)))));
}

motion::ActionSegment compilePivot(const RecordedCycle& recording) {
    return segmentOf(inPlace(level(frameMotionOf(recording, levelFrameOf))));
}

motion::ActionSegment compilePitch(const RecordedCycle& recording) {
    return segmentOf(inPlace(twinned(frameMotionOf(recording))));
}

motion::ActionSegment compileCurve(const RecordedCycle& recording) {
    return segmentOf(level(frameMotionOf(recording, levelFrameOf)));
}

motion::ActionSegment compileSlope(const RecordedCycle& recording) {
    return segmentOf(straightened(frameMotionOf(recording)));
}

motion::ActionSegment compileLeftTurn(const RecordedCycle& recording) {
    return segmentOf(fadedIn(level(frameMotionOf(recording, levelFrameOf))));
}

motion::ActionSegment compileStart(const RecordedCycle& recording) {
    return segmentOf(planar(frameMotionOf(recording)));
}

namespace {

// A horizontal way as a direction in the body frame of a pose.
glm::vec3 directionIn(const NodeVectors& pose, const glm::dvec3& way) {
    const glm::dvec3 inBody = glm::transpose(frameOf(pose).worldFromBody) * way;
    return glm::vec3(glm::normalize(glm::dvec3(inBody.x, 0, inBody.z)));
}

// The rotation about the vertical from a horizontal direction to the body's x axis.
glm::dquat fromDirection(const glm::dvec3& direction) {
    return glm::normalize(glm::dquat(1 + direction.x, 0, direction.z, 0));
}

// The body frame at each phase, as seen from the course before a turn.
struct SeenFromCourse {
    std::array<glm::dquat, kCount + 1> rotation{};
    std::array<glm::dvec3, kCount + 1> translation{};
};
SeenFromCourse seenFromCourse(const motion::TurnPath& path) {
    SeenFromCourse seen;
    seen.rotation[0] = fromDirection(glm::dvec3(path.courseBefore));
    for (std::size_t k = 0; k < kCount; ++k) {
        const motion::FrameIncrement& step = path.increments.at(k);
        seen.translation.at(k + 1) =
            seen.translation.at(k) + seen.rotation.at(k) * glm::dvec3(step.translation);
        seen.rotation.at(k + 1) = glm::normalize(seen.rotation.at(k) * glm::dquat(step.rotation));
    }
    return seen;
}

}  // namespace

motion::TurnPath compileEntered(const EnteredTurn& entered, const SwimsOn& on) {
    assert(entered.secondsAfter > 0);
    const std::vector<NodeVectors>& poses = entered.turn.poses;
    // The law of motion::SpeedResponse, integrated. Where the fish is slower than p, its way is
    // p t + (v(0) - p) (1 - exp(-drag p t)) / (drag p). Where it is faster, with c = kExcessDrag,
    // the way beyond p t is log(1 + c (v(0) / p - 1) (1 - exp(-drag p t))) / (drag c).
    const double decayed = -std::expm1(-on.drag * on.speed * entered.secondsAfter);
    const double ahead = glm::length(entered.wayAfter) - on.speed * entered.secondsAfter;
    const auto excess = static_cast<double>(motion::kExcessDrag);
    const double faster =
        on.speed / decayed *
        (ahead > 0 ? std::expm1(on.drag * excess * ahead) / excess : on.drag * ahead);
    return {.courseBefore = directionIn(poses.front(), entered.turn.course),
            .speedBefore = static_cast<float>(entered.speedBefore),
            .courseAfter = directionIn(poses.back(), entered.wayAfter),
            .speedAfter = static_cast<float>(std::max(0.0, on.speed + faster)),
            .increments = incrementsOf(level(frameMotionOf(entered.turn, levelFrameOf)))};
}

motion::TurnPath blended(const motion::TurnPath& a, const motion::TurnPath& b) {
    const SeenFromCourse first = seenFromCourse(a);
    const SeenFromCourse second = seenFromCourse(b);
    const auto mean = [](const glm::vec3& u, const glm::vec3& v) { return glm::normalize(u + v); };
    motion::TurnPath between{.courseBefore = mean(a.courseBefore, b.courseBefore),
                             .speedBefore = (a.speedBefore + b.speedBefore) / 2,
                             .courseAfter = mean(a.courseAfter, b.courseAfter),
                             .speedAfter = (a.speedAfter + b.speedAfter) / 2,
                             .increments = {}};
    const auto rotation = [&](std::size_t k) {
        return glm::normalize(first.rotation.at(k) + second.rotation.at(k));
    };
    const auto place = [&](std::size_t k) {
        return (first.translation.at(k) + second.translation.at(k)) / 2.0;
    };
    for (std::size_t k = 0; k < kCount; ++k) {
        const glm::dquat back = glm::conjugate(rotation(k));
        between.increments.at(k) = {glm::quat(glm::normalize(back * rotation(k + 1))),
                                    glm::vec3(back * (place(k + 1) - place(k)))};
    }
    return between;
}

motion::TurnPath mirroredLeftRight(const motion::TurnPath& path) {
    motion::TurnPath image = path;
    image.courseBefore *= glm::vec3(kLeftRight.signs);
    image.courseAfter *= glm::vec3(kLeftRight.signs);
    reflect(image.increments, kLeftRight);
    return image;
}

motion::ActionSegment mirroredLeftRight(const motion::ActionSegment& segment) {
    return reflected(segment, kLeftRight);
}

motion::ActionSegment mirroredTopBottom(const motion::ActionSegment& segment) {
    return reflected(segment, kTopBottom);
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
