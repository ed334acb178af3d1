// SPDX-License-Identifier: Apache-2.0
// What the conductor does with what peers say: nodes, windows, operators, guests and a standby.
#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/base/characters.h"
#include "common/motion/motor.h"
#include "master/conductor/conductor.h"

namespace aquarama::conductor {
namespace {

// Of one turn of the loop: a flood of packets never stops the frames.
constexpr int kMostPackets = 256;
// A node whose name comes up again is taken for dead after so much silence.
constexpr net::Duration kSilenceOfTheDead = std::chrono::milliseconds(250);

}  // namespace

void Conductor::hear(net::Moment now) {
    report_.refusedPackets += channels_->discardNoise();
    for (int packet = 0; packet < kMostPackets; ++packet) {
        const auto from = channels_->receiveControl();
        if (!from) return;
        const auto message = wire::decode(from->bytes);
        if (message && !from->peer.empty())
            take(*from, *message, now);
        else
            countRefused(false);
    }
}

// Without keys anybody on this machine may ask, steer and feed; the rest is for nodes of this run.
void Conductor::take(const net::FromPeer& from, const v1::Envelope& message, net::Moment now) {
    const auto user = userIn(from.user);
    if (user && !maySay(*user, message)) {
        countRefused(false);
        if (roster_.isFirstRefusalOf(from.user))
            logWarning(
                "{} said what its key does not allow (message {}); refused, as all that follows",
                from.user,
                static_cast<int>(message.message_case()));
        return;
    }
    const bool isCostly = isQuestion(message) || message.has_hello() || message.has_order();
    if (isCostly && !roster_.isWithinRate(from.user, now)) return countRefused(false);
    const auto node = roster_.speaker(from, message.session() == sender_.session());
    switch (message.message_case()) {
        case v1::Envelope::kHello:
            return greet(from.peer, message.hello(), now);
        case v1::Envelope::kStatusRequest:
            return sender_.say(from.peer, status(now));
        case v1::Envelope::kExplainRequest:
            return countRefused(visitors_.ask(from.peer, message.explain_request().fish()));
        case v1::Envelope::kDrawingsRequest:
            return tellDrawings(from.peer, message.drawings_request());
        case v1::Envelope::kOrder:
            return obey(from, message.order(), now);
        case v1::Envelope::kFollow:
            return standby_.hear(from.peer, message.follow(), now);
        case v1::Envelope::kBlobRequest:
            if (!standby_.is(from.peer)) break;
            return giveChunk(from.peer, message.blob_request());
        case v1::Envelope::kPacketPart:
            return takePart(from, message.packet_part(), now);
        case v1::Envelope::kInput:
            if (node || !isVisitorsInput(message)) break;
            return takeInput(from, node, message.input(), now);
        default:
            break;
    }
    if (node && message.session() == sender_.session()) {
        roster_.seats()[*node].lastHeard = now;
        presentation_.barrier().heard(*node, now);
        takeOfNode(*node, message, now);
    } else {
        countRefused(false);
        sender_.dismiss(from.peer, "the master does not know this connection");
    }
}

// What the parts make is heard as if it had come in one.
void Conductor::takePart(const net::FromPeer& from, const v1::PacketPart& part, net::Moment now) {
    const auto packet = parts_.take(from.peer, part, now);
    if (!packet) return;
    const auto message = wire::decode(*packet);
    if (message && !message->has_packet_part())
        take(from, *message, now);
    else
        countRefused(false);
}

void Conductor::takeOfNode(std::size_t node, const v1::Envelope& message, net::Moment now) {
    NodeSeat& seat = roster_.seats()[node];
    switch (message.message_case()) {
        case v1::Envelope::kPing:
            return pong(seat.peer, message.ping().sent_ns());
        case v1::Envelope::kReady:
            return presentation_.ready(node, message.ready(), now);
        case v1::Envelope::kBlobRequest:
            return giveChunk(seat.peer, message.blob_request());
        case v1::Envelope::kKeyframeRequest:
            return giveKeyframe(seat.peer);
        case v1::Envelope::kPrepared:
            return prepared(node, message.prepared(), now);
        case v1::Envelope::kNodeReport:
            seat.report = std::make_shared<const v1::NodeReport>(message.node_report());
            return;
        case v1::Envelope::kLogLine:
            return note(seat, message.log_line());
        case v1::Envelope::kOrderReply:
            return orders_.hear(node, message.order_reply());
        case v1::Envelope::kInput:
            return takeInput({.peer = seat.peer, .bytes = {}}, node, message.input(), now);
        case v1::Envelope::kFarewell:
            return leave(node);
        default:
            countRefused(false);
    }
}

void Conductor::takeInput(const net::FromPeer& from,
                          std::optional<std::size_t> node,
                          const v1::Input& input,
                          net::Moment now) {
    const auto user = userIn(from.user);
    const bool isGuests = user && user->role == config::KeyRole::Guests;
    if (isGuests && !orders_.control().wanted().guests()) return countRefused(false);
    switch (input.kind()) {
        case v1::INPUT_QUIT:
            if (windowsEndShow_) isOver_ = true;
            return countRefused(windowsEndShow_);
        case v1::INPUT_DROP_FOOD:
            return countRefused(
                node ? visitors_.feed(roster_.seats()[*node], input, gauges_.eye(), now)
                     : visitors_.feed(from.user, input, gauges_.eye(), now));
        case v1::INPUT_STEER:
            return countRefused(visitors_.steer(from.peer, input, now));
        case v1::INPUT_HANDS:
            return countRefused(visitors_.touch(from.peer, input, now));
        default:
            countRefused(false);
    }
}

// Why a node is refused; empty where it is not.
std::string Conductor::objectionTo(const v1::Hello& hello) const {
    if (hello.major() != wire::kProtocolMajor)
        return fmt::format(
            "it speaks protocol {} (build {}), the master {}; install the same version on both",
            hello.major(),
            hello.build(),
            wire::kProtocolMajor);
    static const std::uint64_t ownHash = motion::motorSelfTest();
    if (hello.motor_hash() != ownHash)
        return fmt::format(
            "its processor or build moves fish to other places (self-test {:016x}, the master's "
            "{:016x}); install the same version on both",
            hello.motor_hash(),
            ownHash);
    if (roster_.named(hello.channel())) return {};
    return "the rig has no such channel, only " +
           roster_.listed([](const NodeSeat&) { return true; });
}

void Conductor::greet(const net::PeerId& peer, const v1::Hello& hello, net::Moment now) {
    if (const std::string objection = objectionTo(hello); !objection.empty()) {
        countRefused(false);
        if (roster_.isFirstObjection(objection))
            logWarning("refused node {}: {}", hello.channel(), objection);
        v1::Envelope refusal;
        refusal.mutable_refusal()->set_reason(objection);
        return sender_.say(peer, std::move(refusal));
    }
    const std::size_t node = *roster_.named(hello.channel());
    NodeSeat& seat = roster_.seats()[node];
    const bool isAnother = !seat.peer.empty() && seat.peer != peer;
    if (isAnother && now - seat.lastHeard < kSilenceOfTheDead)
        return sender_.dismiss(peer, "another node of this name takes part already");
    if (seat.peer != peer) logInfo("welcomed node {}", seat.name);
    presentation_.barrier().leave(node);
    presentation_.barrier().heard(node, now);
    seat.peer = peer;
    seat.prepared = false;
    seat.lastHeard = now;
    seat.released = {};
    sender_.send(peer, looks_.welcome());
}

void Conductor::pong(const net::PeerId& peer, std::int64_t sentNs) const {
    v1::Envelope message;
    message.mutable_pong()->set_sent_ns(sentNs);
    message.mutable_pong()->set_master_ns(net::monotonicNow().time_since_epoch().count());
    sender_.say(peer, std::move(message));
}

void Conductor::note(NodeSeat& seat, const v1::LogLine& line) const {
    constexpr std::uint64_t kMostLinesASecond = 50;
    if (options_.log == nullptr || ++seat.logLines > kMostLinesASecond) return;
    options_.log->write(seat.name,
                        line.frame(),
                        static_cast<Severity>(line.severity() - v1::LOG_INFO),
                        line.text());
}

void Conductor::prepared(std::size_t node, const v1::Prepared& prepared, net::Moment now) {
    NodeSeat& seat = roster_.seats()[node];
    seat.builtLook = prepared.look();
    if (prepared.look() == orders_.control().look()) {
        if (!looks_.shown().has_quality()) seat.bears = config::tierAt(prepared.quality());
        return admit(node, now);
    }
    if (seat.prepared) return;  // the next one, or one that was given up
    // It was built while the wall went on to another.
    presentation_.barrier().leave(node);
    sender_.dismiss(std::exchange(seat.peer, {}), "the wall shows another look by now");
    seat.prepared = false;
}

void Conductor::admit(std::size_t node, net::Moment now) {
    NodeSeat& seat = roster_.seats()[node];
    if (seat.prepared) return;
    looks_.prepareAgain();  // if another look is being prepared, this node has to build it as well
    seat.prepared = true;
    const Frame first = presentation_.admit(node, now);
    v1::Envelope message;
    message.mutable_joined()->set_first_frame(first.value);
    sender_.say(seat.peer, std::move(message));
    logInfo("node {} takes part from frame {}", seat.name, first.value);
}

void Conductor::leave(std::size_t node) {
    presentation_.barrier().leave(node);
    roster_.seats()[node].vacate();
    logInfo("node {} has left", roster_.seats()[node].name);
}

// Where there is no tick yet, the first frame brings all.
void Conductor::giveKeyframe(const net::PeerId& peer) {
    const auto digest = presentation_.keyframe();
    if (!digest) return;
    v1::Envelope message;
    message.mutable_keyframe()->set_digest(wire::bytesOf(*digest));
    sender_.say(peer, std::move(message));
}

void Conductor::giveChunk(const net::PeerId& peer, const v1::BlobRequest& request) {
    const Digest digest = wire::digestIn(request.digest());
    net::Blob blob = looks_.blob(digest);
    if (!blob) blob = drawings_.blob(digest);
    if (!blob) blob = presentation_.blob(digest);
    countRefused(blob && request.offset() <= blob->size());
    if (!blob) return sender_.dismiss(peer, "the wall shows another look by now");
    if (request.offset() <= blob->size()) sender_.sayChunk(peer, request, blob);
}

// Whoever shows no key is an account of this machine.
void Conductor::obey(const net::FromPeer& from, const v1::Order& order, net::Moment now) {
    const std::string user = from.user.empty() ? "somebody here" : from.user;
    v1::Envelope message;
    v1::OrderReply& reply = *message.mutable_order_reply();
    reply = order.has_change_master() ? changeMaster(user, order)
                                      : orders_.obey(user, order, presentation_.unpublished(), now);
    if (order.has_show() && reply.outcome() == v1::OrderReply::DONE)
        awaitDisk(order.show(), reply, now);
    if (simulationThread_ && !isLockstep())
        simulationThread_->freeze(orders_.control().wanted().freeze());
    for (const world::ReleaseHunter& called : orders_.hunters().take())
        bring(called, "a hunter does not come");
    sender_.say(from.peer, std::move(message));
}

// What is done outlives a power cut. A disk that takes longer is not waited for: the wall shows it
// already.
void Conductor::awaitDisk(const v1::WantedShow& change, v1::OrderReply& reply, net::Moment now) {
    constexpr net::Duration kLongest = std::chrono::seconds(2);
    constexpr net::Duration kWorthSaying = std::chrono::milliseconds(500);
    keeper_.keep(orders_.control().kept(), now);
    const auto since = keeper_.writesSince(change);
    if (!since || now - *since >= kLongest) return;
    reply.set_outcome(v1::OrderReply::WAITING);
    if (now - *since >= kWorthSaying) reply.set_reason("it is being written to the disk");
}

// Whoever asks goes on asking, until the other machine says that it is done.
v1::OrderReply Conductor::changeMaster(const std::string& user, const v1::Order& order) {
    const std::string& wanted = order.change_master().machine();
    v1::OrderReply reply;
    reply.set_request(order.request());
    reply.set_outcome(v1::OrderReply::REFUSED);
    if (!options_.resign) {
        reply.set_reason("the show has no standby: write standby { ... } in the rig");
    } else if (wanted == options_.machine) {
        reply.set_outcome(v1::OrderReply::DONE);
    } else if (wanted != standby_.machine()) {
        reply.set_reason(legible(wanted, wire::kMostNameBytes) + " does not stand by" +
                         (standby_.machine().empty() ? "" : ", but " + standby_.machine()));
    } else if (standby_.inStep().empty()) {
        reply.set_outcome(v1::OrderReply::WAITING);
        reply.set_reason(wanted + " catches up with the world first");
    } else if (standby_.lacks(drawings_.kept())) {
        reply.set_outcome(v1::OrderReply::WAITING);
        reply.set_reason(wanted + " fetches the drawings first");
    } else {
        logInfo("{} makes {} the master", user, wanted);
        reply.set_outcome(v1::OrderReply::WAITING);
        reply.set_reason(wanted + " takes over");
        standby_.promote();
    }
    return reply;
}

// Nodes turn to the other machine at once.
void Conductor::resign() {
    for (const NodeSeat& seat : roster_.seats())
        if (!seat.peer.empty()) sender_.handOver(seat.peer);
    options_.resign();
}

void Conductor::tellDrawings(const net::PeerId& peer, const v1::DrawingsRequest& request) const {
    v1::Envelope message;
    *message.mutable_drawings_reply() = drawings_.reply(request);
    sender_.say(peer, std::move(message));
}

v1::Envelope Conductor::status(net::Moment now) const {
    v1::Envelope message;
    v1::StatusReply& reply = *message.mutable_status_reply();
    reply.set_pace(static_cast<v1::Pace>(options_.pace));
    reply.set_frame(presentation_.next().value);
    *reply.mutable_show() = shown(now);
    reply.set_guests(orders_.control().wanted().guests());
    reply.set_drawings(orders_.control().wanted().drawings());
    reply.set_day(orders_.control().wanted().day());
    if (const auto version = drawings_.version()) reply.set_drawings_version(*version);
    reply.set_change(legible(orders_.control().waitingFor(), wire::kMostReasonBytes));
    gauges_.writeStatus(reply, report_, roster_, presentation_.barrier());
    if (options_.journal) *reply.mutable_journal() = options_.journal->status(now);
    if (!options_.machine.empty())
        *reply.mutable_standby() = standby_.status(options_.machine, now);
    return message;
}

}  // namespace aquarama::conductor
