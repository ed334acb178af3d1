// SPDX-License-Identifier: Apache-2.0
// Which nodes are waited for before a frame is presented: a state machine without clock or sockets,
// so that every fault can be played through in a test. And how regular the releases are.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "common/base/units.h"
#include "common/net/clock.h"

namespace aquarama::conductor {

using net::RecentTimes;

// How long the barrier waits.
struct BarrierLimits {
    bool lockstep = false;
    net::Duration deadline = std::chrono::microseconds(16667);  // live: how long the first that is
                                                                // ready waits for the others
    net::Duration membership = std::chrono::milliseconds(250);  // live: silence that ends it
    net::Duration patience = std::chrono::seconds(60);  // lockstep: silence that ends the show
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
    PresentBarrier(std::size_t nodes, const BarrierLimits& limits, net::Moment start);

    // The node has said something.
    void heard(std::size_t node, net::Moment now);
    // The node is prepared and sees every state from `first` on.
    void join(std::size_t node, Frame first);
    void leave(std::size_t node);
    // Live: members that fell silent; they are none from now on.
    [[nodiscard]] std::vector<std::size_t> expelSilent(net::Moment now);

    // This frame is drawn now. Members that see its state are waited for, except late ones.
    void begin(Frame frame);
    void ready(std::size_t node, Frame frame, net::Moment now);

    // What becomes of the frame that is drawn.
    enum class Verdict : std::uint8_t {
        Idle,     // nobody draws this frame
        Wait,     // ask again when something was heard, or at `until`
        Present,  // whoever missed the deadline has left the wait set
        Silent,   // lockstep: `node` has said nothing for too long
    };
    // A verdict with what belongs to it.
    struct Decision {
        Verdict verdict = Verdict::Idle;
        std::optional<net::Moment> until;
        std::size_t node = 0;
    };
    // What becomes of the frame at this moment.
    [[nodiscard]] Decision decide(net::Moment now);

    // Of one node, and of all: whether it takes part, whether the frame waits for it, whether all
    // have joined, whether any takes part.
    [[nodiscard]] bool isMember(std::size_t node) const { return nodes_[node].member; }
    [[nodiscard]] bool isWaitedFor(std::size_t node) const;
    [[nodiscard]] bool allPrepared() const;
    [[nodiscard]] bool hasMembers() const;
    // The first frame after the one that is drawn now from which on some member is waited for.
    [[nodiscard]] std::optional<Frame> nextAwaited() const;
    // Whether a node has become ready for the frame since it was begun. A node that was ready
    // before that, ahead of the others, does not count.
    [[nodiscard]] bool anyReady() const { return anyReady_; }
    [[nodiscard]] std::uint64_t timesLate(std::size_t node) const { return nodes_[node].timesLate; }

  private:
    struct Node {
        bool member = false;
        bool late = false;  // out of the wait set since it missed a deadline
        std::optional<Frame> readyFor;
        Frame first;
        net::Moment lastHeard{};
        std::uint64_t timesLate = 0;
    };
    [[nodiscard]] bool isReady(const Node& node) const {
        return node.member && node.readyFor && node.readyFor == frame_;
    }
    [[nodiscard]] Decision decideLive(net::Moment now);
    [[nodiscard]] Decision decideLockstep(net::Moment now) const;

    BarrierLimits limits_;
    std::vector<Node> nodes_;
    std::optional<Frame> frame_;
    bool anyReady_ = false;
    std::optional<net::Moment> deadline_;  // of frame_, as soon as anybody is ready for it
};

// When a frame is released that could be shown from `earliest` on; pure. Each display shows it at
// its first blank after the release. All these blanks fall into less than one refresh where the
// release is in the widest gap between the phases of the displays: so frames never mix, although
// the displays are not locked to each other. Each frame has a gap of its own, the first after that
// of `last`; in it, the release is as early as it can. All in the master's clock. Without displays:
// one `refresh` after `last`, at the earliest.
[[nodiscard]] net::Moment releaseTime(net::Moment earliest,
                                      net::Moment last,
                                      net::Duration refresh,
                                      std::span<const net::Blanks> displays);
// A release keeps this distance from blanks, for whom it reaches a little early or late.
inline constexpr net::Duration kBlankGuard = std::chrono::milliseconds(1);

// Release skew of a frame: the latest node's release minus the earliest's.
class SkewMeter {
  public:
    // A node released this frame at a moment of the master's clock. Returns the skew of the frame
    // for which no more reports are awaited, if any.
    std::optional<net::Duration> add(Frame frame, net::Moment at);
    [[nodiscard]] const RecentTimes& skews() const { return skews_; }

  private:
    struct Span {
        Frame frame;
        net::Moment earliest, latest;
        int nodes;
    };
    static constexpr std::size_t kOpen = 8;  // frames whose reports may still be on their way
    std::deque<Span> spans_;
    RecentTimes skews_;
};

}  // namespace aquarama::conductor
