// SPDX-License-Identifier: Apache-2.0
// Hands on a touched surface, as trackers tell them by TUIO 1.1 (cursors and blobs) and 2.0
// (pointers and bounds).
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "common/osc/osc.h"

namespace aquarama::tuio {

// Bounds of what is kept.
inline constexpr std::size_t kMostHands = 64;
inline constexpr std::size_t kMostTrackers = 8;
// Of a tracker, after which its hands are forgotten. Where nothing moves, the protocol's reference
// implementation repeats itself each second only.
inline constexpr double kSilenceSeconds = 2.5;

// One hand, or a finger, that touches.
struct Hand {
    std::string source;        // the tracker's name for itself; empty: it has none
    std::int64_t session = 0;  // of this touch; a hand that comes again has another
    glm::vec2 place{};         // shares of the surface, 0 to 1, from its top left corner
    glm::vec2 velocity{};      // of the place, a second
    friend bool operator==(const Hand&, const Hand&) = default;
};

// The hands that there are. A value without clock or socket: times are seconds of any clock that
// is never set back.
class HandSet {
  public:
    // Takes the messages of one packet. Frames count whole: those without a list of who is alive
    // are passed over, as are late ones. So is what is malformed.
    void hear(std::span<const osc::OscMessage> packet, double now);

    // Those of trackers that are not silent, by source and session.
    [[nodiscard]] std::vector<Hand> seen(double now) const;

  private:
    // Who tells a list of hands of its own: a tracker, for each kind of hand ("/tuio/2Dcur", ...).
    struct Tracker {
        std::string source, kind;
        friend auto operator<=>(const Tracker&, const Tracker&) = default;
    };
    // What a packet says before its frame is whole.
    struct ToldFrame {
        std::map<std::int64_t, Hand> hands;
        std::optional<std::set<std::int64_t>> alive;
        std::int64_t number = -1;  // below 0: it repeats an earlier one, or has none
    };
    // What is known of a tracker.
    struct Known {
        std::map<std::int64_t, Hand> hands;
        std::int64_t number = -1;  // of the last frame that counted
        double heard = 0;
    };
    // Of one packet: where its messages go.
    struct Packet {
        std::string source;
        std::map<std::string, ToldFrame> frames;  // by kind
        double now;
    };

    void hearFirst(const osc::OscMessage& message, Packet& packet);   // TUIO 1.1
    void hearSecond(const osc::OscMessage& message, Packet& packet);  // TUIO 2.0
    void take(const Tracker& tracker, const ToldFrame& frame, double now);

    std::map<Tracker, Known> known_;
};

}  // namespace aquarama::tuio
