// SPDX-License-Identifier: Apache-2.0
// The tick thread, and the last few ticks that it made.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "common/net/channels.h"
#include "master/conductor/simulation.h"

namespace aquarama::conductor {

inline constexpr net::Duration kTickPeriod{1'000'000'000 / 60};
static_assert(kTicksPerSecond == 60.0);

// The last few ticks, and what a frame shows of them. Of the conductor's thread.
class SnapshotBuffer {
  public:
    // Ticks come in order; the oldest is forgotten when `kKept` are there.
    void add(Snapshot snapshot);
    [[nodiscard]] std::optional<Tick> newest() const;

    // Views of the snapshots, valid until the next add(); quality is left to the caller.
    // Lockstep: the tick itself. Empty: not there.
    [[nodiscard]] std::optional<wire::StateView> showing(Frame frame, Tick tick) const;
    // Live: the moment, held between the oldest and the newest tick. Empty: no tick yet.
    [[nodiscard]] std::optional<wire::StateView> showing(Frame frame, net::Moment moment) const;

    static constexpr std::size_t kKept = 8;

  private:
    std::deque<Snapshot> snapshots_;
};

// Advances the world: in lockstep as fast as its frames are taken, live by the clock.
class SimulationThread {
  public:
    // onTick is called from the tick thread after every tick. lastTick: lockstep simulates no
    // further.
    SimulationThread(Simulation& simulation,
                     wire::Pace pace,
                     std::optional<Tick> lastTick,
                     std::function<void()> onTick);
    ~SimulationThread();
    SimulationThread(const SimulationThread&) = delete;
    SimulationThread& operator=(const SimulationThread&) = delete;

    // The next tick, in order; does not wait. Empty: it is not simulated yet.
    [[nodiscard]] std::optional<Snapshot> take();
    // Live only: a lockstep show is the same every time. The first tick is made in any case.
    void freeze(bool frozen);

    // The job is called from the tick thread between two ticks, soon, in the order given; also
    // while the world is frozen or has come to its last tick. False: too many wait already.
    using Job = std::function<void(Simulation&)>;
    [[nodiscard]] bool betweenTicks(Job job);

  private:
    void run(wire::Pace pace);
    void runLive();
    void runLockstep();
    bool put(net::Moment due);
    // Does the jobs that wait; others may be given meanwhile.
    void serve(std::unique_lock<std::mutex>& lock);
    // Serves until there is room for a snapshot. False: stopped.
    bool awaitRoom();
    void serveUntilStopped();
    // False: stopped. True: the instant has come, and `frozenFor` it came later than planned.
    bool sleepUntil(net::Moment due, net::Duration& frozenFor);

    Simulation& simulation_;
    std::optional<Tick> lastTick_;
    std::function<void()> onTick_;
    // Less than a snapshot buffer keeps, so that lockstep finds every tick there.
    net::BoundedQueue<Snapshot> snapshots_{SnapshotBuffer::kKept / 2};
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Job> jobs_;
    bool frozen_ = false;
    bool stopped_ = false;
    std::thread thread_;  // last: it uses all of the above
};

}  // namespace aquarama::conductor
