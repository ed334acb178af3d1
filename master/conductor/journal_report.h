// SPDX-License-Identifier: Apache-2.0
// What the journal of a world tells the conductor of itself.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "common/base/units.h"
#include "common/net/clock.h"
#include "common/wire/messages.h"

namespace aquarama::conductor {

// Bytes of a journal, and of the disk that it is on.
struct JournalSizes {
    std::uint64_t file = 0;    // the recording that grows
    std::uint64_t folder = 0;  // all recordings and saves
    std::uint64_t free = 0;
};

// The journal writes it, the conductor reads it. No call waits for a disk: the lock is held for the
// copy of a few values only.
class JournalReport {
  public:
    // Of a journal that is written.
    JournalReport() : JournalReport(v1::JournalStatus::WRITTEN, {}) {}
    // Of a show that keeps none; `reason`: why not.
    JournalReport(v1::JournalStatus::Condition condition, const std::string& reason);

    // While one is there, the disk is asked for something. Of the thread that writes.
    class DiskUse {
      public:
        // `report` outlives it.
        explicit DiskUse(JournalReport& report, net::Moment now = net::monotonicNow())
            : report_{report}, before_{report.askedAt_.exchange(now)} {}
        ~DiskUse() { report_.askedAt_ = before_; }
        DiskUse(const DiskUse&) = delete;
        DiskUse& operator=(const DiskUse&) = delete;

      private:
        JournalReport& report_;
        net::Moment before_;  // of a use around this one
    };

    // The newest save was written just now.
    void saved(net::Moment now = net::monotonicNow());
    // The bytes of now.
    void measured(const JournalSizes& sizes);
    // Nothing is written from now on, until goesOn().
    void paused(const std::string& reason);
    void goesOn();
    // An input took effect before the disk had it; whether that begins. Of the tick thread.
    void inputWasLate(bool isFirst);
    // The world goes on from a save. No master showed it for so long, seconds.
    void wentOn(Tick tick, double awaySeconds);

    // As operators are told at a moment.
    [[nodiscard]] v1::JournalStatus status(net::Moment now) const;

  private:
    mutable std::mutex mutex_;
    v1::JournalStatus status_;  // without the values below
    std::optional<net::Moment> savedAt_;
    std::atomic<net::Moment> askedAt_ = net::Moment{};  // of the disk; zero: it has answered
    std::atomic<std::uint64_t> lateInputs_ = 0, lateSpells_ = 0;
};

}  // namespace aquarama::conductor
