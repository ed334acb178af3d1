// SPDX-License-Identifier: Apache-2.0
// Who comes, who goes, and what they want.
#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "common/net/blob.h"
#include "common/units/log.h"
#include "master/conductor/conductor.h"

namespace aquarama::conductor {
namespace {

// Of one turn of the loop: a flood of packets never stops the frames.
constexpr int kMostPackets = 256;
// A node whose name comes up again is taken for dead after so much silence.
constexpr net::Instant kSilenceOfTheDead = std::chrono::milliseconds(250);
// Of food from one window.
constexpr net::Instant kBetweenPinches = std::chrono::milliseconds(200);
constexpr float kReachMetres = 8.0F;  // from the eye

std::string listed(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list;
}

wire::NodeCondition conditionOf(bool present, bool prepared, bool waitedFor) {
    if (!present) return wire::NodeCondition::Absent;
    if (!prepared) return wire::NodeCondition::Preparing;
    return waitedFor ? wire::NodeCondition::InStep : wire::NodeCondition::Late;
}

}  // namespace

std::optional<std::size_t> Conductor::seatNamed(const std::string& name) const {
    const auto slot = std::ranges::find(slots_, name, &ChannelSlot::name);
    if (slot == slots_.end()) return std::nullopt;
    return static_cast<std::size_t>(slot - slots_.begin());
}

std::optional<std::size_t> Conductor::seatOf(const net::PeerId& peer) const {
    const auto slot = std::ranges::find(slots_, peer, &ChannelSlot::peer);
    if (slot == slots_.end()) return std::nullopt;
    return static_cast<std::size_t>(slot - slots_.begin());
}

void Conductor::hear(net::Instant now) {
    report_.refusedPackets += channels_->discardNoise();
    for (int packet = 0; packet < kMostPackets; ++packet) {
        const auto from = channels_->receiveControl();
        if (!from) return;
        const auto envelope = wire::decode(from->bytes);
        if (!envelope || from->peer.empty()) {
            ++report_.refusedPackets;
        } else if (const auto* hello = std::get_if<wire::Hello>(&envelope->message)) {
            greet(from->peer, *hello, now);
        } else if (std::holds_alternative<wire::StatusRequest>(envelope->message)) {
            say(from->peer, status(now));
        } else if (const auto* question = std::get_if<wire::ExplainRequest>(&envelope->message)) {
            ask(from->peer, *question);
        } else if (const auto* input = std::get_if<wire::Input>(&envelope->message);
                   input && input->kind == wire::InputKind::Steer && !seatOf(from->peer)) {
            steer(from->peer, input->steering, now);
        } else if (const auto node = seatOf(from->peer); node && envelope->session == session_) {
            slots_[*node].lastHeard = now;
            barrier_.heard(*node, now);
            heed(*node, envelope->message, now);
        } else {
            ++report_.refusedPackets;
            say(from->peer, wire::Dismissed{"the master does not know this connection"});
        }
    }
}

void Conductor::greet(const net::PeerId& peer, const wire::Hello& hello, net::Instant now) {
    const auto refuse = [&](const std::string& reason) {
        ++report_.refusedPackets;
        logWarning("refused node {}: {}", hello.channel, reason);
        say(peer, wire::Refusal{reason});
    };
    if (hello.major != wire::kProtocolMajor) {
        return refuse("it speaks protocol " + std::to_string(hello.major) + " (build " +
                      hello.build + "), the master " + std::to_string(wire::kProtocolMajor) +
                      "; install the same version on both");
    }
    const auto node = seatNamed(hello.channel);
    if (!node) {
        std::vector<std::string> names;
        for (const ChannelSlot& slot : slots_) names.push_back(slot.name);
        return refuse("the rig has no such channel, only " + listed(names));
    }
    ChannelSlot& slot = slots_[*node];
    const bool another = !slot.peer.empty() && slot.peer != peer;
    if (another && now - slot.lastHeard < kSilenceOfTheDead) {
        return say(peer, wire::Dismissed{"another node of this name takes part already"});
    }
    if (slot.peer != peer) logInfo("welcomed node {}", slot.name);
    barrier_.leave(*node);
    barrier_.heard(*node, now);
    slot.peer = peer;
    slot.prepared = false;
    slot.lastHeard = now;
    say(peer, welcome_);
}

void Conductor::heed(std::size_t node, const wire::Message& message, net::Instant now) {
    const net::PeerId& peer = slots_[node].peer;
    if (const auto* ping = std::get_if<wire::Ping>(&message)) {
        say(peer, wire::Pong{ping->sentNs, net::monotonicNow().count()});
    } else if (const auto* ready = std::get_if<wire::Ready>(&message)) {
        heed(node, *ready, now);
    } else if (const auto* request = std::get_if<wire::BlobRequest>(&message)) {
        giveChunk(peer, *request);
    } else if (const auto* prepared = std::get_if<wire::Prepared>(&message)) {
        slots_[node].bears = prepared->quality;
        admit(node);
    } else if (const auto* input = std::get_if<wire::Input>(&message)) {
        handle(node, *input, now);
    } else if (std::holds_alternative<wire::Farewell>(message)) {
        barrier_.leave(node);
        slots_[node].peer.clear();
        slots_[node].prepared = false;
        logInfo("node {} has left", slots_[node].name);
    } else {
        ++report_.refusedPackets;
    }
}

void Conductor::heed(std::size_t node, const wire::Ready& ready, net::Instant now) {
    barrier_.ready(node, ready.frame, now);
    if (ready.released) skew_.add(*ready.released);
    // It asks again for a release that never came.
    if (lastPresent_ && ready.frame <= lastPresent_->frame) say(slots_[node].peer, *lastPresent_);
}

// Lockstep: it takes part in the frame that is drawn now. Live: in the first that it surely sees.
void Conductor::admit(std::size_t node) {
    if (slots_[node].prepared) return;
    const Frame first = isLockstep() ? next_ : unpublished_;
    slots_[node].prepared = true;
    barrier_.join(node, first);
    say(slots_[node].peer, wire::Joined{first});
    if (isLockstep()) publishAgain(net::monotonicNow());
    logInfo("node {} takes part from frame {}", slots_[node].name, first.value);
}

void Conductor::giveChunk(const net::PeerId& peer, const wire::BlobRequest& request) {
    const auto blob = blobs_.find(request.digest);
    if (blob == blobs_.end() || request.offset > blob->second.size()) {
        ++report_.refusedPackets;
        return;
    }
    const auto chunk = net::chunkAt(blob->second, request.offset, wire::kBlobChunkBytes);
    say(peer,
        wire::BlobChunk{
            request.digest, request.offset, blob->second.size(), {chunk.begin(), chunk.end()}});
}

void Conductor::vacate(std::size_t node, const std::string& why) {
    ChannelSlot& slot = slots_[node];
    logWarning("node {} is not counted any more: silent", slot.name);
    say(slot.peer, wire::Dismissed{why});
    slot.peer.clear();
    slot.prepared = false;
}

// Minds are looked into between two ticks.
void Conductor::ask(const net::PeerId& peer, const wire::ExplainRequest& question) {
    if (!simulationThread_) return;  // farewells are being said
    const bool asked = simulationThread_->betweenTicks(
        [this, peer, fish = question.fish](const Simulation& simulation) {
            explanations_.tryPut({peer, simulation.explain(fish)});
            channels_->wake();
        });
    if (!asked) ++report_.refusedPackets;
}

void Conductor::answer() {
    while (const auto explanation = explanations_.tryTake())
        say(explanation->first, explanation->second);
}

void Conductor::handle(std::size_t node, const wire::Input& input, net::Instant now) {
    if (input.kind == wire::InputKind::Quit) {
        over_ = true;
    } else if (input.kind == wire::InputKind::DropFood) {
        feed(node, input.positionMetres, now);
    } else if (input.kind == wire::InputKind::Steer) {
        steer(slots_[node].peer, input.steering, now);
    } else if (!isLockstep() &&
               simulationThread_) {  // there is none any more while farewells are said
        simulationThread_->togglePause();
    }
}

// The world says how many pellets there may be; here a key that is stuck is slowed down, and nobody
// feeds what he cannot reach.
void Conductor::feed(std::size_t node, glm::vec3 positionMetres, net::Instant now) {
    net::Instant& lastFed = slots_[node].lastFed;
    if (now - lastFed < kBetweenPinches || !simulationThread_) return;
    const bool isInReach = glm::distance(positionMetres, eye_.positionMetres) < kReachMetres;
    const auto drop = [positionMetres](Simulation& simulation) {
        simulation.apply(world::DropFood{.position = positionMetres});
    };
    if (isInReach && simulationThread_->betweenTicks(drop))
        lastFed = now;
    else
        ++report_.refusedPackets;
}

// A node that has left counts on: when it comes back, nothing changes.
config::QualityTier Conductor::quality() const {
    if (options_.quality) return *options_.quality;
    std::optional<config::QualityTier> least;
    for (const ChannelSlot& slot : slots_)
        if (slot.bears) least = std::min(least.value_or(*slot.bears), *slot.bears);
    return least.value_or(config::QualityTier::Low);
}

// Anybody may steer who can reach the control address, as anybody may ask.
void Conductor::steer(const net::PeerId& peer, const Steering& steering, net::Instant now) {
    if (!simulationThread_ || !arbitration_.accepts(peer, steering, now)) return;
    const auto hold = [steering](Simulation& simulation) { simulation.apply(steering); };
    if (!simulationThread_->betweenTicks(hold)) ++report_.refusedPackets;
}

std::string Conductor::pilotName(net::Instant now) const {
    const auto pilot = arbitration_.pilot(now);
    if (!pilot) return {};
    const auto slot = seatOf(*pilot);
    return slot ? slots_[*slot].name : "pilot";
}

wire::StatusReply Conductor::status(net::Instant now) const {
    wire::StatusReply reply;
    reply.pace = options_.pace;
    reply.paused = simulationThread_ && simulationThread_->paused();
    reply.frame = next_;
    reply.tick = report_.tick;
    reply.frameMedianMs = frameTimes_.quantileMs(0.5);
    reply.frameP99Ms = frameTimes_.quantileMs(0.99);
    reply.skewMedianMs = skew_.skews().quantileMs(0.5);
    reply.skewP99Ms = skew_.skews().quantileMs(0.99);
    reply.refusedPackets = report_.refusedPackets;
    reply.eye = eye_;
    reply.speedMetresPerSecond = speedMetresPerSecond_;
    reply.pilot = pilotName(now);
    for (std::size_t node = 0; node < slots_.size(); ++node) {
        const ChannelSlot& slot = slots_[node];
        reply.nodes.push_back(
            {slot.name,
             conditionOf(!slot.peer.empty(), slot.prepared, barrier_.isWaitedFor(node)),
             barrier_.timesLate(node),
             slot.dropped});
    }
    return reply;
}

}  // namespace aquarama::conductor
