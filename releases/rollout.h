// SPDX-License-Identifier: Apache-2.0
// How all machines of a wall come to a release together, as a value: reports go in, orders come
// out. The depot keeps its state on the disk before it gives an order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "releases/release.h"

namespace aquarama::releases {

// What a machine says of itself, every second or so.
struct MachineReport {
    ReleaseId booted = {};    // that runs
    std::uint64_t epoch = 0;  // of the last order that it has obeyed since it started; 0: none
    std::vector<ReleaseId> held = {};  // that lie on its disk whole, and were checked
    std::uint64_t frames = 0;  // that each of its channels has presented since it was started
    std::uint64_t leftIn = 0;  // the last epoch whose release it was started with and has left
    std::string problem = {};  // why it cannot take the release that it was told to fetch
};

// What a machine is told. It obeys an order at any time, and as often as it comes.
struct MachineOrder {
    std::uint64_t epoch = 0;
    ReleaseId run = {};      // that it is to be started with; none: with what it runs
    bool isSettled = false;  // `run` stays: it is good on all machines
    bool mayShow = false;    // else its channels stay dark
    ReleaseId fetch = {};    // that it is to copy; none: nothing
};

// What the depot knows for sure, and never forgets.
struct RolloutState {
    // How far the machines are.
    enum class Phase : std::uint8_t {
        Settled,    // all run `stable`
        Copying,    // so they do, and copy `candidate` one after the other
        Trying,     // all are to be started with `candidate`
        Returning,  // all are to be started with `stable` again
    };
    std::uint64_t epoch = 1;  // grows with each decision
    Phase phase = Phase::Settled;
    ReleaseId stable = {};  // none: not all machines have said yet what they run
    ReleaseId candidate = {};
    ReleaseId before = {};    // the one that was stable before; none: there is none
    std::string reason = {};  // why the last candidate was left; empty: it was not
    friend bool operator==(const RolloutState&, const RolloutState&) = default;
};

// When a release counts as good, and for how long a machine that hears nothing may show one that
// does not yet. Seconds.
struct RolloutLimits {
    std::uint64_t frames = 600;  // that each node has presented
    double trial = 900;          // until all nodes have
    // A short trial has a short lease, which is still renewed several times before it ends.
    [[nodiscard]] double lease() const { return std::clamp(trial / 15, 5.0, 60.0); }
};

// What is known of a machine.
struct MachineSeat {
    std::string name;  // as people know it
    std::optional<MachineReport> report = {};
    double heardAt = 0;   // seconds
    bool isGood = false;  // of the candidate
};

// The decisions. Times are seconds of any clock that never goes back. One thread uses it.
class Rollout {
  public:
    // Throws Error where there is no machine.
    Rollout(const std::vector<std::string>& machines,
            RolloutState state,
            const RolloutLimits& limits,
            double now);

    // What people ask for. Throw Error, which says why, where it cannot be.
    void stage(const ReleaseId& candidate, double now);  // machines copy it
    void go(double now);                                 // all machines are started with it
    void back(double now);  // the candidate is left, or the release before is tried

    // Takes a report. No machine has this name: it is ignored.
    void hear(const std::string& machine, const MachineReport& report, double now);
    // Decides what time decides.
    void pass(double now);
    // What a machine is told now.
    [[nodiscard]] MachineOrder orderFor(const std::string& machine, double now) const;

    // What is to be kept, and what the machines said last.
    [[nodiscard]] const RolloutState& state() const { return state_; }
    [[nodiscard]] const std::vector<MachineSeat>& seats() const { return seats_; }
    // Whether all machines hold the candidate.
    [[nodiscard]] bool isReady() const;
    // What it waits for, for people; empty: for nothing.
    [[nodiscard]] std::string waitingFor(double now) const;

  private:
    using Phase = RolloutState::Phase;
    [[nodiscard]] const ReleaseId& wanted() const;
    [[nodiscard]] bool isAt(const MachineSeat& seat, const ReleaseId& release) const;
    [[nodiscard]] bool areAll(bool (Rollout::*so)(const MachineSeat&) const) const;
    [[nodiscard]] bool isHere(const MachineSeat& seat) const;
    [[nodiscard]] bool isDone(const MachineSeat& seat) const;
    [[nodiscard]] std::string waitingFor(const MachineSeat& seat, double now) const;
    [[nodiscard]] bool mayShow(const MachineSeat& seat) const;
    [[nodiscard]] bool hasTurn(const std::string& machine, double now) const;
    void enter(Phase phase, double now);
    void giveUp(const std::string& reason, double now);
    void meet();
    void judgeCopy(double now);
    void judgeTrial(double now);
    void settle(double now);
    void judgeReturn(double now);

    RolloutState state_;
    RolloutLimits limits_;
    std::vector<MachineSeat> seats_;
    double since_;           // of the phase, or of this process
    bool gathered_ = false;  // all have come to the candidate in this epoch
};

// "settled", "copying" ...
[[nodiscard]] std::string nameOf(RolloutState::Phase phase);

}  // namespace aquarama::releases
