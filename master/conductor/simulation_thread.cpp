// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/simulation_thread.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

#include <glm/gtc/quaternion.hpp>
#include <pthread.h>

#include "common/base/log.h"

namespace aquarama::conductor {
namespace {

// Ticks that are overdue by less are simulated at once, one after the other; beyond it the world
// has lost time for good, and we say so.
constexpr net::Duration kMostCatchUp = 15 * kTickPeriod;
// Between two ticks: nobody who asks for more holds up the world.
constexpr std::size_t kMostJobs = 64;

// The tick itself: nothing before it is needed.
wire::StateView showingOne(Frame frame, const Snapshot& snapshot) {
    return {.frame = frame,
            .tick = snapshot.tick,
            .fraction = 1.0F,
            .eye = snapshot.eye,
            .worldHash = snapshot.hash,
            .foodOriginMetres = snapshot.food.originMetres,
            .foodBefore = {},
            .foodAfter = snapshot.food.particles,
            .timeOfDay = snapshot.timeOfDay,
            .show = nullptr};
}

// Where the eye is at a fraction of the way between two ticks.
wire::Eye between(const wire::Eye& before, const wire::Eye& after, float fraction) {
    return {glm::mix(before.positionMetres, after.positionMetres, fraction),
            glm::slerp(before.worldFromWall, after.worldFromWall, fraction)};
}

// The time of day at a fraction of the way between two ticks, between which midnight may lie.
float timeBetween(float before, float after, float fraction) {
    const float next = after < before - 0.5F ? after + 1 : after;
    const float time = glm::mix(before, next, fraction);
    return time > 1 ? time - 1 : time;
}

}  // namespace

void SnapshotBuffer::add(Snapshot snapshot) {
    assert(snapshots_.empty() || snapshots_.back().tick < snapshot.tick);
    snapshots_.push_back(std::move(snapshot));
    if (snapshots_.size() > kKept) snapshots_.pop_front();
}

std::optional<Tick> SnapshotBuffer::newest() const {
    return snapshots_.empty() ? std::nullopt : std::optional{snapshots_.back().tick};
}

std::optional<wire::StateView> SnapshotBuffer::showing(Frame frame, Tick tick) const {
    const auto found = std::ranges::find(snapshots_, tick, &Snapshot::tick);
    if (found == snapshots_.end()) return std::nullopt;
    return showingOne(frame, *found);
}

std::optional<wire::StateView> SnapshotBuffer::showing(Frame frame, net::Moment moment) const {
    if (snapshots_.empty()) return std::nullopt;
    const auto after = std::ranges::lower_bound(snapshots_, moment, {}, &Snapshot::due);
    if (after == snapshots_.end()) return showingOne(frame, snapshots_.back());
    if (after == snapshots_.begin()) return showingOne(frame, *after);
    const Snapshot& before = *std::prev(after);
    // After it was frozen two ticks lie far apart; the world stood still until one period before
    // the second.
    const net::Duration sinceBefore = moment - (after->due - kTickPeriod);
    const float fraction = static_cast<float>(sinceBefore.count()) / float{kTickPeriod.count()};
    if (fraction <= 0.0F) return showingOne(frame, before);
    if (fraction >= 1.0F) return showingOne(frame, *after);
    wire::StateView view = showingOne(frame, *after);
    view.fraction = fraction;
    view.eye = between(before.eye, after->eye, fraction);
    view.foodBefore = before.food.particles;
    view.timeOfDay = timeBetween(before.timeOfDay, after->timeOfDay, fraction);
    return view;
}

SimulationThread::SimulationThread(Simulation& simulation,
                                   wire::Pace pace,
                                   std::optional<Tick> lastTick,
                                   std::function<void()> onTick)
    : simulation_(simulation),
      lastTick_(lastTick),
      onTick_(std::move(onTick)),
      thread_([this, pace] { run(pace); }) {}

SimulationThread::~SimulationThread() {
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
    }
    changed_.notify_all();
    snapshots_.close();
    thread_.join();
}

