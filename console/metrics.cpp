// SPDX-License-Identifier: Apache-2.0
#include "console/metrics.h"

#include "common/net/metrics.h"

namespace aquarama::console {

namespace {

// The figures with the same labels: those of the wall, of one node or of one projector.
struct Figures {
    void gauge(const std::string& name, const std::string& help, double value) const {
        metrics.gauge("aquarama_console_" + name, help, labels)(value);
    }
    void counter(const std::string& name, const std::string& help, std::uint64_t total) const {
        metrics.counter("aquarama_console_" + name, help, labels)(static_cast<double>(total));
    }

    net::Metrics& metrics;
    net::Labels labels = {};
};

void addWall(const Figures& wall, const browser::Wall& from) {
    const v1::StatusReply& status = from.status();
    wall.gauge("master_answers", "1 where the master answers", from.heard());
    wall.gauge("frame", "Number of the last frame", static_cast<double>(status.frame()));
    wall.gauge("frame_median_ms", "Time between two releases, median", status.frame_median_ms());
    wall.gauge("skew_p99_ms",
               "The last node's release of a frame minus the first's, 99 %",
               status.skew_p99_ms());
    wall.gauge("black", "1 where the wall is black because it was set so", status.show().black());
    wall.gauge("browsers", "Browsers that are connected", from.watching());
    wall.counter("refused_requests_total", "Requests that were refused", from.refused_requests());
}

void addNode(const Figures& node, const v1::NodeStatus& from) {
    node.gauge("node_in_step", "1 where the node is in step", from.condition() == v1::NODE_IN_STEP);
    node.counter("node_late_total", "Deadlines that it missed", from.late());
    node.counter("node_dropped_total", "Times it fell silent", from.dropped());
    node.counter("node_hash_mismatches_total",
                 "Steps after which its fish were others than the master's",
                 from.hash_mismatches());
    node.gauge("node_picture_median_ms",
               "From a frame's state to its finished picture, median",
               from.report().picture_median_ms());
    node.gauge("node_gpu_celsius",
               "Temperature of its graphics card; 0 where none is told",
               from.report().gpu_celsius());
}

void addProjector(const Figures& projector, const browser::ProjectorState& from) {
    projector.gauge("projector_answers", "1 where it answers", from.reach() == "answers");
    if (from.power() != "unknown")
        projector.gauge("projector_on", "1 where its lamp is on", from.power() == "on");
    if (from.has_shut())
        projector.gauge("projector_shut", "1 where its shutter is shut", from.shut());
    if (from.has_lamp_hours())
        projector.gauge("projector_lamp_hours", "Hours of its lamp", from.lamp_hours());
    if (from.tells_problems())
        projector.gauge("projector_problems", "Problems that it tells", from.problems_size());
}

void addOwn(const Figures& console, const OwnFigures& own) {
    console.counter("cut_off_connections_total", "Connections that were cut off", own.cutOff);
    console.gauge("clock_wrong", "1 where this machine's clock is in doubt", own.isClockWrong);
    if (own.certificateDays)
        console.gauge("certificate_days", "Days until the certificate ends", *own.certificateDays);
    if (!own.cues) return;
    console.counter("cues_total", "Orders that cues gave", own.cues->given);
    console.counter("refused_cues_total", "Cues that were refused", own.cues->refused);
    console.counter("dropped_cues_total", "Packets of strangers", own.cues->strangers);
}

}  // namespace

// A set of figures for this one answer: a gauge that is no longer known would stay in a lasting
// one.
std::string metricsOf(const browser::Wall& wall,
                      const browser::ProjectorList& projectors,
                      const OwnFigures& own) {
    net::Metrics metrics{0};
    addWall({metrics}, wall);
    addOwn({metrics}, own);
    for (const v1::NodeStatus& node : wall.status().nodes())
        addNode({metrics, {{"node", node.name()}}}, node);
    for (const browser::ProjectorState& one : projectors.projectors())
        addProjector({metrics, {{"projector", one.name()}}}, one);
    return metrics.text();
}

}  // namespace aquarama::console
