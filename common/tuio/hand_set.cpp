// SPDX-License-Identifier: Apache-2.0
#include "common/tuio/hand_set.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

namespace aquarama::tuio {

namespace {

using osc::OscArgument;
using osc::OscMessage;
using Arguments = std::span<const OscArgument>;

constexpr const char* kSecond = "/tuio2";
// A frame that is so far behind is no late one: its tracker was started again.
constexpr std::int64_t kMostLate = 100;
// Surfaces a second. No hand is faster.
constexpr float kMostSpeed = 100;

// Nothing where there is no such argument, or it is of another type.
template <class Value>
std::optional<Value> argument(Arguments arguments, std::size_t i) {
    const auto* value = i < arguments.size() ? std::get_if<Value>(&arguments[i]) : nullptr;
    return value == nullptr ? std::nullopt : std::optional(*value);
}

// Two numbers from the argument `i` on; nothing where one is none, or has no end.
std::optional<glm::vec2> pairAt(Arguments arguments, std::size_t i) {
    const auto x = argument<double>(arguments, i), y = argument<double>(arguments, i + 1);
    if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) return std::nullopt;
    return glm::vec2(*x, *y);
}

// A hand by its session, and by where its place and velocity stand in the arguments.
std::optional<Hand> handIn(Arguments arguments, std::size_t place, std::size_t velocity) {
    const auto session = argument<std::int64_t>(arguments, 0);
    const auto at = pairAt(arguments, place);
    if (!session || !at) return std::nullopt;
    const glm::vec2 speed = pairAt(arguments, velocity).value_or(glm::vec2(0));
    return Hand{.source = {},
                .session = *session,
                .place = glm::clamp(*at, 0.0F, 1.0F),
                .velocity = glm::clamp(speed, -kMostSpeed, kMostSpeed)};
}

// All whole numbers of a list of sessions, of so many as are kept.
std::set<std::int64_t> sessionsIn(Arguments arguments) {
    std::set<std::int64_t> sessions;
    for (std::size_t i = 0; i < std::min(arguments.size(), kMostHands); ++i)
        if (const auto session = argument<std::int64_t>(arguments, i)) sessions.insert(*session);
    return sessions;
}

}  // namespace

void HandSet::hear(std::span<const OscMessage> messages, double now) {
    std::erase_if(known_,
                  [&](const auto& one) { return now - one.second.heard > kSilenceSeconds; });
    Packet packet{{}, {}, now};
    for (const OscMessage& message : messages) {
        if (message.address == "/tuio/2Dcur" || message.address == "/tuio/2Dblb")
            hearFirst(message, packet);
        if (message.address.starts_with("/tuio2/")) hearSecond(message, packet);
    }
}

// 2Dcur set: s x y X Y m; 2Dblb set: s x y a w h f X Y A m r.
void HandSet::hearFirst(const OscMessage& message, Packet& packet) {
    const bool isBlob = message.address == "/tuio/2Dblb";
    const auto word = argument<std::string>(message.arguments, 0);
    if (!word) return;
    const Arguments rest = Arguments(message.arguments).subspan(1);
    ToldFrame& frame = packet.frames[message.address];
    if (*word == "source") packet.source = argument<std::string>(rest, 0).value_or("");
    if (*word == "alive") frame.alive = sessionsIn(rest);
    if (*word == "set")
        if (const auto hand = handIn(rest, 1, isBlob ? 7 : 3)) frame.hands[hand->session] = *hand;
    if (*word != "fseq") return;
    frame.number = argument<std::int64_t>(rest, 0).value_or(-1);
    take({packet.source, message.address}, std::exchange(frame, {}), packet.now);
}

// frm: number time size source; ptr: s type component x y angle shear radius press X Y ...; bnd: s
// x y angle width height area X Y ...; alv: s s s ... What points counts before its bounds.
void HandSet::hearSecond(const OscMessage& message, Packet& packet) {
    const Arguments arguments = message.arguments;
    ToldFrame& frame = packet.frames[kSecond];
    if (message.address == "/tuio2/frm") {
        packet.source = argument<std::string>(arguments, 3).value_or("");
        frame = {
            .hands = {}, .alive = {}, .number = argument<std::int64_t>(arguments, 0).value_or(-1)};
    } else if (message.address == "/tuio2/ptr") {
        if (const auto hand = handIn(arguments, 3, 9)) frame.hands[hand->session] = *hand;
    } else if (message.address == "/tuio2/bnd") {
        if (const auto hand = handIn(arguments, 1, 7)) frame.hands.emplace(hand->session, *hand);
    } else if (message.address == "/tuio2/alv") {
        frame.alive = sessionsIn(arguments);
        take({packet.source, kSecond}, std::exchange(frame, {}), packet.now);
    }
}

// A frame of the number of the last one continues it: it did not fit into one packet.
void HandSet::take(const Tracker& tracker, const ToldFrame& frame, double now) {
    if (!known_.contains(tracker) && known_.size() == kMostTrackers) return;
    Known& known = known_[tracker];
    known.heard = now;
    const bool isLate = frame.number >= 0 && frame.number < known.number &&
                        known.number - frame.number <= kMostLate;
    if (!frame.alive || isLate) return;
    if (frame.number >= 0) known.number = frame.number;
    for (const auto& [session, hand] : frame.hands) {
        Hand& kept = known.hands[session] = hand;
        kept.source = tracker.source;
    }
    std::erase_if(known.hands, [&](const auto& one) { return !frame.alive->contains(one.first); });
}

std::vector<Hand> HandSet::seen(double now) const {
    std::vector<Hand> all;
    for (const auto& [tracker, known] : known_)
        if (now - known.heard <= kSilenceSeconds)
            for (const auto& [session, hand] : known.hands)
                if (all.size() < kMostHands) all.push_back(hand);
    return all;
}

}  // namespace aquarama::tuio
