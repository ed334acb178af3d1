// SPDX-License-Identifier: Apache-2.0
#include "common/lease/mastership.h"

#include <utility>

#include "common/base/boot_clock.h"
#include "common/base/log.h"

namespace aquarama::lease {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kBetweenKeepAlives{150};
constexpr milliseconds kBetweenAttempts{50};

LeaseKeys keysOf(const std::string& show) {
    return {"aquarama/" + show + "/master", "aquarama/" + show + "/last-master"};
}

}  // namespace

Mastership::Mastership(Members members, const Candidate& candidate)
    : keys_{keysOf(candidate.show)},
      name_{candidate.name},
      client_{std::move(members)},
      thread_{[this] { run(); }} {}

Mastership::~Mastership() {
    {
        const std::lock_guard lock(mutex_);
        isStopped_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

bool Mastership::isHeld() const {
    return bootNanoseconds() < heldUntilNs_;
}

std::string Mastership::master() const {
    const std::lock_guard lock(mutex_);
    return master_;
}

void Mastership::resign() {
    heldUntilNs_ = 0;
    {
        const std::lock_guard lock(mutex_);
        resigns_ = true;
    }
    changed_.notify_all();
}

void Mastership::run() {
    std::unique_lock lock(mutex_);
    while (!isStopped_ && !resigns_ && !isLost_) {
        lock.unlock();
        turn();
        lock.lock();
        changed_.wait_for(lock, revision_ == 0 ? kBetweenAttempts : kBetweenKeepAlives, [&] {
            return isStopped_ || resigns_;
        });
    }
    const bool isGiven = resigns_;
    lock.unlock();
    giveUp();
    if (isGiven) lose("it is given up");
}

void Mastership::turn() {
    try {
        revision_ == 0 ? stepAsCandidate() : stepAsMaster();
        if (std::exchange(isTroubled_, false)) logInfo("etcd answers again");
    } catch (const Error& problem) {
        sayTrouble(problem.what());
    }
    sayDoubt();
}

void Mastership::sayDoubt() {
    const bool wasHeld = std::exchange(wasHeld_, isHeld());
    if (wasHeld && !wasHeld_)
        logWarning("it is not known whether this machine is still the master: no frames");
}

void Mastership::sayTrouble(const std::string& problem) {
    if (std::exchange(isTroubled_, true)) return;
    logWarning("etcd gives no good answer; while that lasts nobody becomes or stays the master: {}",
               problem);
}

void Mastership::sayHolder(const std::optional<LeaseHolder>& holder) {
    if (holder) lastRevision_ = holder->revision;
    const std::lock_guard lock(mutex_);
    master_ = holder ? holder->name : "";
}

void Mastership::campaign(std::optional<milliseconds> patience) {
    patienceNs_ = patience ? std::chrono::nanoseconds(*patience).count() : kNever;
}

bool Mastership::isTime() {
    const std::int64_t now = bootNanoseconds(), patience = patienceNs_;
    if (freeSinceNs_ == 0) freeSinceNs_ = now;
    return patience != kNever && now - freeSinceNs_ >= patience;
}

// An answer to take() may have been lost: then the holder is this machine, by this lease.
void Mastership::stepAsCandidate() {
    const auto holder = client_.holder(keys_);
    sayHolder(holder);
    const bool isOwn = holder && lease_ && holder->lease == *lease_;
    if (holder && !isOwn) {
        freeSinceNs_ = 0;
    } else if (isTime()) {
        takeAsCandidate();
    }
}

// The lease is granted only when there is something to take.
void Mastership::takeAsCandidate() {
    const std::int64_t sentNs = bootNanoseconds();
    if (!lease_ || client_.keepAlive(*lease_) == 0) grant();
    const Taken taken = client_.take(keys_, name_, *lease_, 0);
    if (taken.revision) return gain(*taken.revision, sentNs);
    if (taken.holder && taken.holder->lease == *lease_) gain(taken.holder->revision, sentNs);
}

void Mastership::grant() {
    const LeaseAnswer granted = client_.grant(kLeaseSeconds);
    lease_ = granted.lease;
    if (granted.seconds <= kLeaseSeconds || std::exchange(toldOfLongLease_, true)) return;
    logWarning(
        "etcd grants leases of {} s, not {} s: a standby takes over later; start etcd with "
        "--heartbeat-interval 50 --election-timeout 500",
        granted.seconds,
        kLeaseSeconds);
}

// `sentNs`: when the request was sent whose answer says so.
void Mastership::gain(std::uint64_t revision, std::int64_t sentNs) {
    sayHolder(LeaseHolder{name_, *lease_, revision});
    heldUntilNs_ = sentNs + std::chrono::nanoseconds(kAnswerCounts).count();
    const std::uint64_t before = revision_.exchange(revision);
    wasHeld_ = true;
    isExpired_ = false;
    logInfo("this machine is {}, by lease {}",
            before == 0 ? "the master" : "still the master",
            revision);
}

void Mastership::stepAsMaster() {
    const std::int64_t sentNs = bootNanoseconds();
    if (isExpired_ || client_.keepAlive(*lease_) == 0) return takeAgain();
    heldUntilNs_ = sentNs + std::chrono::nanoseconds(kAnswerCounts).count();
}

// Where nobody else has held it meanwhile, nothing has happened. The holder is this machine where
// an answer to take() was lost.
void Mastership::takeAgain() {
    isExpired_ = true;
    heldUntilNs_ = 0;
    const std::int64_t sentNs = bootNanoseconds();
    if (client_.keepAlive(*lease_) == 0) grant();
    const Taken taken = client_.take(keys_, name_, *lease_, revision_);
    if (taken.revision) return gain(*taken.revision, sentNs);
    if (taken.holder && taken.holder->lease == *lease_) return gain(taken.holder->revision, sentNs);
    sayHolder(taken.holder);
    lose(taken.holder ? taken.holder->name + " is" : "another machine was");
}

void Mastership::lose(const std::string& why) {
    heldUntilNs_ = 0;
    wasHeld_ = false;
    if (revision_ != 0) logWarning("this machine is no longer the master: {}", why);
    isLost_ = true;
}

// So that nobody waits for the lease to expire.
void Mastership::giveUp() {
    heldUntilNs_ = 0;
    if (!lease_) return;
    try {
        client_.revoke(*lease_);
    } catch (const Error&) {  // it expires
    }
}

}  // namespace aquarama::lease
