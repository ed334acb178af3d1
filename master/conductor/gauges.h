// SPDX-License-Identifier: Apache-2.0
// What a show measures of itself: its figures for Prometheus and its status; and the watchdog, by
// which a service manager knows that it is alive.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/net/metrics.h"
#include "common/wire/messages.h"
#include "common/wire/state_codec.h"
#include "master/conductor/present_barrier.h"
#include "master/conductor/roster.h"

namespace aquarama::conductor {

// What a show came to.
struct ShowReport {
    std::uint64_t frames = 0;  // presented
    Tick tick;                 // the last that was shown
    std::uint64_t worldHash = 0;
    std::uint64_t refusedPackets = 0;
};

// The series of one node, and those of the journal.
struct NodeFigures {
    net::Record condition, late, dropped, mismatches, roundTrip, drift, celsius;
};
struct JournalFigures {
    net::Record written, saveAge, file, folder, free, pauses, late;
};

// Of the conductor's thread.
class Gauges {
  public:
    // `port`: on which Prometheus may ask; 0: it may not. Throws Error where it is occupied.
    Gauges(const Roster& roster, std::uint16_t port);

    // A frame is released `interval` after the one before.
    void released(net::Moment now, net::Duration interval);
    // A node released this frame at a moment of the master's clock.
    void nodeReleased(net::Moment now, Frame frame, net::Moment at);
    // A state of so many bytes is published.
    void published(const wire::StateView& state, std::size_t bytes);
    // Where the eye was in the last state that was published.
    [[nodiscard]] const wire::Eye& eye() const { return eye_; }

    // For Prometheus; once a second, else nothing. True: it has counted.
    bool count(net::Moment now,
               const ShowReport& report,
               std::uint32_t fish,
               bool isBlack,
               const Roster& roster,
               const PresentBarrier& barrier);
    // The same of the journal; as often as count() has counted.
    void countJournal(const v1::JournalStatus& journal) const;
    // All of a status reply but pace, frame, show, change and journal.
    void writeStatus(v1::StatusReply& reply,
                     const ShowReport& report,
                     const Roster& roster,
                     const PresentBarrier& barrier) const;

  private:
    [[nodiscard]] NodeFigures figuresOf(const NodeSeat& seat);
    [[nodiscard]] JournalFigures figuresOfJournal();

    net::Metrics metrics_;
    net::Record frameSeconds_, skewSeconds_, frames_, fish_, bytes_, refused_, black_;
    std::vector<NodeFigures> nodes_;
    JournalFigures journal_;
    net::RecentTimes frameTimes_;
    net::RecentPeak framePeak_, skewPeak_;
    SkewMeter skew_;
    wire::Eye eye_;
    double eyeTicks_ = 0;  // when it was there, in ticks and parts of them
    float speedMetresPerSecond_ = 0;
    std::uint64_t publishedBytes_ = 0;
    net::Moment lastCount_{};
};

// Tells whether the show is alive, which it is as long as ticks come: a tick that does not come is
// a hang of this process too. The service manager restarts a show that is not.
class Watchdog {
  public:
    // At each turn of the frame loop. `newest`: the last tick that has come; nothing: none has.
    // `isStill`: no tick has to come, as the world stands still. False: none has come for two
    // seconds.
    [[nodiscard]] bool isAlive(net::Moment now, std::optional<Tick> newest, bool isStill);

  private:
    std::optional<Tick> lastTick_;  // that has come, and when
    net::Moment lastTickAt_{};
};

}  // namespace aquarama::conductor
