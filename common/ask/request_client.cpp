// SPDX-License-Identifier: Apache-2.0
#include "common/ask/request_client.h"

#include <chrono>
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
        if (std::exchange(waitingFor, reply.reason()) != reply.reason()) onWait(reply.reason());
        std::this_thread::sleep_for(kBetween);
    }
}

void RequestClient::steer(const Steering& steering, bool yields) {
    v1::Envelope envelope;
    v1::Input& input = *envelope.mutable_input();
    input = wire::steeringInput(steering);
    if (yields) input.set_yields(true);
    channels_->sendControl(wire::encode(0, std::move(envelope)));
}

void RequestClient::touch(const WallHands& hands) {
    v1::Envelope envelope;
    *envelope.mutable_input() = wire::handsInput(hands);
    channels_->sendControl(wire::encode(0, std::move(envelope)));
}

void RequestClient::feed(const glm::vec3& position) {
    v1::Envelope envelope;
    v1::Input& input = *envelope.mutable_input();
    input.set_kind(v1::INPUT_DROP_FOOD);
    for (int axis = 0; axis < 3; ++axis) input.add_position(position[axis]);
    channels_->sendControl(wire::encode(0, std::move(envelope)));
}

v1::Envelope RequestClient::ask(const v1::Envelope& question, v1::Envelope::MessageCase reply) {
    constexpr net::Duration kPatience = std::chrono::seconds(2);
    const std::vector<wire::Packet> packets =
        wire::partsOf(wire::encode(0, question), freshRequest());
    // A large question is on its way for a while.
    const net::Duration repeat = std::chrono::milliseconds(packets.size() == 1 ? 50 : 1000);
    const net::Moment giveUp = net::monotonicNow() + kPatience;
    preparing_.clear();
    while (net::monotonicNow() < giveUp) {
        for (const wire::Packet& packet : packets) channels_->sendControl(packet);
        channels_->wait(repeat);
        std::optional<v1::Envelope> newest;
        while (const auto bytes = channels_->receiveControl()) {
            auto message = wire::decode(*bytes);
            if (message && message->has_dismissed()) preparing_ = message->dismissed().reason();
            if (message && message->message_case() == reply) newest = std::move(message);
        }
        if (!newest && !preparing_.empty()) throw Error(preparing_ + "; ask again in a while");
        if (!newest) continue;
        preparing_.clear();
        run_ = newest->session();
        return *std::move(newest);
    }
    throw Error("no master answers at " + address_ +
                "; start one, name its control address with --master, or show a key that may ask "
                "(--key)");
}

std::string AskedMaster::keyPath() const {
    if (!key.empty() || !address.empty() || !config::needsKeys(config::readRig(rig))) return key;
    return config::keyFileIn(config::keyFolderOf(rig), "operator").string();
}

RequestClient AskedMaster::connect() const {
    const std::string path = keyPath();
    if (path.empty())
        return RequestClient(address.empty() ? config::readRig(rig).controlAddress : address);
    const config::KeyFile shown = config::readKeyFile(path);
    return RequestClient(address.empty() ? shown.masterAddress : address,
                         net::PeerKeys{shown.masterKey, {shown.publicKey, shown.secretKey}});
}

}  // namespace aquarama::ask
