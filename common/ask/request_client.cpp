// SPDX-License-Identifier: Apache-2.0
#include "common/ask/request_client.h"

#include <chrono>
#include <filesystem>
#include <random>
#include <thread>
#include <utility>

#include "common/base/log.h"
#include "common/config/keys.h"
#include "common/config/rig.h"
#include "common/wire/parts.h"

namespace aquarama::ask {

std::uint64_t freshRequest() {
    std::random_device device;
    return (std::uint64_t{device()} << 32U | device()) | 1U;
}

namespace {

// The addresses at which the master of a rig may be.
std::vector<std::string> mastersOf(const std::string& rigPath) {
    const config::Rig rig = config::readRig(rigPath);
    std::vector<std::string> addresses{rig.controlAddress};
    if (rig.standby) addresses.push_back(rig.standby->controlAddress);
    return addresses;
}

}  // namespace

RequestClient::RequestClient(const std::vector<std::string>& controlAddresses,
                             const std::optional<net::PeerKeys>& keys) {
    for (const std::string& address : controlAddresses) {
        addresses_ += (addresses_.empty() ? "" : " or ") + address;
        channels_.push_back(net::connectNode(address, {}, keys));
    }
}

v1::StatusReply RequestClient::status() {
    v1::Envelope question;
    question.mutable_status_request();
    return ask(question, v1::Envelope::kStatusReply).status_reply();
}

v1::Explanation RequestClient::explain(std::uint32_t fish) {
    v1::Envelope question;
    question.mutable_explain_request()->set_fish(fish);
    return ask(question, v1::Envelope::kExplanation).explanation();
}

v1::DrawingsReply RequestClient::drawings(std::uint32_t skinOf) {
    v1::Envelope question;
    question.mutable_drawings_request();
    if (skinOf != 0) question.mutable_drawings_request()->set_skin_of(skinOf);
    return ask(question, v1::Envelope::kDrawingsReply).drawings_reply();
}

v1::OrderReply RequestClient::give(const v1::Order& order) {
    v1::Envelope question;
    *question.mutable_order() = order;
    return ask(question, v1::Envelope::kOrderReply).order_reply();
}

v1::OrderReply RequestClient::carryOut(v1::Order order,
                                       const std::function<void(const std::string&)>& onWait) {
    constexpr auto kBetween = std::chrono::milliseconds(100);
    order.set_request(freshRequest());
    std::string waitingFor;
    while (true) {
        const v1::OrderReply reply = give(order);
        if (reply.outcome() == v1::OrderReply::DONE) return reply;
        if (reply.outcome() != v1::OrderReply::WAITING) throw Error("refused: " + reply.reason());
        const bool isNew = std::exchange(waitingFor, reply.reason()) != reply.reason();
        if (isNew && !waitingFor.empty()) onWait(waitingFor);
        std::this_thread::sleep_for(kBetween);
    }
}

void RequestClient::steer(const Steering& steering, bool yields) {
    v1::Envelope envelope;
    v1::Input& input = *envelope.mutable_input();
    input = wire::steeringInput(steering);
    if (yields) input.set_yields(true);
    send(wire::encode(0, std::move(envelope)));
}

void RequestClient::touch(const WallHands& hands) {
    v1::Envelope envelope;
    *envelope.mutable_input() = wire::handsInput(hands);
    send(wire::encode(0, std::move(envelope)));
}

void RequestClient::feed(const glm::vec3& position) {
    v1::Envelope envelope;
    v1::Input& input = *envelope.mutable_input();
    input.set_kind(v1::INPUT_DROP_FOOD);
    for (int axis = 0; axis < 3; ++axis) input.add_position(position[axis]);
    send(wire::encode(0, std::move(envelope)));
}

void RequestClient::send(net::ByteView packet) {
    for (const auto& channels : channels_) channels->sendControl(packet);
}

std::optional<v1::Envelope> RequestClient::hear(v1::Envelope::MessageCase reply,
                                                net::Duration atMost) {
    std::optional<v1::Envelope> newest;
    for (const auto& channels : channels_) {
        if (newest) break;
        channels->wait(atMost / static_cast<int>(channels_.size()));
        while (const auto bytes = channels->receiveControl()) {
            auto message = wire::decode(*bytes);
            if (message && message->has_dismissed()) preparing_ = message->dismissed().reason();
            if (message && message->message_case() == reply) newest = std::move(message);
        }
    }
    return newest;
}

// A machine that stands by answers at once; the other one may still be taking over.
v1::Envelope RequestClient::ask(const v1::Envelope& question, v1::Envelope::MessageCase reply) {
    constexpr net::Duration kPatience = std::chrono::seconds(2);
    const net::Duration forMaster = std::chrono::milliseconds(channels_.size() == 1 ? 0 : 1800);
    const std::vector<wire::Packet> packets =
        wire::partsOf(wire::encode(0, question), freshRequest());
    // A large question is on its way for a while.
    const net::Duration repeat = std::chrono::milliseconds(packets.size() == 1 ? 50 : 1000);
    const net::Moment begun = net::monotonicNow();
    preparing_.clear();
    while (net::monotonicNow() < begun + kPatience) {
        for (const wire::Packet& packet : packets) send(packet);
        std::optional<v1::Envelope> newest = hear(reply, repeat);
        if (newest) {
            preparing_.clear();
            run_ = newest->session();
            return *std::move(newest);
        }
        if (!preparing_.empty() && net::monotonicNow() >= begun + forMaster)
            throw Error(preparing_ + "; ask again in a while");
    }
    throw Error("no master answers at " + addresses_ +
                "; start one, name its control address with --master, or show a key that may ask "
                "(--key)");
}

std::string AskedMaster::keyPath() const {
    if (!key.empty() || !address.empty() || !config::needsKeys(config::readRig(rig))) return key;
    return config::keyFileIn(config::keyFolderOf(rig), "operator").string();
}

// A key file names the first machine of its rig; the rig may not be at hand.
RequestClient AskedMaster::connect() const {
    const std::string path = keyPath();
    if (path.empty()) return {address.empty() ? mastersOf(rig) : std::vector{address}, {}};
    const config::KeyFile shown = config::readOwnKey(path);
    std::vector<std::string> addresses{address.empty() ? shown.masterAddress : address};
    const bool isAtHand =
        shown.rig == std::filesystem::path(rig).stem() && std::filesystem::exists(rig);
    if (address.empty() && isAtHand) addresses = mastersOf(rig);
    return {addresses, net::PeerKeys{shown.masterKey, {shown.publicKey, shown.secretKey}}};
}

}  // namespace aquarama::ask
