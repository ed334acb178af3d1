// SPDX-License-Identifier: Apache-2.0
#include "master/capture/fidelity/replica.h"

#include <cmath>
#include <limits>

#include <glm/gtc/quaternion.hpp>

#include "common/motion/phase_sample.h"
#include "common/motion/reconstruct.h"

namespace aquarama::fidelity {

namespace {

constexpr std::array kTraits{motion::FishTraits{.id = 0, .lengthMillimetres = 1000}};

motion::Action actionOf(Manoeuvre manoeuvre) {
    switch (manoeuvre) {
        case Manoeuvre::Ascend:
        case Manoeuvre::Descend:
        case Manoeuvre::Balance:
            return motion::Action::ForwardMedium;
        case Manoeuvre::Brake:
            return motion::Action::Glide;
        case Manoeuvre::Retreat:
            return motion::Action::ForwardSlow;  // backwards
        default:
            return static_cast<motion::Action>(manoeuvre);
    }
}

double pitchOf(Manoeuvre manoeuvre) {
    return manoeuvre == Manoeuvre::Ascend    ? kScriptPitchRadians
           : manoeuvre == Manoeuvre::Descend ? -kScriptPitchRadians
                                             : 0;
}

std::uint16_t nearestPhase(const motion::ActionSegment& segment, const capture::NodeVectors& pose) {
    constexpr int kFiner = 4;
    std::uint16_t nearest = 0;
    double least = std::numeric_limits<double>::max();
    for (int i = 0; i < kFiner * motion::kPhases; ++i) {
        const motion::PhaseSample sample =
            motion::sampleAt(static_cast<float>(i) / (kFiner * motion::kPhases));
        double sum = 0;
        for (std::size_t node = 0; node < pose.size(); ++node) {
            const auto at = [&](std::size_t k) {
                const auto& point = segment.nodes[k][node];
                return glm::dvec3(point[0], point[1], point[2]) *
                       static_cast<double>(motion::kPoseUnit);
            };
            const glm::dvec3 off =
                glm::mix(at(sample.before), at(sample.after), static_cast<double>(sample.share)) -
                pose[node];
            sum += glm::dot(off, off);
        }
        if (sum >= least) continue;
        least = sum;
        nearest = static_cast<std::uint16_t>(i * (65536 / (kFiner * motion::kPhases)));
    }
    return nearest;
}

}  // namespace

Replica::Replica(const motion::Repertoire& repertoire)
    : repertoire_(repertoire), tables_(motion::makeMotorTables(repertoire)) {
    states_.resize(1);
    commands_.resize(1);
    motion::setBodyFrame(states_, 0, {});
    states_.segment[0] = static_cast<std::uint8_t>(motion::Action::ForwardMedium);
    motion::setSpeedBodyLengths(
        states_, 0, motion::recordedSpeedBodyLengths(*tables_, motion::Action::ForwardMedium));
}

void Replica::command(Manoeuvre manoeuvre) {
    play(actionOf(manoeuvre), manoeuvre == Manoeuvre::Retreat ? -1 : 1);
    commands_.brake[0] = manoeuvre == Manoeuvre::Brake ? 255 : 0;
    commands_.pitch[0] =
        static_cast<std::int16_t>(std::lround(std::sin(pitchOf(manoeuvre)) * 32768));
}

void Replica::play(motion::Action action, double tempo) {
    commands_.segment[0] = static_cast<std::uint8_t>(action);
    commands_.phaseRate[0] =
        static_cast<std::int16_t>(std::lround(tempo * motion::recordedPhaseRate(*tables_, action)));
}

void Replica::tick() {
    motion::MotorStep{.tables = tables_.get(),
                      .traits = kTraits,
                      .commands = &commands_,
                      .states = &states_,
                      .first = 0,
                      .last = 1}
        .run();
}

void Replica::learn(motion::Action action, const motion::ActionSegment& segment) {
    repertoire_.segments.at(static_cast<std::size_t>(action)) = segment;
    tables_ = motion::makeMotorTables(repertoire_);
}

void Replica::bringToPhaseOf(const capture::NodeVectors& pose) {
    const motion::ActionSegment& segment = repertoire_.segments.at(states_.segment[0]);
    const bool warps = states_.warpFrame[0] != states_.warpLength[0];
    if (warps || segment.playsToEnd || playing() == motion::Action::Glide) return;
    const glm::quat course = motion::meanRotation(*tables_, states_, 0);
    states_.phase[0] = nearestPhase(segment, pose);
    const glm::quat shifted = motion::meanRotation(*tables_, states_, 0);
    motion::BodyFrame frame = motion::bodyFrameOf(states_, 0);
    frame.rotation = course * glm::conjugate(shifted) * frame.rotation;
    motion::setBodyFrame(states_, 0, frame);
}

TracePoint Replica::point() const {
    const motion::FishRecord record = motion::recordOf(states_, 0);
    body::NodalPoints nodes;
    motion::nodalPose(repertoire_, motion::present(record, record, 1.0F, kTraits[0]), nodes);
    const motion::BodyFrame frame = motion::bodyFrameOf(record);
    TracePoint point{.frame = {glm::dvec3(frame.position),
                               glm::mat3_cast(glm::normalize(glm::dquat(frame.rotation)))}};
    for (std::size_t i = 0; i < nodes.size(); ++i) point.pose.at(i) = nodes.at(i);
    return point;
}

}  // namespace aquarama::fidelity
