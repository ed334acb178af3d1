// SPDX-License-Identifier: Apache-2.0
#include "console/cues/osc_desk.h"

#include <algorithm>
#include <utility>

#include "common/base/characters.h"
#include "common/base/log.h"

namespace aquarama::console {

namespace {

// Of one tick: more packets wait in the kernel, or are lost there.
constexpr int kMostPackets = 256;
constexpr int kMostReplies = 16;
// Orders whose end is waited for. More are given, and not followed.
constexpr std::size_t kMostGiven = 32;
constexpr int kTicksOfAWarning = 10;
// Of an address or a reason in the log.
constexpr std::size_t kMostLoggedBytes = 200;
// Between two times that receivers are told all.
constexpr int kTicksOfAll = 50;

// What consoles say. Two that hear each other must not answer each other.
bool isOurs(const std::string& address) {
    return address == "/aquarama/refused" || address.starts_with("/aquarama/state/");
}

}  // namespace

OscDesk::OscDesk(config::OscCues how, GiveOrder give)
    : how_{std::move(how)}, give_{std::move(give)}, port_{how_.listen} {}

void OscDesk::tick(std::vector<ShownValue> shown) {
    repliesLeft_ = kMostReplies;
    if (ticksToWarn_ > 0) --ticksToWarn_;
    follow();
    hear();
    give();
    tell(std::move(shown));
    ++ticks_;
}

// One byte more than may be read: what is too large is seen to be.
void OscDesk::hear() {
    for (int i = 0; i < kMostPackets; ++i) {
        const auto datagram = port_.receive(osc::kMostPacketBytes + 1);
        if (!datagram) return;
        if (std::ranges::find(how_.from, datagram->from.host) == how_.from.end()) {
            ++counts_.strangers;
            continue;
        }
        const osc::OscPacket packet = osc::decode(datagram->bytes);
        if (!packet.problem.empty()) refuse(datagram->from, "", packet.problem);
        for (const osc::OscMessage& message : packet.messages) take(datagram->from, message);
    }
}

void OscDesk::take(const config::UdpAddress& from, const osc::OscMessage& message) {
    if (isOurs(message.address)) return;
    const Cue cue = cueOf(message);
    if (!cue.problem.empty()) return refuse(from, message.address, cue.problem);
    GivenCue& given = heard_[message.address];
    given = {from, message.address, cue.order};
}

// In the order of their addresses.
void OscDesk::give() {
    for (auto& [address, cue] : std::exchange(heard_, {})) {
        ++counts_.given;
        const v1::OrderReply reply = said(cue);
        cue.order.set_request(reply.request());
        if (reply.outcome() == v1::OrderReply::WAITING) given_.push_back(std::move(cue));
    }
    if (given_.size() > kMostGiven) given_.erase(given_.begin(), given_.end() - kMostGiven);
}

void OscDesk::follow() {
    std::erase_if(given_, [this](const GivenCue& cue) {
        return said(cue).outcome() != v1::OrderReply::WAITING;
    });
}

// What is said of an order now; a refusal goes on to the sender.
v1::OrderReply OscDesk::said(const GivenCue& cue) {
    v1::OrderReply reply = give_("OSC " + cue.from.host, cue.order);
    if (reply.outcome() == v1::OrderReply::REFUSED || reply.outcome() == v1::OrderReply::LOST)
        refuse(cue.from, cue.address, reply.reason());
    return reply;
}

void OscDesk::refuse(const config::UdpAddress& to,
                     const std::string& address,
                     const std::string& why) {
    ++counts_.refused;
    if (repliesLeft_ > 0) port_.send(to, osc::encode({"/aquarama/refused", {address, why}}));
    repliesLeft_ = std::max(repliesLeft_ - 1, 0);
    if (ticksToWarn_ > 0) return;
    ticksToWarn_ = kTicksOfAWarning;
    logWarning("a cue of {} is refused{}{}: {} ({} since the start)",
               to.host,
               address.empty() ? "" : ": ",
               legible(address, kMostLoggedBytes),
               legible(why, kMostLoggedBytes),
               counts_.refused);
}

// The number of the frame alone is no change.
void OscDesk::tell(std::vector<ShownValue> shown) {
    const bool isAll = told_.empty() || ticks_ % kTicksOfAll == 0;
    for (std::size_t i = 0; i < shown.size(); ++i)
        if (isAll || (shown[i].name != "frame" && shown[i] != told_[i])) sendToAll(shown[i]);
    told_ = std::move(shown);
}

void OscDesk::sendToAll(const ShownValue& value) {
    const auto bytes = osc::encode({"/aquarama/state/" + value.name, {value.value}});
    for (const config::UdpAddress& receiver : how_.sendTo) port_.send(receiver, bytes);
}

}  // namespace aquarama::console
