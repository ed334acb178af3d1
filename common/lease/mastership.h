// SPDX-License-Identifier: Apache-2.0
// Whether this machine is the master now, by a lease of etcd, and since which revision.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "common/lease/etcd_client.h"

namespace aquarama::lease {

// The life of the lease, the shortest that etcd grants, and how long an answer of etcd counts: the
// holder stops by its own clock before anybody else can hold it.
inline constexpr int kLeaseSeconds = 1;
inline constexpr std::chrono::milliseconds kAnswerCounts{700};

// Who wants to be master of what.
struct Candidate {
    std::string show;  // names the rig: its masters share one lease
    std::string name;  // of this machine
};

// Asks etcd on a thread of its own. Once it was lost it stays so.
class Mastership {
  public:
    Mastership(Members members, const Candidate& candidate);
    // Gives it up.
    ~Mastership();
    Mastership(const Mastership&) = delete;
    Mastership& operator=(const Mastership&) = delete;

    // The rest from any thread. From now on it takes the lease once nobody has held it for so long;
    // nothing: never.
    void campaign(std::optional<std::chrono::milliseconds> patience);
    // Whether nobody else can be the master at this moment. By a clock that also runs while the
    // machine sleeps.
    [[nodiscard]] bool isHeld() const;
    // Of its lease: what a master says counts for those alone who have heard of no larger one. 0
    // until it is gained; then it may grow.
    [[nodiscard]] std::uint64_t revision() const { return revision_; }
    // Somebody else may have been the master since.
    [[nodiscard]] bool isLost() const { return isLost_; }
    // Gives it up at once: another candidate gains it.
    void resign();
    // The name of the master; empty where there is none or etcd does not answer.
    [[nodiscard]] std::string master() const;
    // The lease of the last master that was seen; 0: of none.
    [[nodiscard]] std::uint64_t lastRevision() const { return lastRevision_; }

  private:
    static constexpr std::int64_t kNever = -1;
    void run();
    void turn();
    void stepAsCandidate();
    [[nodiscard]] bool isTime();
    void takeAsCandidate();
    void grant();
    void sayDoubt();
    void stepAsMaster();
    void gain(std::uint64_t revision, std::int64_t sentNs);
    void takeAgain();
    void lose(const std::string& why);
    void sayTrouble(const std::string& problem);
    void sayHolder(const std::optional<LeaseHolder>& holder);
    void giveUp();

    LeaseKeys keys_;
    std::string name_;
    EtcdClient client_;  // of the thread, as those that follow
    std::optional<std::int64_t> lease_;
    bool isTroubled_ = false, wasHeld_ = false, isExpired_ = false, toldOfLongLease_ = false;
    std::int64_t freeSinceNs_ = 0;  // 0: somebody held it
    std::atomic<std::int64_t> patienceNs_ = kNever;
    std::atomic<bool> isLost_ = false;
    std::atomic<std::uint64_t> revision_ = 0, lastRevision_ = 0;
    std::atomic<std::int64_t> heldUntilNs_ = 0;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    bool isStopped_ = false, resigns_ = false;
    std::string master_;
    std::thread thread_;  // last: it uses all of the above
};

}  // namespace aquarama::lease
