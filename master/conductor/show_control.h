// SPDX-License-Identifier: Apache-2.0
// How a wall comes to show what is wanted: the steps of a change of scene or quality, and fades.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/ask/order_book.h"
#include "common/base/units.h"
#include "common/config/scan.h"
#include "common/net/clock.h"
#include "common/wire/messages.h"
#include "common/wire/wanted_show.h"

namespace aquarama::conductor {

using ask::Answer;
using ask::Outcome;

// Who holds the wall for a scan, and the pattern that it shows meanwhile, in place of what is
// wanted. Nothing of it is kept on disk.
class ScanHold {
  public:
    static constexpr net::Duration kPatience = std::chrono::seconds(3);

    // Also where the holder says the same again. `next`: the first frame that is still to be
    // published. False: another holds the wall.
    [[nodiscard]] bool hold(std::uint64_t holder,
                            const config::ScanPattern& pattern,
                            Frame next,
                            net::Moment now);
    // Nothing where another holds the wall.
    void end(std::uint64_t holder);
    // True: its holder was silent for too long, and holds no more.
    [[nodiscard]] bool expires(net::Moment now);

    // Nothing where nobody holds the wall.
    [[nodiscard]] const std::optional<config::ScanPattern>& pattern() const { return pattern_; }
    // The first with the pattern.
    [[nodiscard]] Frame first() const { return first_; }
    // Grows with every change of what is shown.
    [[nodiscard]] std::uint64_t changes() const { return changes_; }

  private:
    std::uint64_t holder_ = 0;
    std::optional<config::ScanPattern> pattern_;
    Frame first_;
    net::Moment heard_{};
    std::uint64_t changes_ = 0;
};

// The sign of whoever lets visitors take part, in a corner of the wall. Its latest holder counts.
class SignHold {
  public:
    static constexpr net::Duration kPatience = std::chrono::seconds(5);

    // Without a sign it goes at once.
    void hold(const v1::HeldSign& sign, net::Moment now);
    // Takes it down where its holder was silent for too long.
    void expire(net::Moment now);
    // Nothing where there is none.
    [[nodiscard]] const v1::Sign* sign() const {
        return held_.has_sign() ? &held_.sign() : nullptr;
    }

  private:
    v1::HeldSign held_;
    net::Moment heard_{};
};

// A state machine without clock, sockets or worlds, so that every change can be played through in a
// test. Black, freeze, brightness and a pattern hold from the next frame on. Another scene or
// quality is another look: its world is made and every node builds it while the present one is
// shown; a scene also goes through black. The colour that is set holds until a scene is set: each
// has its own.
class ShowControl {
  public:
    // `wanted`: values that are left out are auto, the world, and off. `kept`: what was set in
    // earlier runs, already part of `wanted`. `book` outlives this: it is told how changes end.
    ShowControl(v1::WantedShow wanted, v1::WantedShow kept, ask::OrderBook& book);

    // Applies the values that are set, or begins the change. `request` is its sender's number: a
    // change that the book knows is answered again, and not begun anew.
    Answer set(std::uint64_t request, const v1::WantedShow& change);
    // The files of the wall are others: the same is to be shown by another look, without black.
    // False while another change is under way.
    bool renew();
    // Of the change that is under way; empty where there is none.
    [[nodiscard]] const std::string& waitingFor() const { return waitingFor_; }
    void setWaitingFor(const std::string& what);

    // The steps of a change.
    enum class Phase : std::uint8_t {
        Steady,     // nothing changes but brightness
        Making,     // the next world is being made: then made()
        Preparing,  // nodes build the next look: then prepared()
        Fading,     // to black; then blackShown()
        Switching,  // the next frame is of the next look: then switched()
    };
    // The step of the change that is under way, and calls that end a step.
    [[nodiscard]] Phase phase() const { return phase_; }
    void made();
    void prepared();
    void blackShown();
    // The next look is shown from now on.
    void switched();
    // The change cannot be done; the wall shows what it did before.
    void fail(const std::string& reason);

    // What the wall shows, or fades to.
    [[nodiscard]] const v1::WantedShow& wanted() const { return wanted_; }
    // All that was ever set and is shown: kept on disk for the next run.
    [[nodiscard]] const v1::WantedShow& kept() const { return kept_; }
    // What the look under way will show.
    [[nodiscard]] const v1::WantedShow& next() const { return next_; }
    // Whether the look that is shown has the world, not patterns alone; and the next one.
    [[nodiscard]] bool hasWorld() const { return hasWorld_; }
    [[nodiscard]] bool nextHasWorld() const { return nextHasWorld_; }
    [[nodiscard]] std::uint32_t look() const { return look_; }
    // Of the look under way; a number is never used twice, also where a change has failed.
    [[nodiscard]] std::uint32_t nextLook() const { return nextLook_; }
    [[nodiscard]] std::uint64_t version() const { return version_; }
    // Share of the light at a moment that is never earlier than at the call before. It comes to
    // what is wanted as fast as from black to full light in half a second. The first frame of a
    // look that follows black is black.
    [[nodiscard]] float brightness(net::Moment now);

  private:
    Answer begin(std::uint64_t request, const v1::WantedShow& goal, const v1::WantedShow& change);
    void settle(const Answer& answer);  // of the change under way

    ask::OrderBook& book_;
    v1::WantedShow wanted_, next_;
    v1::WantedShow kept_, change_;  // change_: under way
    Phase phase_ = Phase::Steady;
    bool hasWorld_, nextHasWorld_ = false;
    std::uint32_t look_ = 1, nextLook_ = 1;
    std::uint64_t version_ = 1;
    std::uint64_t underWay_ = 0;  // request; 0: of nobody
    std::string waitingFor_;
    float brightness_;
    net::Moment brightnessAt_{};
};

}  // namespace aquarama::conductor
