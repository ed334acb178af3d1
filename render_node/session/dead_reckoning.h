// SPDX-License-Identifier: Apache-2.0
// Dead reckoning: the frames that a node makes itself while the master is silent. Fish swim on by
// their last commands, then in wide circles. All nodes make the same frames at the same instants.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "common/net/clock.h"
#include "common/school/school_motion.h"
#include "common/wire/messages.h"
#include "render_node/session/mailbox.h"
#include "render_node/session/school_follower.h"

namespace aquarama::session {

// Frame n0, the last that the master released, was shown at T0. Frame n0 + k is shown k periods
// later. Where the master fell silent the first has k = kSilent + 1: so long the picture stands
// still. The world goes on from there, a quarter faster until it is where it would have been. Where
// the master has handed over the first has k = 2, as the frame before is on its way. Used by the
// net thread.
class DeadReckoning {
  public:
    // The master counts as silent after so many periods.
    static constexpr int kSilent = 14;
    // Why the node goes on alone.
    enum class Cause : std::uint8_t { Silence, HandOver };

    // How often the wall shows a frame.
    void setRefresh(double hertz) { periodSeconds_ = 1 / hertz; }
    // A frame of the master went to the render thread.
    void saw(const wire::StateFrame& frame);
    // The master released a frame, to be shown at this moment of this machine's clock.
    void released(Frame frame, net::Moment at);
    // From now on. Takes the newest fish of `school`; stays off where no frame with fish was shown
    // yet.
    void begin(Cause cause,
               const SchoolFollower& school,
               std::shared_ptr<school::SchoolMotion> motion);
    void end() { fish_.reset(); }
    // Nothing of before holds: neither frame nor release.
    void forget();
    [[nodiscard]] bool isOn() const { return fish_.has_value(); }
    // The number of the look that the newest frame shows; 0: there is none.
    [[nodiscard]] std::uint32_t look() const { return newest_ ? newest_->show.look : 0; }
    // Whether a master that was heard last at that moment counts as silent.
    [[nodiscard]] bool isSilent(net::Moment heard, net::Moment now) const;

    // The next frame, where it is on; empty until shortly before it is to be shown. Frames that are
    // too late are left out.
    [[nodiscard]] std::optional<ArrivedState> due(net::Moment now);
    // The frame after the last one, at once. It is on.
    [[nodiscard]] ArrivedState next();
    // When a frame after n0 is to be shown; empty for one before.
    [[nodiscard]] std::optional<ReleaseOrder> release(Frame finished) const;
    // The master's frames before the first of its own, for whoever waits for one.
    [[nodiscard]] ReleaseOrder overtaken(net::Moment now) const;

  private:
    struct Swimming {
        school::SchoolState school;
        RecentFish recent;
        std::shared_ptr<school::SchoolMotion> motion;
        Tick circles;    // from here on
        Frame last;      // that was made
        int missed = 0;  // periods after n0 before the first frame of its own
        int lag = 0;     // periods that the world is behind then
    };
    [[nodiscard]] net::Moment momentOf(Frame frame) const;
    // The moment of the world that a frame shows, in ticks.
    [[nodiscard]] double worldAt(Frame frame) const;
    [[nodiscard]] Frame firstFrame() const;
    [[nodiscard]] ArrivedState make(Frame frame);
    void swimTo(Tick tick);

    double periodSeconds_ = 1.0 / 60;
    std::optional<wire::StateFrame> newest_;  // of the master, without fish
    std::optional<ReleaseOrder> released_;    // n0 and T0
    std::optional<Swimming> fish_;
};

}  // namespace aquarama::session
