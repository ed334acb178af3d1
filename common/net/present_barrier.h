// SPDX-License-Identifier: Apache-2.0
// Who is waited for before a frame is presented: a state machine without clock or sockets, so that
// every fault can be played through in a test.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/net/clock.h"
#include "common/units/units.h"

namespace aquarama::net {

struct BarrierLimits {
    bool lockstep = false;
    Instant deadline = std::chrono::microseconds(16667);  // live: how long the first that is ready
                                                          // waits for the others
    Instant membership = std::chrono::milliseconds(250);  // live: silence that ends membership
    Instant patience = std::chrono::seconds(60);          // lockstep: silence that ends the show
};

// Nodes are numbered by their channel's place in the rig.
//
// Live: a member that misses a deadline leaves the wait set at once, and is waited for again as
// soon as it is ready for the frame that is drawn now, for the next one (whose state is published
// early), or only just too late for the one before: that brings equally slow nodes in step, while
// one that is slower than the rest for good does not slow the wall down. A member whose net thread
// is silent is no member any more.
// Lockstep: every node is waited for; one that is silent for `patience` ends the show.
class PresentBarrier {
  public:
    PresentBarrier(std::size_t nodes, const BarrierLimits& limits, Instant start);

    void heard(std::size_t node, Instant now);
    // The node is prepared and sees every state from `first` on.
    void join(std::size_t node, Frame first);
    void leave(std::size_t node);
    // Live: members that fell silent; they are none from now on.
    [[nodiscard]] std::vector<std::size_t> expelSilent(Instant now);

    // This frame is drawn now. Members that see its state are waited for, except late ones.
    void begin(Frame frame);
    void ready(std::size_t node, Frame frame, Instant now);

    enum class Verdict : std::uint8_t {
        Idle,     // nobody draws this frame
        Wait,     // ask again when something was heard, or at `until`
        Present,  // whoever missed the deadline has left the wait set
        Silent,   // lockstep: `node` has said nothing for too long
    };
    struct Decision {
        Verdict verdict = Verdict::Idle;
        std::optional<Instant> until;
        std::size_t node = 0;
    };
    [[nodiscard]] Decision decide(Instant now);

    [[nodiscard]] bool isMember(std::size_t node) const { return nodes_[node].member; }
    [[nodiscard]] bool isWaitedFor(std::size_t node) const;
    [[nodiscard]] bool allPrepared() const;
    [[nodiscard]] bool hasMembers() const;
    // The first frame after the one that is drawn now from which on some member is waited for.
    [[nodiscard]] std::optional<Frame> nextAwaited() const;
    // Somebody has become ready for the frame since it was begun. Who was ready for it before,
    // ahead of the others, does not count.
    [[nodiscard]] bool anyReady() const { return anyReady_; }
    [[nodiscard]] std::uint64_t timesLate(std::size_t node) const { return nodes_[node].timesLate; }

  private:
    struct Node {
        bool member = false;
        bool late = false;  // out of the wait set since it missed a deadline
        std::optional<Frame> readyFor;
        Frame first;
        Instant lastHeard{};
        std::uint64_t timesLate = 0;
    };
    [[nodiscard]] bool isReady(const Node& node) const {
        return node.member && node.readyFor && node.readyFor == frame_;
    }
    [[nodiscard]] Decision decideLive(Instant now);
    [[nodiscard]] Decision decideLockstep(Instant now) const;

    BarrierLimits limits_;
    std::vector<Node> nodes_;
    std::optional<Frame> frame_;
    bool anyReady_ = false;
    std::optional<Instant> deadline_;  // of frame_, as soon as anybody is ready for it
};

}  // namespace aquarama::net
