// SPDX-License-Identifier: Apache-2.0
#include "common/motion/reconstruct.h"

#include "common/motion/gaze.h"
#include "common/motion/repertoire.h"

namespace aquarama::motion {
namespace {

// Cycles in a unit of a recorded phase.

// A point of a pose in body lengths.
glm::vec3 lengthsOf(const std::array<std::int16_t, 3>& point) {
    return glm::vec3(point[0], point[1], point[2]) * kPoseUnit;
}

// Point i of a cycle of poses at a phase, body lengths.
template <class Poses>
glm::vec3 pointAt(const Poses& poses, const PhaseSample& sample, std::size_t i) {
    return glm::mix(
        lengthsOf(poses[sample.before][i]), lengthsOf(poses[sample.after][i]), sample.share);
}

// The share of the new segment in a warp: from 1 / (K + 1) at its first frame to 1 when it is over.
float weightOf(const FishRecord& record) {
    return static_cast<float>(record.warpFrame + 1) / static_cast<float>(record.warpLength + 1);
}

// One coordinate between two ticks, in metres. The difference is taken in 64 bits, where it cannot
// overflow.
float metres(std::int32_t before, std::int32_t after, float fraction) {
    const auto step = static_cast<float>(static_cast<std::int64_t>(after) - before);
    return (static_cast<float>(before) + fraction * step) * kPositionUnitMetres;
}

// Between two phases, in cycles, [0, 1).
float presentedPhase(std::uint16_t before, std::uint16_t after, float fraction) {
    const auto played = static_cast<std::uint16_t>(after - before);
    const float phase = static_cast<float>(before) + fraction * static_cast<float>(played);
    return (phase < 65536.0F ? phase : phase - 65536.0F) * kPhaseUnit;
}

// In this tick the fish left its segment for a warp: it goes on from the pose in which it was last
// seen.
bool hasJustLeft(const FishRecord& before, const FishRecord& after) {
    return after.warpFrame == 0 && before.segment == after.fromSegment &&
           before.phase == after.fromPhase && before.segment != after.segment &&
           before.warpFrame == before.warpLength;
}

// Segment, phase and warp weight of the presented fish.
void pose(const FishRecord& before, const FishRecord& after, float fraction, PresentedFish& fish) {
    fish.action = static_cast<std::uint32_t>(actionOf(after.segment));
    fish.fromAction = static_cast<std::uint32_t>(actionOf(after.fromSegment));
    fish.fromPhase = static_cast<float>(after.fromPhase) * kPhaseUnit;
    fish.phase = static_cast<float>(after.phase) * kPhaseUnit;
    fish.warpWeight = weightOf(after);
    if (hasJustLeft(before, after)) {
        fish.warpWeight *= fraction;
    } else if (before.segment == after.segment) {
        fish.phase = presentedPhase(before.phase, after.phase, fraction);
        fish.warpWeight = glm::mix(weightOf(before), weightOf(after), fraction);
    }
}

// Linear interpolation of the nearer quaternions, normalised; two ticks differ by little.
glm::vec4 presentedRotation(const glm::quat& before, const glm::quat& after, float fraction) {
    const glm::quat near = glm::dot(before, after) < 0.0F ? -after : after;
    const glm::quat q = glm::normalize(before * (1.0F - fraction) + near * fraction);
    return {q.x, q.y, q.z, q.w};
}

}  // namespace

PresentedFish present(const FishRecord& before,
                      const FishRecord& after,
                      float fraction,
                      const FishTraits& traits) {
    // A fish that goes or comes between the two ticks is shown away, not half-way.
    if (isAway(before) != isAway(after)) {
        const FishRecord& away = isAway(before) ? before : after;
        return present(away, away, fraction, traits);
    }
    PresentedFish fish;
    fish.positionMetres = {metres(before.x, after.x, fraction),
                           metres(before.y, after.y, fraction),
                           metres(before.z, after.z, fraction)};
    fish.lengthMetres = static_cast<float>(traits.lengthMillimetres) * 0.001F;
    fish.rotation =
        presentedRotation(bodyFrameOf(before).rotation, bodyFrameOf(after).rotation, fraction);
    fish.id = traits.id;
    const auto speedUnits =
        glm::mix(static_cast<float>(speedOf(before)), static_cast<float>(speedOf(after)), fraction);
    fish.speed = speedUnits / kSpeedUnitsPerBodyLength;
    const auto spread = glm::mix(
        static_cast<float>(spreadOf(before)), static_cast<float>(spreadOf(after)), fraction);
    fish.spread = spread / 255.0F;
    fish.gaze = glm::mix(directionOf(before.gaze), directionOf(after.gaze), fraction);
    fish.mouth =
        glm::mix(static_cast<float>(before.mouth), static_cast<float>(after.mouth), fraction) /
        255.0F;
    pose(before, after, fraction, fish);
    return fish;
}

void nodalPose(const Repertoire& repertoire, const PresentedFish& fish, body::NodalPoints& nodes) {
    const ActionSegment& to = segmentOf(repertoire, fish.action);
    const ActionSegment& from = segmentOf(repertoire, fish.fromAction);
    const PhaseSample toSample = sampleAt(fish.phase);
    const PhaseSample fromSample = sampleAt(fish.fromPhase);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        nodes[i] = pointAt(to.nodes, toSample, i);
        if (fish.warpWeight < 1.0F)
            nodes[i] = glm::mix(pointAt(from.nodes, fromSample, i), nodes[i], fish.warpWeight);
    }
}

std::array<body::FinPose, 2> finPoses(const Repertoire& repertoire, const PresentedFish& fish) {
    std::array<body::FinPose, 2> poses;
    const auto posed = [](const ActionSegment& segment, float phase, std::size_t side) {
        const PhaseSample sample = sampleAt(phase);
        const auto at = [&](std::size_t k) {
            const FinAngles& angles = segment.fins[k][side];
            return glm::vec3(angles[0], angles[1], angles[2]) * kFinUnit;
        };
        return glm::mix(at(sample.before), at(sample.after), sample.share);
    };
    for (std::size_t side = 0; side < poses.size(); ++side) {
        glm::vec3 pose = posed(segmentOf(repertoire, fish.action), fish.phase, side);
        if (fish.warpWeight < 1.0F)
            pose = glm::mix(posed(segmentOf(repertoire, fish.fromAction), fish.fromPhase, side),
                            pose,
                            fish.warpWeight);
        poses[side] = {pose.x, pose.y, pose.z};
    }
    return poses;
}

}  // namespace aquarama::motion
