// SPDX-License-Identifier: Apache-2.0
// What a fish did, tick by tick: the common ground on which the biomechanical fish and its replica
// are compared.
#pragma once

#include <span>
#include <vector>

#include "common/config/species.h"
#include "common/motion/repertoire.h"
#include "master/capture/control/swimmer.h"
#include "master/capture/dynamics/body_frame.h"
#include "master/capture/fidelity/script.h"

namespace aquarama::fidelity {

struct TracePoint {
    capture::PoseFrame frame;     // in the world, body lengths
    capture::NodeVectors pose{};  // nodal points in the body frame, body lengths (eq. 8)
};

// One more than the ticks: the first is before the first command.
using Trace = std::vector<TracePoint>;

struct TimedOrder {
    capture::Order order;
    int ticks = 0;
};

// The biomechanical fish follows the script, after it has swum from rest at medium speed until it
// swims steadily and its beat begins anew.
[[nodiscard]] Trace traceFish(const config::Species& species, std::span<const TimedOrder> orders);
[[nodiscard]] Trace traceFish(const config::Species& species, const Script& script);

// The replica follows the script, from phase 0 of forward_medium and at its speed.
[[nodiscard]] Trace traceReplica(const motion::Repertoire& repertoire, const Script& script);
// The same, but where a command finds it swimming, its beat is first brought to the phase of the
// fish's, its course kept: so that each command begins alike for both.
[[nodiscard]] Trace traceReplicaInPhase(const motion::Repertoire& repertoire,
                                        const Script& script,
                                        const Trace& fish);

struct Traces {
    Trace fish;
    Trace replica;       // brought into phase at each command
    Trace looseReplica;  // left alone from the first command to the last
};
[[nodiscard]] Traces traceBoth(const config::Species& species,
                               const motion::Repertoire& repertoire,
                               const Script& script);

}  // namespace aquarama::fidelity
