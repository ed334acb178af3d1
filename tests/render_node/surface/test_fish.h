// SPDX-License-Identifier: Apache-2.0
// A scad that sways, without the minutes of a capture: each action is a wave along the rest nodes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include "common/body/fish_body.h"
#include "common/config/species.h"
#include "common/motion/gaze.h"
#include "common/motion/reconstruct.h"
#include "common/motion/repertoire.h"
#include "render_node/surface/school_surface.h"

namespace aquarama::test {

inline body::FishBody scadBody() {
    return body::makeBody(config::readSpecies(std::string(AQUARAMA_SOURCE_DIR) +
                                              "/config/species/bigeye_scad.txtpb"));
}

// The body frame's origin is the body's centre, which lies so far behind the nose.
inline constexpr float kCentreStation = 0.385F;

inline body::NodalPoints sway(const body::FishBody& body,
                              float amplitude,
                              float bend,
                              float phase) {
    body::NodalPoints nodes = body.restNodes;
    for (glm::vec3& node : nodes) {
        const float s = -node.x;
        const float wave = std::sin(glm::two_pi<float>() * (s / 1.25F - phase));
        node.z += amplitude * s * s * wave + bend * (s - 0.4F) * (s - 0.4F);
        node.x += kCentreStation;
    }
    return nodes;
}

inline std::array<std::int16_t, 3> quantised(glm::vec3 point) {
    std::array<std::int16_t, 3> result{};
    for (int k = 0; k < 3; ++k)
        result.at(static_cast<std::size_t>(k)) = static_cast<std::int16_t>(
            std::lround(glm::clamp(point[k], -1.0F, 1.0F) / motion::kPoseUnit));
    return result;
}

// amplitude 0 gives a repertoire of the rest pose.
inline motion::Repertoire swaying(const body::FishBody& body, float amplitude) {
    motion::Repertoire repertoire;
    repertoire.species = body.species;
    repertoire.recordedLengthMetres = body.typicalLengthMetres;
    std::vector<glm::vec3> points(body::kControlPoints);
    for (std::size_t action = 0; action < motion::kActions; ++action) {
        motion::ActionSegment& segment = repertoire.segments.at(action);
        segment.periodSeconds = 0.4F;
        for (std::size_t k = 0; k < motion::kPhases; ++k) {
            const float bend = amplitude * (static_cast<float>(action % 24) - 3.0F);
            const body::NodalPoints nodes =
                sway(body, amplitude, bend, static_cast<float>(k) / motion::kPhases);
            for (std::size_t n = 0; n < body::kNodalPoints; ++n)
                segment.nodes.at(k).at(n) = quantised(nodes.at(n));
            body::poseCage(body, nodes, points);
            motion::ControlPointPose& pose = segment.controlPoints.emplace_back();
            for (std::size_t n = 0; n < body::kControlPoints; ++n)
                pose.at(n) = quantised(points[n]);
        }
    }
    return repertoire;
}

inline motion::PresentedFish fishAt(glm::vec3 place,
                                    const glm::quat& bodyToWorld,
                                    float length = 0.24F) {
    motion::PresentedFish fish;
    fish.positionMetres = place;
    fish.lengthMetres = length;
    fish.rotation = {bodyToWorld.x, bodyToWorld.y, bodyToWorld.z, bodyToWorld.w};
    return fish;
}

// The same as the wire has it: phases and weights are rounded to its units.
inline motion::FishRecord recordOf(const motion::PresentedFish& fish) {
    const glm::vec4& q = fish.rotation;
    motion::MotionStates states;
    states.resize(1);
    motion::setBodyFrame(states, 0, {fish.positionMetres, glm::quat(q.w, q.x, q.y, q.z)});
    motion::FishRecord record = motion::recordOf(states, 0);
    const auto cycle = [](float phase) {
        return static_cast<std::uint16_t>(std::lround(phase * 65536.0F));
    };
    record.phase = cycle(fish.phase);
    record.fromPhase = cycle(fish.fromPhase);
    record.segment = motion::firstSegmentOf(static_cast<motion::Action>(fish.action));
    record.fromSegment = motion::firstSegmentOf(static_cast<motion::Action>(fish.fromAction));
    record.speedAndSpread = motion::packedSpeedAndSpread(
        static_cast<std::int32_t>(std::lround(fish.speed * motion::kSpeedUnitsPerBodyLength)),
        static_cast<std::uint8_t>(std::lround(fish.spread * 255.0F)));
    record.mouth = static_cast<std::uint8_t>(std::lround(fish.mouth * 255.0F));
    record.gaze = motion::gazeTowards(fish.gaze);
    if (fish.warpWeight >= 1.0F) return record;
    record.warpLength = 254;
    const long weight = std::lround(fish.warpWeight * 255.0F);
    record.warpFrame = static_cast<std::uint8_t>(std::max(weight - 1, 0L));
    return record;
}

inline motion::FishTraits traitsOf(const motion::PresentedFish& fish) {
    return {fish.id, static_cast<std::uint16_t>(std::lround(1000.0F * fish.lengthMetres))};
}

struct RecordedSchool {
    explicit RecordedSchool(std::span<const motion::PresentedFish> fish) {
        for (const motion::PresentedFish& one : fish) {
            records.push_back(recordOf(one));
            traits.push_back(traitsOf(one));
        }
    }
    [[nodiscard]] surface::SchoolMoment moment() const { return {.before = {}, .after = records}; }
    std::vector<motion::FishRecord> records;
    std::vector<motion::FishTraits> traits;
};

}  // namespace aquarama::test
