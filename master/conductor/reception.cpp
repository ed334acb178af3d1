// SPDX-License-Identifier: Apache-2.0
// What nodes and other peers say to the conductor.
#include <algorithm>
#include <array>
#include <utility>

#include <glm/geometric.hpp>
#include <spdlog/fmt/fmt.h>

#include "common/base/log.h"
#include "common/net/blob.h"
#include "common/wire/messages.h"
#include "master/conductor/conductor.h"

namespace aquarama::conductor {
namespace {

// Of one turn of the loop: a flood of packets never stops the frames.
constexpr int kMostPackets = 256;
// A node whose name comes up again is taken for dead after so much silence.
constexpr net::Instant kSilenceOfTheDead = std::chrono::milliseconds(250);
// Between two inputs of food from one window.
constexpr net::Instant kBetweenPinches = std::chrono::milliseconds(200);
constexpr float kReachMetres = 8.0F;  // from the eye
// Of StatusReply.skew_counts.
constexpr std::array<net::Instant, 8> kSkewEdges{std::chrono::microseconds(50),
                                                 std::chrono::microseconds(100),
                                                 std::chrono::microseconds(200),
                                                 std::chrono::microseconds(500),
                                                 std::chrono::milliseconds(1),
                                                 std::chrono::milliseconds(2),
                                                 std::chrono::milliseconds(5),
                                                 std::chrono::milliseconds(10)};

std::string hex(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

std::string listed(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list;
}

v1::NodeCondition conditionOf(bool present, bool prepared, bool waitedFor) {
    if (!present) return v1::NODE_ABSENT;
    if (!prepared) return v1::NODE_PREPARING;
    return waitedFor ? v1::NODE_IN_STEP : v1::NODE_LATE;
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
        const auto message = wire::decode(from->bytes);
        if (message && !from->peer.empty())
            take(*from, *message, now);
        else
            ++report_.refusedPackets;
    }
}

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

namespace {

bool isVisitorsInput(const v1::Envelope& message) {
    return message.message_case() == v1::Envelope::kInput &&
           (message.input().kind() == v1::INPUT_STEER ||
            message.input().kind() == v1::INPUT_DROP_FOOD);
}

bool asks(const v1::Envelope& message) {
    return message.message_case() == v1::Envelope::kStatusRequest ||
           message.message_case() == v1::Envelope::kExplainRequest;
}

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

bool maySay(const User& user, const v1::Envelope& message) {
    switch (user.role) {
        case config::KeyRole::Node:
            return mayNodeSay(user.name, message);
        case config::KeyRole::Watcher:
            return asks(message);
        case config::KeyRole::Visitor:
            return isVisitorsInput(message);
        case config::KeyRole::Operator:
        case config::KeyRole::Crew:
            return asks(message) || message.message_case() == v1::Envelope::kInput ||
                   message.message_case() == v1::Envelope::kOrder;
        case config::KeyRole::Master:
            break;
    }
    return false;
}

void Conductor::refuse(const std::string& user, const v1::Envelope& message) {
    ++report_.refusedPackets;
    if (!refused_.insert(user).second) return;
    logWarning("{} said what its key does not allow (message {}); refused, as all that follows",
               user,
               static_cast<int>(message.message_case()));
}

std::optional<std::size_t> Conductor::speaker(const net::FromPeer& from,
                                              const v1::Envelope& message) {
    if (const auto node = seatOf(from.peer)) return node;
    const auto user = userIn(from.user);
    if (!user || user->role != config::KeyRole::Node || message.session() != session_)
        return std::nullopt;
    const auto node = seatNamed(user->name);
    if (node && !slots_[*node].peer.empty()) slots_[*node].peer = from.peer;
    return seatOf(from.peer);
}

bool Conductor::isWithinRate(const std::string& user, net::Instant now) {
    constexpr int kMostASecond = 200;
    if (user.empty()) return true;
    Rate& rate = rates_[user];  // as many as there are keys
    if (now - rate.since > std::chrono::seconds(1)) rate = {now, 0};
    if (++rate.count <= kMostASecond) return true;
    if (rate.count == kMostASecond + 1)
        logWarning("{} asks more than {} times a second; the rest is refused", user, kMostASecond);
    return false;
}

void Conductor::takeOfVisitor(const net::FromPeer& from, const v1::Input& input, net::Instant now) {
    const auto& at = input.position();
    if (input.kind() == v1::INPUT_STEER) return steer(from.peer, wire::steeringOf(input), now);
    feed(fed_[from.user], {at[0], at[1], at[2]}, now);
}

// Without keys anybody on this machine may ask, steer and feed; the rest is for nodes of this run.
void Conductor::take(const net::FromPeer& from, const v1::Envelope& message, net::Instant now) {
    const net::PeerId& peer = from.peer;
    const auto user = userIn(from.user);
    if (user && !maySay(*user, message)) return refuse(from.user, message);
    const bool isCostly = asks(message) || message.message_case() == v1::Envelope::kHello ||
                          message.message_case() == v1::Envelope::kOrder;
    if (isCostly && !isWithinRate(from.user, now)) {
        ++report_.refusedPackets;
        return;
    }
    const auto node = speaker(from, message);
    switch (message.message_case()) {
        case v1::Envelope::kHello:
            return greet(peer, message.hello(), now);
        case v1::Envelope::kStatusRequest:
            return say(peer, status(now));
        case v1::Envelope::kExplainRequest:
            return ask(peer, message.explain_request().fish());
        case v1::Envelope::kOrder:
            return obey(from, message.order(), now);
        case v1::Envelope::kInput:
            if (node || !isVisitorsInput(message)) break;
            return takeOfVisitor(from, message.input(), now);
        default:
            break;
    }
    if (node && message.session() == session_) {
        slots_[*node].lastHeard = now;
        barrier_.heard(*node, now);
        takeOfNode(*node, message, now);
    } else {
        ++report_.refusedPackets;
        dismiss(peer, "the master does not know this connection");
    }
}

void Conductor::takeOfNode(std::size_t node, const v1::Envelope& message, net::Instant now) {
    switch (message.message_case()) {
        case v1::Envelope::kPing:
            return pong(node, message.ping().sent_ns());
        case v1::Envelope::kReady:
            return ready(node, message.ready(), now);
        case v1::Envelope::kBlobRequest:
            return giveChunk(slots_[node].peer, message.blob_request());
        case v1::Envelope::kPrepared:
            return prepared(node, message.prepared());
        case v1::Envelope::kNodeReport:
            slots_[node].report = std::make_shared<const v1::NodeReport>(message.node_report());
            return;
        case v1::Envelope::kLogLine:
            return note(node, message.log_line());
        case v1::Envelope::kOrderReply:
            return switched(node, message.order_reply());
        case v1::Envelope::kInput:
            return handle(node, message.input(), now);
        case v1::Envelope::kFarewell:
            return leave(node);
        default:
            ++report_.refusedPackets;
    }
}

// Why a node is refused; empty where it is not.
std::string Conductor::objectionTo(const v1::Hello& hello) const {
    if (hello.major() != wire::kProtocolMajor)
        return "it speaks protocol " + std::to_string(hello.major()) + " (build " + hello.build() +
               "), the master " + std::to_string(wire::kProtocolMajor) +
               "; install the same version on both";
    static const std::uint64_t ownHash = motion::motorSelfTest();
    if (hello.motor_hash() != ownHash)
        return "its processor or build moves fish to other places (self-test " +
               hex(hello.motor_hash()) + ", the master's " + hex(ownHash) +
               "); install the same version on both";
    if (seatNamed(hello.channel())) return {};
    std::vector<std::string> names;
    for (const ChannelSlot& slot : slots_) names.push_back(slot.name);
    return "the rig has no such channel, only " + listed(names);
}

void Conductor::greet(const net::PeerId& peer, const v1::Hello& hello, net::Instant now) {
    if (const std::string objection = objectionTo(hello); !objection.empty()) {
        ++report_.refusedPackets;
        constexpr std::size_t kMostTold = 100;
        if (objections_.size() < kMostTold && objections_.insert(objection).second)
            logWarning("refused node {}: {}", hello.channel(), objection);
        v1::Envelope refusal;
        refusal.mutable_refusal()->set_reason(objection);
        return say(peer, std::move(refusal));
    }
    const std::size_t node = *seatNamed(hello.channel());
    ChannelSlot& slot = slots_[node];
    const bool another = !slot.peer.empty() && slot.peer != peer;
    if (another && now - slot.lastHeard < kSilenceOfTheDead)
        return dismiss(peer, "another node of this name takes part already");
    if (slot.peer != peer) logInfo("welcomed node {}", slot.name);
    barrier_.leave(node);
    barrier_.heard(node, now);
    slot.peer = peer;
    slot.prepared = false;
    slot.lastHeard = now;
    slot.released = {};
    channels_->sendControl(peer, welcome_);
}

void Conductor::pong(std::size_t node, std::int64_t sentNs) {
    v1::Envelope message;
    message.mutable_pong()->set_sent_ns(sentNs);
    message.mutable_pong()->set_master_ns(net::monotonicNow().count());
    say(slots_[node].peer, std::move(message));
}

void Conductor::ready(std::size_t node, const v1::Ready& ready, net::Instant now) {
    const Frame frame{ready.frame()};
    barrier_.ready(node, frame, now);
    slots_[node].mismatches = ready.hash_mismatches();
    slots_[node].blanks = blanksIn(ready);
    if (ready.has_picture_us())
        slots_[node].pictures.add(now, std::chrono::microseconds(ready.picture_us()));
    if (ready.has_released_frame()) {
        slots_[node].released = std::max(slots_[node].released, Frame{ready.released_frame()});
        const auto skew = skew_.add({ready.released_frame()}, ready.released_ns());
        if (skew) {
            figures_.skewSeconds(net::secondsIn(*skew));
            skewPeak_.add(now, *skew);
        }
    }
    // It asks again for a release that never came.
    if (lastPresent_ && frame <= lastPresent_->first)
        channels_->sendControl(slots_[node].peer, lastPresent_->second);
}

// A display of quite another rate cannot be kept in step with the wall.
std::optional<net::Blanks> Conductor::blanksIn(const v1::Ready& ready) const {
    const net::Blanks blanks{net::Instant{ready.blank_ns()}, net::Instant{ready.blank_period_ns()}};
    const net::Instant apart = blanks.period - refresh_;
    const bool isBelieved = ready.has_blank_ns() && apart < refresh_ / 50 &&
                            -apart < refresh_ / 50 && blanks.last < net::monotonicNow();
    return isBelieved ? std::optional(blanks) : std::nullopt;
}

void Conductor::note(std::size_t node, const v1::LogLine& line) {
    constexpr std::uint64_t kMostLinesASecond = 50;
    ChannelSlot& slot = slots_[node];
    if (options_.log == nullptr || ++slot.logLines > kMostLinesASecond) return;
    options_.log->write(slot.name,
                        line.frame(),
                        static_cast<Severity>(line.severity() - v1::LOG_INFO),
                        line.text());
}

void Conductor::prepared(std::size_t node, const v1::Prepared& prepared) {
    ChannelSlot& slot = slots_[node];
    slot.builtLook = prepared.look();
    if (prepared.look() == control_.look()) {
        if (!look_->has_quality()) slot.bears = config::tierAt(prepared.quality());
        return admit(node);
    }
    if (slot.prepared) return;  // the next one, or one that was given up
    // It was built while the wall went on to another.
    barrier_.leave(node);
    dismiss(std::exchange(slot.peer, {}), "the wall shows another look by now");
    slot.prepared = false;
}

// Lockstep: it takes part in the frame that is drawn now. Live: in the first that it surely sees.
void Conductor::admit(std::size_t node) {
    if (slots_[node].prepared) return;
    lastPrepare_ = {};  // if another look is being prepared, this node has to build it as well
    const Frame first = isLockstep() ? next_ : unpublished_;
    slots_[node].prepared = true;
    barrier_.join(node, first);
    v1::Envelope message;
    message.mutable_joined()->set_first_frame(first.value);
    say(slots_[node].peer, std::move(message));
    if (isLockstep()) publishAgain(net::monotonicNow());
    logInfo("node {} takes part from frame {}", slots_[node].name, first.value);
}

void Conductor::giveChunk(const net::PeerId& peer, const v1::BlobRequest& request) {
    const auto blob = blobs_.find(wire::digestIn(request.digest()));
    if (blob == blobs_.end()) {
        ++report_.refusedPackets;
        return dismiss(peer, "the wall shows another look by now");
    }
    if (request.offset() > blob->second->size()) {
        ++report_.refusedPackets;
        return;
    }
    const auto content = net::chunkAt(*blob->second, request.offset(), wire::kBlobChunkBytes);
    v1::Envelope message;
    v1::BlobChunk& chunk = *message.mutable_blob_chunk();
    chunk.set_digest(request.digest());
    chunk.set_offset(request.offset());
    chunk.set_total(blob->second->size());
    chunk.set_content(content.data(), content.size());
    say(peer, std::move(message));
}

void Conductor::dismiss(const net::PeerId& peer, const std::string& why) {
    v1::Envelope message;
    message.mutable_dismissed()->set_reason(why);
    say(peer, std::move(message));
}

void Conductor::vacate(std::size_t node) {
    ChannelSlot& slot = slots_[node];
    logWarning("node {} is not counted any more: silent", slot.name);
    dismiss(slot.peer, "you were silent for too long");
    slot.peer.clear();
    slot.prepared = false;
    slot.report.reset();
}

void Conductor::leave(std::size_t node) {
    ChannelSlot& slot = slots_[node];
    barrier_.leave(node);
    slot.peer.clear();
    slot.prepared = false;
    slot.report.reset();
    logInfo("node {} has left", slot.name);
}

// Minds are looked into between two ticks.
void Conductor::ask(const net::PeerId& peer, std::uint32_t fish) {
    if (!simulationThread_) return;  // the show is over
    const bool asked = simulationThread_->betweenTicks([=, this](const Simulation& simulation) {
        v1::Envelope message;
        v1::Explanation& explanation = *message.mutable_explanation();
        explanation.set_fish(fish);
        explanation.set_school(fishOfSchool_);
        explanation.set_tick(simulation.tick().value);
        for (const std::string& line : simulation.explain(fish)) explanation.add_lines(line);
        explanations_.tryPut({peer, wire::encode(session_, std::move(message))});
        channels_->wake();
    });
    if (!asked) ++report_.refusedPackets;
}

void Conductor::answer() {
    while (const auto explanation = explanations_.tryTake())
        channels_->sendControl(explanation->first, explanation->second);
}

void Conductor::handle(std::size_t node, const v1::Input& input, net::Instant now) {
    const auto& at = input.position();
    switch (input.kind()) {
        case v1::INPUT_QUIT:
            if (!windowsEndShow_) {
                ++report_.refusedPackets;
                return;
            }
            over_ = true;
            break;
        case v1::INPUT_DROP_FOOD:
            return feed(slots_[node].lastFed, {at[0], at[1], at[2]}, now);
        case v1::INPUT_STEER:
            return steer(slots_[node].peer, wire::steeringOf(input), now);
        default:
            ++report_.refusedPackets;
    }
}

// The world bounds the number of pellets; here the rate of a window is, and the reach.
void Conductor::feed(net::Instant& lastFed, glm::vec3 positionMetres, net::Instant now) {
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

// A node that has left still counts: when it comes back, nothing changes.
config::QualityTier Conductor::quality() const {
    if (look_->has_quality()) return *config::tierAt(look_->quality());
    std::optional<config::QualityTier> least;
    for (const ChannelSlot& slot : slots_)
        if (slot.bears) least = std::min(least.value_or(*slot.bears), *slot.bears);
    return least.value_or(config::QualityTier::Low);
}

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

Conductor::Figures Conductor::makeFigures() {
    net::Metrics& m = metrics_;
    Figures figures{
        .frameSeconds = m.histogram("aquarama_frame_seconds", "Time between two releases"),
        .skewSeconds = m.histogram("aquarama_release_skew_seconds",
                                   "The last node's release of a frame minus the first's"),
        .frames = m.counter("aquarama_frames_total", "Frames that were released"),
        .fish = m.gauge("aquarama_fish", "Fish of the world"),
        .bytes = m.counter("aquarama_state_bytes_total", "Bytes of states, once for all nodes"),
        .refused = m.counter("aquarama_refused_packets_total", "Packets that were refused"),
        .black = m.gauge("aquarama_black", "1 where the wall is black because it was set so"),
        .nodes = {}};
    for (const ChannelSlot& slot : slots_) {
        const net::Labels node{{"node", slot.name}};
        figures.nodes.push_back(
            {.condition = m.gauge(
                 "aquarama_node_condition", "1 absent, 2 preparing, 3 in step, 4 late", node),
             .late = m.counter("aquarama_node_late_total", "Deadlines that it missed", node),
             .dropped = m.counter("aquarama_node_dropped_total", "Times it fell silent", node),
             .mismatches = m.counter("aquarama_node_hash_mismatches_total",
                                     "States that it decoded to another hash",
                                     node),
             .roundTrip = m.gauge(
                 "aquarama_node_round_trip_seconds", "Median of its pings of ten seconds", node),
             .drift = m.gauge("aquarama_node_clock_drift_ppm",
                              "By which the master's clock is faster than its own",
                              node),
             .celsius = m.gauge("aquarama_node_gpu_celsius",
                                "Temperature of its graphics card; 0 where none is told",
                                node)});
    }
    return figures;
}

void Conductor::count(net::Instant now) {
    if (now - lastCount_ < std::chrono::seconds(1)) return;
    lastCount_ = now;
    figures_.frames(static_cast<double>(report_.frames));
    figures_.fish(fishOfSchool_);
    figures_.bytes(static_cast<double>(publishedBytes_));
    figures_.refused(static_cast<double>(report_.refusedPackets));
    figures_.black(control_.wanted().black ? 1 : 0);
    for (std::size_t place = 0; place < slots_.size(); ++place) {
        ChannelSlot& slot = slots_[place];
        const NodeFigures& node = figures_.nodes[place];
        node.condition(conditionOf(!slot.peer.empty(), slot.prepared, barrier_.isWaitedFor(place)));
        node.late(static_cast<double>(barrier_.timesLate(place)));
        node.dropped(static_cast<double>(slot.dropped));
        node.mismatches(static_cast<double>(slot.mismatches));
        slot.logLines = 0;
        if (!slot.report) continue;
        node.roundTrip(static_cast<double>(slot.report->round_trip_median_ms()) / 1000);
        node.drift(static_cast<double>(slot.report->clock_drift_ppm()));
        node.celsius(static_cast<double>(slot.report->gpu_celsius()));
    }
}

// A tick that does not come is a hang of this process too, unless the world is to stand still.
void Conductor::sayAlive(net::Instant now) {
    constexpr net::Instant kLongestTick = std::chrono::seconds(2);
    if (options_.service == nullptr) return;
    const bool isStill = isLockstep() || control_.wanted().freeze;
    if (isStill || snapshots_.newest() != std::exchange(lastTick_, snapshots_.newest()))
        lastTickAt_ = now;
    if (now - lastTickAt_ < kLongestTick) options_.service->alive(report_.frames);
}

v1::Envelope Conductor::status(net::Instant now) const {
    v1::Envelope message;
    v1::StatusReply& reply = *message.mutable_status_reply();
    reply.set_pace(static_cast<v1::Pace>(options_.pace));
    reply.set_frame(next_.value);
    reply.set_tick(report_.tick.value);
    reply.set_frame_median_ms(frameTimes_.quantileMs(0.5));
    reply.set_frame_p99_ms(frameTimes_.quantileMs(0.99));
    reply.set_frame_peak_ms(framePeak_.ms());
    reply.set_skew_peak_ms(skewPeak_.ms());
    reply.set_skew_median_ms(skew_.skews().quantileMs(0.5));
    reply.set_skew_p99_ms(skew_.skews().quantileMs(0.99));
    for (const std::uint32_t count : skew_.skews().countsUpTo(kSkewEdges))
        reply.add_skew_counts(count);
    reply.set_refused_packets(report_.refusedPackets);
    wire::writeEye(eye_, *reply.mutable_eye());
    reply.set_speed_m_s(speedMetresPerSecond_);
    wire::writeShow(shown(now), *reply.mutable_show());
    reply.set_change(control_.waitingFor());
    for (std::size_t place = 0; place < slots_.size(); ++place) {
        const ChannelSlot& slot = slots_[place];
        v1::NodeStatus& node = *reply.add_nodes();
        node.set_name(slot.name);
        node.set_condition(
            conditionOf(!slot.peer.empty(), slot.prepared, barrier_.isWaitedFor(place)));
        node.set_late(barrier_.timesLate(place));
        node.set_dropped(slot.dropped);
        node.set_hash_mismatches(slot.mismatches);
        node.set_machine(slot.machine);
        node.set_picture_ms(slot.pictures.ms());
        if (slot.report) *node.mutable_report() = *slot.report;
    }
    return message;
}

}  // namespace aquarama::conductor
