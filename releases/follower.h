// SPDX-License-Identifier: Apache-2.0
// How one machine obeys the depot, as a value.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "releases/rollout.h"

namespace aquarama::releases {

// What a machine keeps on its disk.
struct FollowerMemory {
    ReleaseId settled = {};      // that it may show without asking; none: it asks first
    std::uint64_t triedIn = 0;   // the epoch in which it was last started with another release
    ReleaseId tried = {};        // which one
    std::string triedFrom = {};  // the boot in which it was told
    friend bool operator==(const FollowerMemory&, const FollowerMemory&) = default;
};

// What is to be done now, in the order of the fields. The memory is on the disk before the next
// report.
struct FollowerDuties {
    bool isDark = false;     // channels stop at once
    ReleaseId start = {};    // the machine is started with this release; none: it stays
    bool isBlessed = false;  // the release that runs is good
    ReleaseId fetch = {};    // this release is copied; none: nothing
};

// One machine, from its start to its end. Times are seconds of its own clock. One thread uses it.
class ReleaseFollower {
  public:
    // `boot`: differs with each start of the machine.
    ReleaseFollower(FollowerMemory memory, ReleaseId booted, std::string boot);

    // Obeys an order that answers the report of the moment `reportedAt`. `held`: whole on its disk.
    // All stays as it is where the depot does not know yet what the machines run.
    FollowerDuties obey(const MachineOrder& order,
                        const std::vector<ReleaseId>& held,
                        double reportedAt,
                        double leaseSeconds);
    // Whether its channels may be shown.
    [[nodiscard]] bool mayShow(double now) const;

    // What it was given, and what became of it.
    [[nodiscard]] const FollowerMemory& memory() const { return memory_; }
    [[nodiscard]] const ReleaseId& booted() const { return booted_; }
    // For its reports.
    [[nodiscard]] std::uint64_t epoch() const { return epoch_; }
    [[nodiscard]] std::uint64_t leftIn() const;

  private:
    void remember(const MachineOrder& order);
    FollowerMemory memory_;
    ReleaseId booted_;
    std::string boot_;
    std::uint64_t epoch_ = 0;
    double shownUntil_ = 0;
};

}  // namespace aquarama::releases