void SimulationThread::freeze(bool frozen) {
    {
        const std::lock_guard lock(mutex_);
        frozen_ = frozen;
    }
    changed_.notify_all();
}

std::optional<Snapshot> SimulationThread::take() {
    auto snapshot = snapshots_.tryTake();
    if (snapshot) {
        // The tick thread has looked for room and waits, or will look.
        { const std::lock_guard lock(mutex_); }
        changed_.notify_all();
    }
    return snapshot;
}

bool SimulationThread::betweenTicks(Job job) {
    {
        const std::lock_guard lock(mutex_);
        if (jobs_.size() >= kMostJobs) return false;
        jobs_.push_back(std::move(job));
    }
    changed_.notify_all();
    return true;
}

void SimulationThread::serve(std::unique_lock<std::mutex>& lock) {
    const std::vector<Job> jobs = std::exchange(jobs_, {});
    lock.unlock();
    for (const Job& job : jobs) job(simulation_);
    lock.lock();
}

bool SimulationThread::awaitRoom() {
    std::unique_lock lock(mutex_);
    while (!stopped_) {
        serve(lock);
        if (!snapshots_.full()) return true;
        changed_.wait(lock, [&] { return stopped_ || !jobs_.empty() || !snapshots_.full(); });
    }
    return false;
}

void SimulationThread::serveUntilStopped() {
    std::unique_lock lock(mutex_);
    while (!stopped_) {
        serve(lock);
        changed_.wait(lock, [&] { return stopped_ || !jobs_.empty(); });
    }
}

// Waits while the queue is full. False: stopped.
bool SimulationThread::put(net::Moment due) {
    Snapshot snapshot = simulation_.snapshot();
    snapshot.due = due;
    const bool taken = snapshots_.put(std::move(snapshot));
    onTick_();
    return taken;
}

void SimulationThread::run(wire::Pace pace) {
    pthread_setname_np(pthread_self(), "ticks");  // for debuggers, and tests that hold it
    pace == wire::Pace::Live ? runLive() : runLockstep();
}

void SimulationThread::runLockstep() {
    while (awaitRoom() && put(net::Moment{})) {
        if (lastTick_ && simulation_.tick() >= *lastTick_) return serveUntilStopped();
        simulation_.advance();
    }
}

bool SimulationThread::sleepUntil(net::Moment due, net::Duration& frozenFor) {
    std::unique_lock lock(mutex_);
    const auto disturbed = [&] { return stopped_ || frozen_ || !jobs_.empty(); };
    while (changed_.wait_until(lock, due, disturbed) && !stopped_ && !frozen_) {
        serve(lock);
        if (net::monotonicNow() >= due) break;
    }
    const net::Moment begin = net::monotonicNow();
    const bool wasFrozen = frozen_;
    while (frozen_ && !stopped_) {
        serve(lock);
        changed_.wait(lock, [&] { return stopped_ || !frozen_ || !jobs_.empty(); });
    }
    frozenFor = wasFrozen ? net::monotonicNow() - begin : net::Duration{};
    return !stopped_;
}

// Tick k is due at start + k / 60 s, not counting when it is frozen and what could not be caught
// up.
void SimulationThread::runLive() {
    net::Moment due = net::monotonicNow();
    while (put(due)) {
        due += kTickPeriod;
        net::Duration frozenFor{};
        if (!sleepUntil(due, frozenFor)) return;
        due += frozenFor;
        const net::Duration overdue = net::monotonicNow() - due;
        if (overdue > kMostCatchUp) {
            logWarning("the world is {} ms behind and goes on from here",
                       std::chrono::duration_cast<std::chrono::milliseconds>(overdue).count());
            due += overdue;
        }
        simulation_.advance();
    }
}

}  // namespace aquarama::conductor
