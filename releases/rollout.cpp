// SPDX-License-Identifier: Apache-2.0
// Why a mixed wall is never shown: a machine shows a release because it was told that this one is
// settled, or, for the time of a lease, because all machines have said in this epoch that they run
// the candidate. Whoever says so has obeyed an order of this epoch, and so shows nothing else. A
// machine that has left a release needs a new word to show it.
#include "releases/rollout.h"

#include <algorithm>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/base/log.h"

namespace aquarama::releases {

namespace {

// A machine that was not heard for so long has no turn at copying: others go on.
constexpr double kSilenceSeconds = 30;
// Clocks of two machines differ by far less.
constexpr double kLeaseMargin = 1.2;

bool holds(const MachineSeat& seat, const ReleaseId& release) {
    return seat.report &&
           (seat.report->booted == release ||
            std::ranges::find(seat.report->held, release) != seat.report->held.end());
}

}  // namespace

std::string nameOf(RolloutState::Phase phase) {
    switch (phase) {
        case RolloutState::Phase::Copying:
            return "copying";
        case RolloutState::Phase::Trying:
            return "trying";
        case RolloutState::Phase::Returning:
            return "returning";
        default:
            return "settled";
    }
}

Rollout::Rollout(const std::vector<std::string>& machines,
                 RolloutState state,
                 const RolloutLimits& limits,
                 double now)
    : state_{std::move(state)}, limits_{limits}, since_{now} {
    if (machines.empty()) throw Error("the rig has no machine; give it a channel");
    for (const std::string& name : machines) seats_.push_back({.name = name, .heardAt = now});
}

const ReleaseId& Rollout::wanted() const {
    return state_.phase == Phase::Trying ? state_.candidate : state_.stable;
}

// Only what a machine says after an order of this epoch counts: before, it may show another.
bool Rollout::isAt(const MachineSeat& seat, const ReleaseId& release) const {
    return seat.report && seat.report->epoch == state_.epoch && seat.report->booted == release;
}

bool Rollout::isReady() const {
    return state_.phase == Phase::Copying && std::ranges::all_of(seats_, [&](const auto& seat) {
               return holds(seat, state_.candidate);
           });
}

void Rollout::enter(Phase phase, double now) {
    state_.phase = phase;
    ++state_.epoch;
    since_ = now;
    gathered_ = false;
    for (MachineSeat& seat : seats_) seat.isGood = false;
}

void Rollout::stage(const ReleaseId& candidate, double now) {
    if (state_.phase == Phase::Trying || state_.phase == Phase::Returning)
        throw Error(
            "all machines are being started with another release; wait for its end "
            "(aquarama release status)");
    if (!state_.stable)
        throw Error("it is not known yet what the machines run: " + waitingFor(now) +
                    "; see aquarama release status");
    if (candidate.serial <= state_.stable.serial || candidate.version == state_.stable.version)
        throw Error(
            fmt::format("release {} (serial {}) is not newer than {} (serial {}), which "
                        "runs; give it a version of its own and sign it anew",
                        candidate.version,
                        candidate.serial,
                        state_.stable.version,
                        state_.stable.serial));
    state_.candidate = candidate;
    state_.reason.clear();
    enter(Phase::Copying, now);
}

void Rollout::go(double now) {
    if (state_.phase != Phase::Copying)
        throw Error("no release waits for a word; stage one (aquarama release stage)");
    if (!isReady()) throw Error("not all machines have it yet: " + waitingFor(now) + "; wait");
    enter(Phase::Trying, now);
}

void Rollout::back(double now) {
    if (state_.phase == Phase::Returning) return;
    if (state_.phase == Phase::Settled) {
        const bool areReady = state_.before && std::ranges::all_of(seats_, [&](const auto& seat) {
                                  return holds(seat, state_.before);
                              });
        if (!areReady) throw Error("not all machines hold a release from before; stage one");
        state_.candidate = state_.before;
        return enter(Phase::Trying, now);
    }
    giveUp("it was asked for", now);
}

void Rollout::giveUp(const std::string& reason, double now) {
    state_.reason = "release " + state_.candidate.version + " was left: " + reason;
    if (state_.phase == Phase::Trying) return enter(Phase::Returning, now);
    state_.candidate = {};
    enter(Phase::Settled, now);
}

void Rollout::hear(const std::string& machine, const MachineReport& report, double now) {
    const auto seat = std::ranges::find(seats_, machine, &MachineSeat::name);
    if (seat == seats_.end()) return;
    seat->report = report;
    seat->heardAt = now;
    pass(now);
}

void Rollout::pass(double now) {
    switch (state_.phase) {
        case Phase::Settled:
            return meet();
        case Phase::Copying:
            return judgeCopy(now);
        case Phase::Trying:
            return judgeTrial(now);
        case Phase::Returning:
            return judgeReturn(now);
    }
}

// A depot that is new learns what all machines run.
void Rollout::meet() {
    const auto& first = seats_.front().report;
    if (state_.stable || !first) return;
    if (std::ranges::all_of(seats_, [&](const MachineSeat& seat) {
            return seat.report && seat.report->booted == first->booted;
        }))
        state_.stable = first->booted;
}

// Who cannot take a release will not be able to later.
void Rollout::judgeCopy(double now) {
    for (const MachineSeat& seat : seats_)
        if (seat.report && seat.report->epoch == state_.epoch && !seat.report->problem.empty())
            return giveUp(seat.name + ": " + seat.report->problem, now);
}

bool Rollout::isHere(const MachineSeat& seat) const {
    return isAt(seat, state_.candidate);
}

bool Rollout::isDone(const MachineSeat& seat) const {
    return seat.isGood || (gathered_ && isHere(seat) && seat.report->frames >= limits_.frames);
}

bool Rollout::areAll(bool (Rollout::*so)(const MachineSeat&) const) const {
    return std::ranges::all_of(seats_, [&](const MachineSeat& seat) { return (this->*so)(seat); });
}

// Nobody waits for the others once a machine has come back.
void Rollout::judgeTrial(double now) {
    for (MachineSeat& seat : seats_) {
        if (seat.report && seat.report->leftIn == state_.epoch)
            return giveUp(seat.name + " came back with " + seat.report->booted.version, now);
        seat.isGood = isDone(seat);
    }
    if (areAll(&Rollout::isDone)) return settle(now);
    gathered_ = gathered_ || areAll(&Rollout::isHere);
    if (now - since_ > limits_.trial) giveUp(waitingFor(now), now);
}

void Rollout::settle(double now) {
    state_.before = std::exchange(state_.stable, state_.candidate);
    state_.candidate = {};
    state_.reason.clear();
    enter(Phase::Settled, now);
}

// Who was silent for longer than a lease shows nothing, or the stable one.
void Rollout::judgeReturn(double now) {
    const bool areBack = std::ranges::all_of(seats_, [&](const MachineSeat& seat) {
        const double silence = now - std::max(since_, seat.heardAt);
        return isAt(seat, state_.stable) || silence > limits_.lease() * kLeaseMargin;
    });
    if (!areBack) return;
    state_.candidate = {};
    enter(Phase::Settled, now);
}

// The first machine that lacks the release and is heard.
bool Rollout::hasTurn(const std::string& machine, double now) const {
    const ReleaseId& release = state_.phase == Phase::Copying ? state_.candidate : state_.stable;
    const auto next = std::ranges::find_if(seats_, [&](const MachineSeat& seat) {
        return seat.report && now - seat.heardAt < kSilenceSeconds && !holds(seat, release);
    });
    return next != seats_.end() && next->name == machine;
}

bool Rollout::mayShow(const MachineSeat& seat) const {
    const bool mayAnybody =
        gathered_ || state_.phase == Phase::Settled || state_.phase == Phase::Copying;
    return mayAnybody && seat.report && seat.report->booted == wanted();
}

MachineOrder Rollout::orderFor(const std::string& machine, double now) const {
    MachineOrder order{.epoch = state_.epoch, .run = wanted()};
    const auto seat = std::ranges::find(seats_, machine, &MachineSeat::name);
    if (!order.run || seat == seats_.end()) return order;
    order.isSettled = state_.phase == Phase::Settled || state_.phase == Phase::Copying;
    order.mayShow = mayShow(*seat);
    if (order.isSettled && hasTurn(machine, now))
        order.fetch = state_.phase == Phase::Copying ? state_.candidate : state_.stable;
    return order;
}

// Empty: nothing.
std::string Rollout::waitingFor(const MachineSeat& seat, double now) const {
    if (!seat.report || now - seat.heardAt > kSilenceSeconds) return "is not heard";
    if (state_.phase == Phase::Copying)
        return holds(seat, state_.candidate) ? "" : "has no whole " + state_.candidate.version;
    if (seat.report->booted != wanted()) return "runs " + seat.report->booted.version;
    if (state_.phase != Phase::Trying || seat.isGood) return "";
    return fmt::format(
        "has presented {} of {} frames", gathered_ ? seat.report->frames : 0, limits_.frames);
}

std::string Rollout::waitingFor(double now) const {
    std::vector<std::string> waits;
    for (const MachineSeat& seat : seats_)
        if (const std::string what = waitingFor(seat, now); !what.empty())
            waits.push_back(seat.name + " " + what);
    return fmt::format("{}", fmt::join(waits, ", "));
}

}  // namespace aquarama::releases
