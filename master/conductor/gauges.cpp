// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/gauges.h"

#include <array>
#include <chrono>
#include <utility>

#include <glm/geometric.hpp>

namespace aquarama::conductor {
namespace {

// Of StatusReply.skew_counts.
constexpr std::array<net::Duration, 8> kSkewEdges{std::chrono::microseconds(50),
                                                  std::chrono::microseconds(100),
                                                  std::chrono::microseconds(200),
                                                  std::chrono::microseconds(500),
                                                  std::chrono::milliseconds(1),
                                                  std::chrono::milliseconds(2),
                                                  std::chrono::milliseconds(5),
                                                  std::chrono::milliseconds(10)};

v1::NodeCondition conditionOf(const NodeSeat& seat, bool isWaitedFor) {
    if (seat.peer.empty()) return v1::NODE_ABSENT;
    if (!seat.prepared) return v1::NODE_PREPARING;
    return isWaitedFor ? v1::NODE_IN_STEP : v1::NODE_LATE;
}

}  // namespace

Gauges::Gauges(const Roster& roster, std::uint16_t port)
    : metrics_{port},
      frameSeconds_{metrics_.histogram("aquarama_frame_seconds", "Time between two releases")},
      skewSeconds_{metrics_.histogram("aquarama_release_skew_seconds",
                                      "The last node's release of a frame minus the first's")},
      frames_{metrics_.counter("aquarama_frames_total", "Frames that were released")},
      fish_{metrics_.gauge("aquarama_fish", "Fish of the world")},
      bytes_{metrics_.counter("aquarama_state_bytes_total", "Bytes of states, once for all nodes")},
      refused_{metrics_.counter("aquarama_refused_packets_total", "Packets that were refused")},
      black_{metrics_.gauge("aquarama_black", "1 where the wall is black because it was set so")},
      journal_{figuresOfJournal()} {
    for (const NodeSeat& seat : roster.seats()) nodes_.push_back(figuresOf(seat));
}

NodeFigures Gauges::figuresOf(const NodeSeat& seat) {
    net::Metrics& m = metrics_;
    const net::Labels node{{"node", seat.name}};
    return {.condition = m.gauge(
                "aquarama_node_condition", "1 absent, 2 preparing, 3 in step, 4 late", node),
            .late = m.counter("aquarama_node_late_total", "Deadlines that it missed", node),
            .dropped = m.counter("aquarama_node_dropped_total", "Times it fell silent", node),
            .mismatches = m.counter("aquarama_node_hash_mismatches_total",
                                    "Steps after which its fish were others than the master's",
                                    node),
            .roundTrip = m.gauge(
                "aquarama_node_round_trip_seconds", "Median of its pings of ten seconds", node),
            .drift = m.gauge("aquarama_node_clock_drift_ppm",
                             "By which the master's clock is faster than its own",
                             node),
            .celsius = m.gauge("aquarama_node_gpu_celsius",
                               "Temperature of its graphics card; 0 where none is told",
                               node)};
}

JournalFigures Gauges::figuresOfJournal() {
    net::Metrics& m = metrics_;
    return {
        .written = m.gauge("aquarama_journal_written", "1 where the journal is written"),
        .saveAge = m.gauge("aquarama_journal_save_age_seconds", "Age of its newest save"),
        .file = m.gauge("aquarama_journal_file_bytes", "Bytes of the recording that grows"),
        .folder = m.gauge("aquarama_journal_bytes", "Bytes of all its recordings and saves"),
        .free = m.gauge("aquarama_journal_free_disk_bytes", "Free bytes of the disk that it is on"),
        .pauses = m.gauge("aquarama_journal_pauses", "Times this world's journal paused"),
        .late = m.gauge("aquarama_journal_late_inputs",
                        "Inputs of this world that took effect before the disk had them")};
}

void Gauges::released(net::Moment now, net::Duration interval) {
    frameTimes_.add(interval);
    framePeak_.add(now, interval);
    frameSeconds_(net::secondsIn(interval));
}

void Gauges::nodeReleased(net::Moment now, Frame frame, net::Moment at) {
    const auto skew = skew_.add(frame, at);
    if (!skew) return;
    skewSeconds_(net::secondsIn(*skew));
    skewPeak_.add(now, *skew);
}

void Gauges::published(const wire::StateView& state, std::size_t bytes) {
    publishedBytes_ += bytes;
    const double ticks =
        static_cast<double>(state.tick.value) - 1 + static_cast<double>(state.fraction);
    const double seconds = (ticks - std::exchange(eyeTicks_, ticks)) / kTicksPerSecond;
    const float metres = glm::distance(state.eye.positionMetres, eye_.positionMetres);
    speedMetresPerSecond_ = seconds > 0 ? metres / static_cast<float>(seconds) : 0.0F;
    eye_ = state.eye;
}

bool Gauges::count(net::Moment now,
                   const ShowReport& report,
                   std::uint32_t fish,
                   bool isBlack,
                   const Roster& roster,
                   const PresentBarrier& barrier) {
    if (now - lastCount_ < std::chrono::seconds(1)) return false;
    lastCount_ = now;
    frames_(static_cast<double>(report.frames));
    fish_(fish);
    bytes_(static_cast<double>(publishedBytes_));
    refused_(static_cast<double>(report.refusedPackets));
    black_(isBlack ? 1 : 0);
    for (std::size_t place = 0; place < nodes_.size(); ++place) {
        const NodeSeat& seat = roster.seats()[place];
        const NodeFigures& node = nodes_[place];
        node.condition(conditionOf(seat, barrier.isWaitedFor(place)));
        node.late(static_cast<double>(barrier.timesLate(place)));
        node.dropped(static_cast<double>(seat.dropped));
        node.mismatches(static_cast<double>(seat.mismatches));
        if (!seat.report) continue;
        node.roundTrip(static_cast<double>(seat.report->round_trip_median_ms()) / 1000);
        node.drift(static_cast<double>(seat.report->clock_drift_ppm()));
        node.celsius(static_cast<double>(seat.report->gpu_celsius()));
    }
    return true;
}

void Gauges::countJournal(const v1::JournalStatus& journal) const {
    journal_.written(journal.condition() == v1::JournalStatus::WRITTEN ? 1 : 0);
    journal_.saveAge(journal.save_age_s());
    journal_.file(static_cast<double>(journal.file_bytes()));
    journal_.folder(static_cast<double>(journal.folder_bytes()));
    journal_.free(static_cast<double>(journal.free_disk_bytes()));
    journal_.pauses(static_cast<double>(journal.pauses()));
    journal_.late(static_cast<double>(journal.late_inputs()));
}

void Gauges::writeStatus(v1::StatusReply& reply,
                         const ShowReport& report,
                         const Roster& roster,
                         const PresentBarrier& barrier) const {
    reply.set_tick(report.tick.value);
    reply.set_frame_median_ms(frameTimes_.quantileMs(0.5));
    reply.set_frame_p99_ms(frameTimes_.quantileMs(0.99));
    reply.set_frame_peak_ms(framePeak_.ms());
    reply.set_skew_peak_ms(skewPeak_.ms());
    reply.set_skew_median_ms(skew_.skews().quantileMs(0.5));
    reply.set_skew_p99_ms(skew_.skews().quantileMs(0.99));
    for (const std::uint32_t count : skew_.skews().countsUpTo(kSkewEdges))
        reply.add_skew_counts(count);
    reply.set_refused_packets(report.refusedPackets);
    wire::writeEye(eye_, *reply.mutable_eye());
    reply.set_speed_m_s(speedMetresPerSecond_);
    for (std::size_t place = 0; place < roster.seats().size(); ++place) {
        const NodeSeat& seat = roster.seats()[place];
        v1::NodeStatus& node = *reply.add_nodes();
        node.set_name(seat.name);
        node.set_condition(conditionOf(seat, barrier.isWaitedFor(place)));
        node.set_late(barrier.timesLate(place));
        node.set_dropped(seat.dropped);
        node.set_hash_mismatches(seat.mismatches);
        node.set_machine(seat.machine);
        node.set_picture_ms(seat.pictures.ms());
        if (seat.report) *node.mutable_report() = *seat.report;
    }
}

bool Watchdog::isAlive(net::Moment now, std::optional<Tick> newest, bool isStill) {
    constexpr net::Duration kLongestTick = std::chrono::seconds(2);
    if (isStill || newest != std::exchange(lastTick_, newest)) lastTickAt_ = now;
    return now - lastTickAt_ < kLongestTick;
}

}  // namespace aquarama::conductor
