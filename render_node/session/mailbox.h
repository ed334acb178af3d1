// SPDX-License-Identifier: Apache-2.0
// The mailbox in which a node's net thread and its render thread meet: joins, looks, states,
// finished frames and releases.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>

#include "common/body/side_skin.h"
#include "common/net/blob.h"
#include "common/net/clock.h"
#include "common/wire/messages.h"
#include "render_node/session/session.h"

namespace aquarama::session {

// A state, and when it arrived.
struct ArrivedState {
    wire::StateFrame state;
    net::Moment arrival{};
    bool isReckoned = false;  // by the node itself
    // The first of another run of the master: the number that the look has from now on.
    std::optional<std::uint32_t> renumbered = {};
};

// The master releases a frame, for all nodes at the same instant.
struct ReleaseOrder {
    Frame frame;
    net::Moment at{};  // on this machine's clock; a past moment means at once
};

// The moment, on this machine's clock, at which the node let a released frame be shown.
struct ReleaseReport {
    Frame frame;
    net::Moment at{};
};

// A frame whose picture is finished.
struct FinishedFrame {
    Frame frame;
    std::optional<ReleaseReport> released;  // of an earlier frame
    std::optional<net::Blanks> blanks;      // of the node's display, in this machine's clock
    net::Duration took{};                   // from the frame's state to its finished picture
};

// What the master gave to a node that it welcomed.
struct Admitted {
    v1::Welcome welcome;
    std::map<Digest, net::Blob> blobs;  // all that the welcome names
};
// The master refuses the node, or no connection could be made.
struct Refused {
    std::string reason;
};
// The show is over, or this process is.
struct Ended {};
using JoinOutcome = std::variant<Admitted, Refused, Ended>;

// The exchange between a node's net thread and its render thread: states and releases one way,
// bounded, and the end of either. The lock is held for a move only.
class Mailbox {
  public:
    // The net thread's side.
    void admit(Admitted admitted);
    void refuse(const std::string& reason);
    void start(wire::Pace pace, Frame first);  // frames are taken from this one on
    // The same, while frames are shown that are numbered otherwise. Those of before are forgotten,
    // and whoever waits for the release of one is let go. `renumbered`: see ArrivedState.
    void startAnew(wire::Pace pace, Frame first, std::optional<std::uint32_t> renumbered);
    void put(ArrivedState arrived);
    void release(const ReleaseOrder& order);
    void tellMind(ExplainedMind explanation);
    void offerNextLook(Admitted next);
    void offerSkins(std::shared_ptr<const body::SkinsByNumber> skins);
    // The finished frames that the net thread has not seen yet, oldest first; each once.
    [[nodiscard]] std::optional<FinishedFrame> takeFinished();
    void interrupt(Release why);  // Rejoin or Quit; nothing comes back after Quit

    // The render thread's side. Each blocks until there is an answer. `call` runs while one of them
    // waits, without the lock.
    void whileWaiting(std::function<void()> call) { whileWaiting_ = std::move(call); }
    void expectJoin();  // forgets everything of the join before
    [[nodiscard]] JoinOutcome awaitJoin();
    [[nodiscard]] std::optional<ArrivedState> takeState();  // empty: interrupted
    void finish(const FinishedFrame& finished);             // the net thread is to be woken
    // The newest release, of this frame or a later one; empty: interrupted.
    [[nodiscard]] std::optional<ReleaseOrder> awaitRelease(Frame frame);
    [[nodiscard]] Release interruption() const;
    // The next look, once, when all of its blobs are there; does not block.
    [[nodiscard]] std::optional<Admitted> takeNextLook();
    // The skins that were offered last, once; null: no others have been. Does not block.
    [[nodiscard]] std::shared_ptr<const body::SkinsByNumber> takeSkins();
    // The last explanation of this run of the master; does not block.
    [[nodiscard]] std::optional<ExplainedMind> latestMind() const;

  private:
    [[nodiscard]] std::optional<ArrivedState> takeNext();
    // Returns with the lock held, once this is true.
    void await(std::unique_lock<std::mutex>& lock, const std::function<bool()>& isDone);

    static constexpr std::size_t kStates = 8;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::function<void()> whileWaiting_;  // of the render thread
    std::optional<JoinOutcome> join_;
    std::optional<Release> interruption_;
    std::optional<wire::Pace> pace_;  // set once frames are expected
    Frame next_;
    std::deque<ArrivedState> states_;
    std::optional<std::uint32_t> renumbered_;  // told with the next state
    bool isForgotten_ = false;                 // the frame that the render thread has taken
    std::deque<FinishedFrame> finished_;
    std::optional<ReleaseOrder> release_;
    std::optional<ExplainedMind> mind_;
    std::optional<Admitted> nextLook_;
    std::shared_ptr<const body::SkinsByNumber> skins_;  // they outlive a join
};

}  // namespace aquarama::session
