// SPDX-License-Identifier: Apache-2.0
// The exchange between a node's net thread and its render thread: states and releases one way,
// bounded, and the end of either. The lock is held for a move only.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <variant>

#include "common/net/channels.h"
#include "render_node/session/session.h"

namespace aquarama::session {

struct ArrivedState {
    wire::StateFrame state;
    net::Instant arrival{};
};

struct ReleaseOrder {
    Frame frame;
    net::Instant at{};  // on this machine's clock; past instants mean at once
};

// What the master gave to a node that it welcomed.
struct Admitted {
    wire::Welcome welcome;
    std::map<Digest, net::ByteVector> blobs;  // all that the welcome names
};
struct Refused {
    std::string reason;
};
struct Ended {};  // the show, or this process
using JoinOutcome = std::variant<Admitted, Refused, Ended>;

class Mailbox {
  public:
    // The net thread's side.
    void admit(Admitted admitted);
    void refuse(const std::string& reason);
    void start(wire::Pace pace, Frame first);  // frames are taken from this one on
    void put(ArrivedState arrived);
    void release(const ReleaseOrder& order);
    void tellMind(wire::Explanation explanation);
    void interrupt(Release why);  // Rejoin or Quit; nothing comes back after Quit

    // The render thread's side. Each blocks until there is an answer.
    void expectJoin();  // forgets everything that came before
    [[nodiscard]] JoinOutcome awaitJoin();
    [[nodiscard]] std::optional<ArrivedState> takeState();  // empty: interrupted
    // The newest release, of this frame or a later one; empty: interrupted.
    [[nodiscard]] std::optional<ReleaseOrder> awaitRelease(Frame frame);
    [[nodiscard]] Release interruption() const;
    // The last that was told in this run of the master; does not block.
    [[nodiscard]] std::optional<wire::Explanation> latestMind() const;

  private:
    [[nodiscard]] std::optional<ArrivedState> takeNext();

    static constexpr std::size_t kStates = 8;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<JoinOutcome> join_;
    std::optional<Release> interruption_;
    std::optional<wire::Pace> pace_;  // set once frames are expected
    Frame next_;
    std::deque<ArrivedState> states_;
    std::optional<ReleaseOrder> release_;
    std::optional<wire::Explanation> mind_;
};

}  // namespace aquarama::session
