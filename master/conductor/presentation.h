// SPDX-License-Identifier: Apache-2.0
// The frame that is drawn now: its state is published in time, and all nodes present it together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/output_file.h"
#include "common/config/rig.h"
#include "common/net/channels.h"
#include "master/conductor/gauges.h"
#include "master/conductor/present_barrier.h"
#include "master/conductor/roster.h"
#include "master/conductor/school_stream.h"
#include "master/conductor/sender.h"
#include "master/conductor/simulation_thread.h"

namespace aquarama::conductor {

// What the presentation asks of the show around it.
class FrameSource {
  public:
    virtual ~FrameSource() = default;
    // The next tick of the world, in order; nothing where it is not simulated yet.
    [[nodiscard]] virtual std::optional<Snapshot> takeTick() = 0;
    // What the wall shows in a frame that is published now; valid until the next call.
    [[nodiscard]] virtual const v1::Show& showOf(Frame frame, net::Moment now) = 0;
    // All nodes are told to present this frame.
    virtual void onReleased(Frame frame) = 0;
};

// When frames are presented, and how many.
struct PresentationLimits {
    BarrierLimits barrier;
    net::Duration refresh{};               // of the displays
    std::optional<std::uint64_t> frames;   // the show ends after so many
    std::filesystem::path traceDirectory;  // for master.csv; empty: none
    Tick firstTick = {};                   // lockstep: of frame 0
};

// Of the conductor's thread. `now` is the begin of a turn of its loop, by the master's clock.
class Presentation {
  public:
    // All that is referred to outlives this. Throws Error where the trace cannot be written.
    // `start`: of the show; nodes that never come are silent since then.
    Presentation(const PresentationLimits& limits,
                 Roster& roster,
                 const Sender& sender,
                 net::MasterChannels& channels,
                 Gauges& gauges,
                 ShowReport& report,
                 FrameSource& source,
                 net::Moment start);

    // Frames and ticks that are due, at one turn of the loop that began at `now`.
    void turn(net::Moment now);
    // The last frame is released.
    [[nodiscard]] bool isOver() const { return isOver_; }
    // Why the show cannot go on: a node of a lockstep show is silent; empty: it can.
    [[nodiscard]] const std::string& failure() const { return failure_; }
    // How long the loop may sleep where nothing is heard.
    [[nodiscard]] net::Duration untilDue(net::Moment now) const;

    // Which nodes are waited for.
    [[nodiscard]] PresentBarrier& barrier() { return barrier_; }
    [[nodiscard]] const PresentBarrier& barrier() const { return barrier_; }
    // The frame that is drawn, or will be as soon as it can; the first that is not published.
    [[nodiscard]] Frame next() const { return next_; }
    [[nodiscard]] Frame unpublished() const { return unpublished_; }
    [[nodiscard]] std::optional<Tick> newestTick() const { return snapshots_.newest(); }
    // The world is another one from now on; its fish have these rates.
    void enterWorld(std::vector<school::RecordedRates> rates);
    // Names a blob that leads to the fish of the newest tick, for a node that lacks them; nothing:
    // there is no tick. And the blob; null: it is none of the last.
    [[nodiscard]] std::optional<Digest> keyframe() { return school_.keyframe(); }
    [[nodiscard]] net::Blob blob(const Digest& digest) const { return school_.blob(digest); }

    // The node at this seat has built the look that is shown. Returns the first frame in which it
    // is waited for: in lockstep the one that is drawn now, live the first that it surely sees.
    Frame admit(std::size_t node, net::Moment now);
    // The node's picture of a frame is finished, and it has let go of an earlier one.
    void ready(std::size_t node, const v1::Ready& ready, net::Moment now);

  private:
    [[nodiscard]] bool isLockstep() const { return limits_.barrier.lockstep; }
    [[nodiscard]] bool isLast(Frame frame) const;
    void takeTicks();
    // Lockstep: the tick that a frame shows.
    [[nodiscard]] Tick tickOf(Frame frame) const { return {limits_.firstTick.value + frame.value}; }
    void expelSilent(net::Moment now);
    void conduct(net::Moment now);
    void beginNext(net::Moment now);  // as soon as there is somebody to draw it
    void release(net::Moment now);    // the frame that is drawn, to all prepared nodes
    // True where the frame's state has been published, now or earlier.
    bool publish(Frame frame, net::Moment now);
    // Sends the last two states again, for nodes that missed them.
    void publishAgain(net::Moment now);
    void sendBeacon(net::Moment now);
    // When a frame that is ready now is shown, not before the release can have reached every node:
    // releaseTime() for the displays of those who are waited for.
    [[nodiscard]] net::Moment nextRelease(net::Moment now) const;
    [[nodiscard]] net::Moment releaseOf(Frame frame, net::Moment now) const;
    // Of a node's display, where they can be believed.
    [[nodiscard]] std::optional<net::Blanks> blanksIn(const v1::Ready& ready) const;

    PresentationLimits limits_;
    Roster& roster_;
    const Sender& sender_;
    net::MasterChannels& channels_;
    Gauges& gauges_;
    ShowReport& report_;
    FrameSource& source_;
    PresentBarrier barrier_;
    GrowingFile trace_;
    wire::Packet beacon_;
    SnapshotBuffer snapshots_;
    SchoolStream school_;
    Frame next_;
    bool isDrawing_ = false;  // next_ is drawn
    Frame unpublished_;
    std::map<Frame, wire::Packet> published_;  // the last two: sent again to whoever may lack them
    net::Moment lastPublished_{};              // of anything, also of a beacon
    net::Moment lastRepeat_{};
    net::Duration repeatAfter_{};
    std::optional<std::pair<Frame, wire::Packet>> lastPresent_;
    net::Moment lastRelease_{};
    bool isOver_ = false;
    std::string failure_;
};

}  // namespace aquarama::conductor
