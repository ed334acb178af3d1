// SPDX-License-Identifier: Apache-2.0
#include "tests/render_node/surface/living_cage.h"

#include <array>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include "common/body/fins.h"
#include "common/motion/repertoire.h"

namespace aquarama::test {

namespace {

struct CagePose {
    std::array<glm::vec3, body::kControlPoints> points{};
    std::array<float, body::kControlPoints> headings{};
    std::array<float, body::kControlPoints> drift{};  // to the right, body lengths in a radian
};

void recordedPose(const body::FishBody& body,
                  const motion::ActionSegment& segment,
                  std::size_t phase,
                  CagePose& pose) {
    body::NodalPoints nodes{};
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const auto& [x, y, z] = segment.nodes.at(phase).at(n);
        nodes.at(n) = glm::vec3(x, y, z) * motion::kPoseUnit;
    }
    body::headingsOf(body, nodes, pose.headings);
    if (segment.controlPoints.empty()) return body::poseCage(body, nodes, pose.points);
    for (std::size_t i = 0; i < pose.points.size(); ++i) {
        const auto& [x, y, z] = segment.controlPoints[phase].at(i);
        pose.points.at(i) = glm::vec3(x, y, z) * motion::kPoseUnit;
    }
}

CagePose mixed(const CagePose& a, const CagePose& b, float share) {
    CagePose pose;
    for (std::size_t i = 0; i < pose.points.size(); ++i) {
        pose.points.at(i) = glm::mix(a.points.at(i), b.points.at(i), share);
        pose.headings.at(i) = glm::mix(a.headings.at(i), b.headings.at(i), share);
        pose.drift.at(i) = glm::mix(a.drift.at(i), b.drift.at(i), share);
    }
    return pose;
}

CagePose poseAt(const body::FishBody& body, const motion::ActionSegment& segment, float phase) {
    const motion::PhaseSample sample = motion::sampleAt(phase);
    CagePose before, after;
    recordedPose(body, segment, sample.before, before);
    recordedPose(body, segment, sample.after, after);
    CagePose pose = mixed(before, after, sample.share);
    constexpr float kRadians =
        glm::two_pi<float>() / motion::kPhases;  // from one phase to the next
    for (std::size_t i = 0; i < pose.points.size(); ++i)
        pose.drift.at(i) = glm::dot(after.points.at(i) - before.points.at(i),
                                    body::turned({0, 0, 1}, pose.headings.at(i))) /
                           kRadians;
    return pose;
}

body::FinDrive driveOf(const motion::Repertoire& repertoire,
                       const motion::PresentedFish& fish,
                       float seconds) {
    const auto [left, right] = motion::finPoses(repertoire, fish);
    const glm::quat rotation(fish.rotation.w, fish.rotation.x, fish.rotation.y, fish.rotation.z);
    const float wrapped = seconds - body::kFinSeconds * std::floor(seconds / body::kFinSeconds);
    return {.seconds = wrapped,
            .speed = fish.speed,
            .tilt = (rotation * glm::vec3(0, 0, 1)).y,
            .spread = fish.spread,
            .left = left,
            .right = right,
            .face = body::facePose({.seconds = wrapped,
                                    .lengthMetres = fish.lengthMetres,
                                    .speed = fish.speed,
                                    .spread = fish.spread,
                                    .mouth = fish.mouth,
                                    .id = fish.id}),
            .id = fish.id,
            .phase = fish.phase,
            .fromPhase = fish.fromPhase,
            .weight = fish.warpWeight};
}

}  // namespace

void livingCage(const body::FishBody& body,
                const motion::Repertoire& repertoire,
                const motion::PresentedFish& fish,
                float seconds,
                std::span<glm::vec3> points) {
    CagePose pose = poseAt(body, motion::segmentOf(repertoire, fish.action), fish.phase);
    if (fish.warpWeight < 1.0F)
        pose = mixed(poseAt(body, motion::segmentOf(repertoire, fish.fromAction), fish.fromPhase),
                     pose,
                     fish.warpWeight);
    const body::FinDrive drive = driveOf(repertoire, fish, seconds);
    const glm::quat rotation(fish.rotation.w, fish.rotation.x, fish.rotation.y, fish.rotation.z);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::vec3 offset = body::finOffset(body.fins, i, drive, pose.drift.at(i));
        const glm::vec3 place = pose.points.at(i) + body::turned(offset, pose.headings.at(i));
        points[i] = fish.positionMetres + rotation * (fish.lengthMetres * place);
    }
}

}  // namespace aquarama::test
