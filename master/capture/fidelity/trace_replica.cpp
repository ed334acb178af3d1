// SPDX-License-Identifier: Apache-2.0
#include "master/capture/fidelity/replica.h"
#include "master/capture/fidelity/trace.h"

namespace aquarama::fidelity {

namespace {

template <class Before>
Trace traceOf(const motion::Repertoire& repertoire, const Script& script, Before beforeCommand) {
    Replica replica(repertoire);
    Trace trace{replica.point()};
    for (const ScriptCommand& command : script) {
        beforeCommand(replica, trace.size() - 1);
        replica.command(command.manoeuvre);
        for (int tick = 0; tick < command.ticks; ++tick) {
            replica.tick();
            trace.push_back(replica.point());
        }
    }
    return trace;
}

}  // namespace

Trace traceReplica(const motion::Repertoire& repertoire, const Script& script) {
    return traceOf(repertoire, script, [](Replica&, std::size_t) {});
}

Trace traceReplicaInPhase(const motion::Repertoire& repertoire,
                          const Script& script,
                          const Trace& fish) {
    return traceOf(repertoire, script, [&](Replica& replica, std::size_t tick) {
        replica.bringToPhaseOf(fish.at(tick).pose);
    });
}

Traces traceBoth(const config::Species& species,
                 const motion::Repertoire& repertoire,
                 const Script& script) {
    const Trace fish = traceFish(species, script);
    return {fish, traceReplicaInPhase(repertoire, script, fish), traceReplica(repertoire, script)};
}

}  // namespace aquarama::fidelity
