// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <limits>

#include <glm/gtc/quaternion.hpp>

#include "common/motion/motor.h"
#include "common/motion/phase_sample.h"
#include "common/motion/reconstruct.h"
#include "master/capture/fidelity/trace.h"

namespace aquarama {

namespace {

// A body length of one metre: the finest that positions on the wire can be in body lengths.
constexpr FishTraits kTraits{.id = 0, .lengthMillimetres = 1000};

std::uint16_t nearestPhase(const ActionSegment& segment, const NodeVectors& pose) {
    constexpr int kFiner = 4;
    std::uint16_t nearest = 0;
    double least = std::numeric_limits<double>::max();
    for (int i = 0; i < kFiner * kPhases; ++i) {
        const PhaseSample sample = sampleAt(static_cast<float>(i) / (kFiner * kPhases));
        double sum = 0;
        for (std::size_t node = 0; node < pose.size(); ++node) {
            const auto at = [&](std::size_t k) {
                const auto& point = segment.nodes[k][node];
                return glm::dvec3(point[0], point[1], point[2]) * static_cast<double>(kPoseUnit);
            };
            const glm::dvec3 off =
                glm::mix(at(sample.before), at(sample.after), static_cast<double>(sample.share)) -
                pose[node];
            sum += glm::dot(off, off);
        }
        if (sum >= least) continue;
        least = sum;
        nearest = static_cast<std::uint16_t>(i * (65536 / (kFiner * kPhases)));
    }
    return nearest;
}

class Replica {
  public:
    explicit Replica(const Repertoire& repertoire)
        : repertoire_(repertoire), tables_(makeMotorTables(repertoire)) {
        states_.resize(1);
        commands_.resize(1);
        setBodyFrame(states_, 0, {});
        states_.segment[0] = static_cast<std::uint8_t>(Action::ForwardMedium);
    }

    void command(Manoeuvre manoeuvre) {
        play(actionOf(manoeuvre));
        const double pitch = manoeuvre == Manoeuvre::Ascend    ? kScriptPitchRadians
                             : manoeuvre == Manoeuvre::Descend ? -kScriptPitchRadians
                                                               : 0;
        commands_.pitch[0] = static_cast<std::int16_t>(std::lround(std::sin(pitch) * 32768));
    }

    void tick() {
        MotorStep{.tables = tables_.get(),
                  .traits = traits_,
                  .commands = &commands_,
                  .states = &states_,
                  .first = 0,
                  .last = 1}
            .run();
    }

    // Changes the phase of a gait to that whose pose is nearest; the mean frame stays where it is.
    void bringToPhaseOf(const NodeVectors& pose) {
        const auto action = states_.segment[0];
        const bool warps = states_.warpFrame[0] != states_.warpLength[0];
        if (warps || action > static_cast<std::uint8_t>(Action::ForwardFast)) return;
        const glm::quat course = meanRotation(*tables_, states_, 0);
        states_.phase[0] = nearestPhase(repertoire_.segments.at(action), pose);
        const glm::quat shifted = meanRotation(*tables_, states_, 0);
        BodyFrame frame = bodyFrameOf(states_, 0);
        frame.rotation = course * glm::conjugate(shifted) * frame.rotation;
        setBodyFrame(states_, 0, frame);
    }

    [[nodiscard]] TracePoint point() const {
        const FishRecord record = recordOf(states_, 0);
        NodalPoints nodes;
        nodalPose(repertoire_, present(record, record, 1.0F, kTraits), nodes);
        TracePoint point;
        for (std::size_t i = 0; i < nodes.size(); ++i) point.pose[i] = nodes[i];
        const BodyFrame frame = bodyFrameOf(record);
        point.frame = {glm::dvec3(frame.position),
                       glm::mat3_cast(glm::normalize(glm::dquat(frame.rotation)))};
        return point;
    }

  private:
    static Action actionOf(Manoeuvre manoeuvre) {
        switch (manoeuvre) {
            case Manoeuvre::Ascend:
            case Manoeuvre::Descend:
                return Action::ForwardMedium;
            case Manoeuvre::Brake:
                return Action::Glide;
            case Manoeuvre::Retreat:
                return Action::ForwardSlow;
            default:
                return static_cast<Action>(manoeuvre);
        }
    }

    void play(Action action) {
        commands_.segment[0] = static_cast<std::uint8_t>(action);
        commands_.phaseRate[0] = recordedPhaseRate(*tables_, action);
    }

    const Repertoire& repertoire_;
    std::shared_ptr<const MotorTables> tables_;
    std::array<FishTraits, 1> traits_{kTraits};
    MotionStates states_;
    MotorCommands commands_;
};

template <class Before>
Trace traceOf(const Repertoire& repertoire, const Script& script, Before beforeCommand) {
    Replica replica(repertoire);
    Trace trace{replica.point()};
    for (const auto& [manoeuvre, ticks] : script) {
        beforeCommand(replica, trace.size() - 1);
        replica.command(manoeuvre);
        for (int tick = 0; tick < ticks; ++tick) {
            replica.tick();
            trace.push_back(replica.point());
        }
    }
    return trace;
}

}  // namespace

Trace traceReplica(const Repertoire& repertoire, const Script& script) {
    return traceOf(repertoire, script, [](Replica&, std::size_t) {});
}

Trace traceReplicaInPhase(const Repertoire& repertoire, const Script& script, const Trace& fish) {
    return traceOf(repertoire, script, [&](Replica& replica, std::size_t tick) {
        replica.bringToPhaseOf(fish.at(tick).pose);
    });
}

Traces traceBoth(const Species& species, const Repertoire& repertoire, const Script& script) {
    const Trace fish = traceFish(species, script);
    return {fish, traceReplicaInPhase(repertoire, script, fish), traceReplica(repertoire, script)};
}

}  // namespace aquarama
