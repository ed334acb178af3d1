// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/roster.h"

#include <algorithm>
#include <cassert>
#include <chrono>

#include "common/base/log.h"

namespace aquarama::conductor {
namespace {

// Its window is a visitor's, and shows minds; it neither ends nor pauses the show.
bool mayNodeSay(const std::string& channel, const v1::Envelope& message) {
    switch (message.message_case()) {
        case v1::Envelope::kHello:
            return message.hello().channel() == channel;
        case v1::Envelope::kPing:
        case v1::Envelope::kReady:
        case v1::Envelope::kNodeReport:
        case v1::Envelope::kLogLine:
        case v1::Envelope::kBlobRequest:
        case v1::Envelope::kKeyframeRequest:
        case v1::Envelope::kPrepared:
        case v1::Envelope::kFarewell:
        case v1::Envelope::kOrderReply:
        case v1::Envelope::kExplainRequest:
            return true;
        default:
            return isVisitorsInput(message);
    }
}

}  // namespace

std::string userOf(config::KeyRole role, const std::string& name) {
    return std::string(config::nameOf(role)) + " " + name;
}

std::optional<User> userIn(const std::string& text) {
    const std::size_t space = text.find(' ');
    const auto* const role = std::ranges::find(config::kRoleNames, text.substr(0, space));
    if (space == std::string::npos || role == config::kRoleNames.end()) return std::nullopt;
    return User{static_cast<config::KeyRole>(role - config::kRoleNames.begin()),
                text.substr(space + 1)};
}

bool isVisitorsInput(const v1::Envelope& message) {
    return message.message_case() == v1::Envelope::kInput &&
           (message.input().kind() == v1::INPUT_STEER ||
            message.input().kind() == v1::INPUT_DROP_FOOD ||
            message.input().kind() == v1::INPUT_HANDS);
}

bool isQuestion(const v1::Envelope& message) {
    return message.message_case() == v1::Envelope::kStatusRequest ||
           message.message_case() == v1::Envelope::kExplainRequest ||
           message.message_case() == v1::Envelope::kDrawingsRequest;
}

namespace {

// What the guests' program asks in the name of visitors.
bool isGuestsOrder(const v1::Envelope& message) {
    return message.message_case() == v1::Envelope::kOrder &&
           (message.order().has_sign() || message.order().has_drawing());
}

}  // namespace

bool maySay(const User& user, const v1::Envelope& message) {
    switch (user.role) {
        case config::KeyRole::Node:
            return mayNodeSay(user.name, message);
        case config::KeyRole::Watcher:
            return isQuestion(message);
        case config::KeyRole::Visitor:
            return isVisitorsInput(message);
        case config::KeyRole::Guests:
            return isVisitorsInput(message) || isQuestion(message) || isGuestsOrder(message) ||
                   message.has_packet_part();
        case config::KeyRole::Operator:
        case config::KeyRole::Crew:
            return isQuestion(message) || message.message_case() == v1::Envelope::kInput ||
                   message.message_case() == v1::Envelope::kOrder || message.has_packet_part();
        case config::KeyRole::Standby:
            return message.has_follow() || message.has_blob_request();
        case config::KeyRole::Master:
            break;
    }
    return false;
}

void NodeSeat::vacate() {
    peer.clear();
    prepared = false;
    report.reset();
}

Roster::Roster(const config::Rig& rig, const std::vector<std::string>& names) {
    for (const config::Channel& channel : rig.channels)
        if (names.empty() || std::ranges::find(names, channel.name) != names.end())
            seats_.push_back({.name = channel.name, .machine = channel.machine});
    assert(names.empty() || names.size() == seats_.size());
}

std::optional<std::size_t> Roster::named(const std::string& channel) const {
    const auto seat = std::ranges::find(seats_, channel, &NodeSeat::name);
    if (seat == seats_.end()) return std::nullopt;
    return static_cast<std::size_t>(seat - seats_.begin());
}

std::optional<std::size_t> Roster::of(const net::PeerId& peer) const {
    const auto seat = std::ranges::find(seats_, peer, &NodeSeat::peer);
    if (seat == seats_.end()) return std::nullopt;
    return static_cast<std::size_t>(seat - seats_.begin());
}

std::optional<std::size_t> Roster::speaker(const net::FromPeer& from, bool knowsRun) {
    if (const auto node = of(from.peer)) return node;
    const auto user = userIn(from.user);
    if (!user || user->role != config::KeyRole::Node || !knowsRun) return std::nullopt;
    const auto node = named(user->name);
    if (node && !seats_[*node].peer.empty()) seats_[*node].peer = from.peer;
    return of(from.peer);
}

bool Roster::isEmpty() const {
    return std::ranges::all_of(seats_, [](const NodeSeat& seat) { return seat.peer.empty(); });
}

std::string Roster::listed(const std::function<bool(const NodeSeat&)>& isListed) const {
    std::string list;
    for (const NodeSeat& seat : seats_)
        if (isListed(seat)) list += (list.empty() ? "" : ", ") + seat.name;
    return list;
}

std::optional<config::QualityTier> Roster::measuredTier() const {
    const bool all =
        std::ranges::all_of(seats_, [](const NodeSeat& seat) { return seat.bears.has_value(); });
    return all ? std::optional(finestTier()) : std::nullopt;
}

config::QualityTier Roster::finestTier() const {
    std::optional<config::QualityTier> least;
    for (const NodeSeat& seat : seats_)
        if (seat.bears) least = std::min(least.value_or(*seat.bears), *seat.bears);
    return least.value_or(config::QualityTier::Low);
}

bool Roster::isWithinRate(const std::string& user, net::Moment now) {
    constexpr int kMostASecond = 200;
    if (user.empty()) return true;
    Rate& rate = rates_[user];  // as many as there are keys
    if (now - rate.since > std::chrono::seconds(1)) rate = {now, 0};
    if (++rate.count <= kMostASecond) return true;
    if (rate.count == kMostASecond + 1)
        logWarning("{} asks more than {} times a second; the rest is refused", user, kMostASecond);
    return false;
}

bool Roster::isFirstRefusalOf(const std::string& user) {
    return refused_.insert(user).second;
}

bool Roster::isFirstObjection(const std::string& objection) {
    constexpr std::size_t kMostTold = 100;
    return objections_.size() < kMostTold && objections_.insert(objection).second;
}

}  // namespace aquarama::conductor
