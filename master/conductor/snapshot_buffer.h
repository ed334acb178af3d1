// SPDX-License-Identifier: Apache-2.0
// The last few ticks, and what a frame shows of them.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/net/clock.h"
#include "common/wire/messages.h"

namespace aquarama::conductor {

inline constexpr net::Instant kTickPeriod{1'000'000'000 / 60};
static_assert(kTicksPerSecond == 60.0);

struct Snapshot {
    Tick tick;
    net::Instant due{};  // live: when the world was like this
    std::uint64_t hash = 0;
    wire::Eye eye;
    float daylight = 1.0F;
    std::vector<motion::FishRecord> fish;
    wire::FoodCloud food;
};

class SnapshotBuffer {
  public:
    // Ticks come in order; the oldest is forgotten when `kept` are there.
    void add(Snapshot snapshot);
    [[nodiscard]] std::optional<Tick> newest() const;

    // Lockstep: the tick itself. Empty: not there.
    [[nodiscard]] std::optional<wire::StateFrame> showing(Frame frame, Tick tick) const;
    // Live: the moment, held between the oldest and the newest tick. Empty: no tick yet.
    [[nodiscard]] std::optional<wire::StateFrame> showing(Frame frame, net::Instant moment) const;

    static constexpr std::size_t kKept = 8;

  private:
    std::deque<Snapshot> snapshots_;
};

}  // namespace aquarama::conductor
