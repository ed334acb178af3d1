// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/conductor.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/base/characters.h"
#include "common/motion/motor.h"
#include "master/conductor/hall_clock.h"

namespace aquarama::conductor {
namespace {

using Phase = ShowControl::Phase;

// Of one turn of the loop: a flood of packets never stops the frames.
constexpr int kMostPackets = 256;
// Drawings come and go once a second.
constexpr std::uint64_t kTicksBetweenDrawings = 60;
// A node whose name comes up again is taken for dead after so much silence.
constexpr net::Duration kSilenceOfTheDead = std::chrono::milliseconds(250);

net::Duration fromSeconds(double seconds) {
    return std::chrono::duration_cast<net::Duration>(std::chrono::duration<double>(seconds));
}

PresentationLimits limitsOf(const config::Timing& timing,
                            const ConductorOptions& options,
                            Tick firstTick) {
    const double deadline = timing.presentDeadlineSeconds > 0 ? timing.presentDeadlineSeconds
                                                              : 1.0 / timing.refreshHertz;
    return {.barrier = {.lockstep = options.pace == wire::Pace::Lockstep,
                        .deadline = fromSeconds(deadline),
                        .membership = fromSeconds(timing.membershipSeconds),
                        .patience = options.patience},
            .refresh = fromSeconds(1.0 / timing.refreshHertz),
            .frames = options.frames,
            .traceDirectory = options.traceDirectory,
            .firstTick = firstTick};
}

OrderLimits limitsOf(const ConductorOptions& options) {
    return {.isLockstep = options.pace == wire::Pace::Lockstep,
            .whyOneScene = options.looks.makeWorld ? "" : options.whyOneScene,
            .wanted = options.wanted,
            .kept = options.kept};
}

// A show in lockstep is the same every time: its wall does not change.
LookSources sourcesOf(const ConductorOptions& options) {
    LookSources sources = options.looks;
    if (options.pace == wire::Pace::Lockstep) sources.changedRig = nullptr;
    return sources;
}

v1::Welcome welcomeTo(const config::Rig& rig,
                      const ConductorOptions& options,
                      const net::MasterChannels& channels) {
    v1::Welcome welcome;
    welcome.set_rig_text(rig.text);
    welcome.set_state_address(channels.stateAddress());
    welcome.set_pace(static_cast<v1::Pace>(options.pace));
    if (!options.guestsKey.empty()) welcome.set_guests_key(options.guestsKey);
    return welcome;
}

// From no seed: two runs must not be taken for one another.
std::uint64_t freshSession() {
    std::random_device device;
    const std::uint64_t high = device();
    return (high << 32U | device()) | 1U;  // never 0
}

}  // namespace

Conductor::Conductor(const config::Rig& rig,
                     ConductorOptions options,
                     Simulation& simulation,
                     const wire::AssetBundle& assets,
                     std::span<const motion::FishTraits> school,
                     std::unique_ptr<net::MasterChannels> channels)
    : options_{std::move(options)},
      channels_{std::move(channels)},
      sender_{freshSession(),
              [this](const net::PeerId& peer, net::ByteView packet) {
                  channels_->sendControl(peer, packet);
              }},
      roster_{rig, options_.expected},
      drawings_{rig.drawings, options_.drawingsAt},
      day_{options_.hoursAt},
      orders_{limitsOf(options_), roster_, sender_, drawings_},
      looks_{sourcesOf(options_),
             welcomeTo(rig, options_, *channels_),
             rig.files,
             lookOf(assets, school),
             blobsOf(assets),
             orders_.control(),
             roster_,
             sender_},
      keeper_{options_.keptAt, options_.kept},
      gauges_{roster_, isLockstep() ? std::uint16_t{0} : rig.metricsPort},
      presentation_{limitsOf(rig.timing, options_, simulation.tick()),
                    roster_,
                    sender_,
                    *channels_,
                    gauges_,
                    report_,
                    *this,
                    net::monotonicNow()},
      visitors_{sender_, [this] { channels_->wake(); }},
      standby_{rig.standby.has_value() && !isLockstep(), sender_},
      simulation_{&simulation},
      windowsEndShow_{rig.windowsEndShow} {
    visitors_.enter(nullptr, static_cast<std::uint32_t>(school.size()));
}

Conductor::~Conductor() = default;

void Conductor::stop() {
    isOver_ = true;
    channels_->wake();
}

ShowReport Conductor::run() {
    if (!isLockstep() && !net::runInRealTime())
        logInfo(
            "no real-time priority: frames are late where this machine is busy; "
            "docs/cluster.md says how to allow it");
    startSimulation(visitors_.fish());
    if (options_.service != nullptr) options_.service->ready();
    while (!isOver_ && !presentation_.isOver() && !options_.isSuperseded()) {
        const net::Moment now = net::monotonicNow();
        hear(now);
        visitors_.answer();
        changeShow(now);
        if (!isLockstep()) day_.turn(*simulationThread_, orders_.control().wanted().day(), now);
        presentation_.turn(now);
        feedStandby(now);
        if (standby_.isPromoted()) resign();
        nameMissing(now);
        const v1::WantedShow& wanted = orders_.control().wanted();
        if (gauges_.count(
                now, report_, visitors_.fish(), wanted.black(), roster_, presentation_.barrier())) {
            for (NodeSeat& seat : roster_.seats()) seat.logLines = 0;
            if (options_.journal) gauges_.countJournal(options_.journal->status(now));
        }
        const bool isStill = isLockstep() || wanted.freeze();
        const bool isAlive = watchdog_.isAlive(now, presentation_.newestTick(), isStill);
        if (isAlive && options_.service != nullptr) options_.service->alive(report_.frames);
        channels_->wait(presentation_.untilDue(net::monotonicNow()));
    }
    if (options_.service != nullptr) options_.service->stopping();
    visitors_.enter(nullptr, visitors_.fish());
    simulationThread_.reset();
    if (!options_.isSuperseded()) sayFarewell();
    keeper_.finish(orders_.control().kept());
    if (!presentation_.failure().empty()) throw Error(presentation_.failure());
    return report_;
}

void Conductor::feedStandby(net::Moment now) {
    if (!standby_.isThere()) return;
    if (standby_.takesBeginning() && !simulationThread_->betweenTicks([](Simulation& simulation) {
            simulation.beginFollowed();
        }))
        standby_.beginAgain();
    const ShowControl& control = orders_.control();
    standby_.turn(*simulation_, {looks_.sceneName(), control.wanted(), control.kept()}, now);
}

void Conductor::nameMissing(net::Moment now) {
    constexpr net::Duration kBetweenRolls = std::chrono::seconds(5);
    if (now - lastRoll_ < kBetweenRolls) return;
    lastRoll_ = now;
    std::string missing;
    for (const NodeSeat& seat : roster_.seats()) {
        if (!seat.peer.empty()) continue;
        missing += (missing.empty() ? "" : ", ") + seat.name;
        if (!seat.machine.empty()) missing += " (machine " + seat.machine + ")";
    }
    if (!missing.empty()) logInfo("waiting for {}", missing);
}

// Repeats the farewell until every node has answered, two seconds at most: closing a connection
// while a node still sends would discard our last message to it.
void Conductor::sayFarewell() {
    constexpr net::Duration kLongest = std::chrono::seconds(2);
    constexpr net::Duration kFarewellRepeat = std::chrono::milliseconds(100);
    const net::Moment begin = net::monotonicNow();
    net::Moment lastSaid = begin - kFarewellRepeat;
    v1::Envelope farewell;
    farewell.mutable_farewell();
    standby_.sayFarewell();
    while (!roster_.isEmpty()) {
        const net::Moment now = net::monotonicNow();
        if (now - begin > kLongest) return;
        if (now - lastSaid >= kFarewellRepeat) {
            for (const NodeSeat& seat : roster_.seats())
                if (!seat.peer.empty()) sender_.say(seat.peer, farewell);
            lastSaid = now;
        }
        channels_->wait(kFarewellRepeat / 4);
        hear(net::monotonicNow());
    }
}

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
    if (request.offset() > blob->size()) return;
    const auto content = net::chunkAt(*blob, request.offset(), wire::kBlobChunkBytes);
    v1::Envelope message;
    v1::BlobChunk& chunk = *message.mutable_blob_chunk();
    chunk.set_digest(request.digest());
    chunk.set_offset(request.offset());
    chunk.set_total(blob->size());
    chunk.set_content(content.data(), content.size());
    sender_.say(peer, std::move(message));
}

// Whoever shows no key is an account of this machine.
void Conductor::obey(const net::FromPeer& from, const v1::Order& order, net::Moment now) {
    const std::string user = from.user.empty() ? "somebody here" : from.user;
    v1::Envelope message;
    *message.mutable_order_reply() =
        order.has_change_master() ? changeMaster(user, order)
                                  : orders_.obey(user, order, presentation_.unpublished(), now);
    if (simulationThread_ && !isLockstep())
        simulationThread_->freeze(orders_.control().wanted().freeze());
    for (const world::ReleaseHunter& called : orders_.hunters().take())
        bring(called, "a hunter does not come");
    sender_.say(from.peer, std::move(message));
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
    } else if (wanted != standby_.inStep()) {
        reply.set_reason(legible(wanted, wire::kMostNameBytes) + " does not stand by" +
                         (standby_.inStep().empty() ? "" : ", but " + standby_.inStep()));
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
        if (!seat.peer.empty()) sender_.dismiss(seat.peer, "the master changes");
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

void Conductor::changeShow(net::Moment now) {
    ShowControl& control = orders_.control();
    orders_.giveUpTheSilent(now);
    looks_.step(now);
    if (control.phase() == Phase::Switching) {
        if (auto world = looks_.switchToNext()) {
            simulationThread_.reset();
            // The world before is large: it ends beside the frames.
            retiring_ = std::async(std::launch::async, [old = std::move(own_)] {});
            own_ = std::move(world->simulation);
            options_.journal = std::move(world->journal);
            simulation_ = own_.get();
            standby_.beginAgain();
            startSimulation(static_cast<std::uint32_t>(world->school.size()));
        }
        dimming_.black.reset();
    }
    // Nobody draws, so nobody has to see black.
    if (control.phase() == Phase::Fading && !presentation_.barrier().hasMembers())
        control.blackShown();
    keeper_.keep(control.kept());
}

void Conductor::startSimulation(std::uint32_t fish) {
    presentation_.enterWorld(simulation_->recordedRates());
    // In lockstep no clock is read.
    if (!isLockstep())
        day_.begin(*simulation_, orders_.control().wanted().day(), net::monotonicNow());
    drawings_.enter(simulation_->drawingSlots());
    orders_.hunters().enter(simulation_->hunters());
    std::optional<Tick> lastTick;
    if (isLockstep() && options_.frames)
        lastTick = Tick{simulation_->tick().value + *options_.frames - 1};
    simulationThread_ = std::make_unique<SimulationThread>(
        *simulation_, options_.pace, lastTick, [this] { channels_->wake(); });
    if (!isLockstep()) simulationThread_->freeze(orders_.control().wanted().freeze());
    visitors_.enter(simulationThread_.get(), fish);
}

std::optional<Snapshot> Conductor::takeTick() {
    std::optional<Snapshot> tick = simulationThread_->take();
    if (tick && tick->tick.value % kTicksBetweenDrawings == 0) turnDrawings(*tick);
    return tick;
}

void Conductor::turnDrawings(const Snapshot& newest) {
    drawings_.turn(
        newest.fish,
        orders_.control().wanted().drawings(),
        net::monotonicNow(),
        static_cast<std::uint64_t>(unixNow()),
        [this](const world::WorldInput& input) { return bring(input, "a drawing waits"); });
}

bool Conductor::bring(const world::WorldInput& input, const char* what) {
    const bool isTaken = simulationThread_->betweenTicks(
        [input](Simulation& simulation) { simulation.apply(input); });
    if (!isTaken) logWarning("{}: the world is busy", what);
    return isTaken;
}

// On the way to the next scene it is noted when light went, for the log, and which frame is black.
const v1::Show& Conductor::showOf(Frame frame, net::Moment now) {
    ShowControl& control = orders_.control();
    if (options_.log != nullptr) options_.log->masterFrame = frame.value;
    if (!isLockstep()) dimming_.brightness = control.brightness(now);
    const bool fades = control.phase() == Phase::Fading;
    if (fades && !dimming_.since) dimming_.since = now;
    if (fades && dimming_.brightness == 0 && !dimming_.black) dimming_.black = frame;
    const auto light = static_cast<float>(control.wanted().brightness());
    if (!fades && dimming_.brightness == light && dimming_.since)
        logInfo("through black in {:.1f} s",
                std::chrono::duration<double>(now - *std::exchange(dimming_.since, {})).count());
    return shown_ = shown(now);
}

void Conductor::onReleased(Frame frame) {
    if (dimming_.black && *dimming_.black <= frame) orders_.control().blackShown();
}

v1::Show Conductor::shown(net::Moment now) const {
    const ShowControl& control = orders_.control();
    const auto& scan = orders_.scan().pattern();
    v1::Show show;
    show.set_version(control.version() + orders_.scan().changes());
    show.set_look(control.look());
    show.set_scene(looks_.sceneName());
    show.set_quality(static_cast<std::uint32_t>(looks_.quality()));
    show.set_pattern(scan ? v1::PATTERN_SCAN
                          : static_cast<v1::Pattern>(control.wanted().pattern()));
    show.set_black(control.wanted().black());
    show.set_brightness(
        static_cast<std::uint32_t>(std::lround(wire::kFullLight * dimming_.brightness)));
    show.set_frozen(control.wanted().freeze());
    show.set_colour_returned(static_cast<std::uint32_t>(
        std::lround(double{wire::kAllColour} * looks_.colourReturned())));
    show.set_pilot(pilotName(now));
    if (const auto& skins = drawings_.skins()) show.set_skins(wire::bytesOf(*skins));
    show.set_calibration(looks_.calibration());
    if (scan) wire::writeScanPattern(*scan, *show.mutable_scan());
    const v1::Sign* const sign = orders_.sign().sign();
    if (sign != nullptr && control.wanted().guests()) *show.mutable_sign() = *sign;
    return show;
}

std::string Conductor::pilotName(net::Moment now) const {
    const auto pilot = visitors_.pilot(now);
    if (!pilot) return {};
    const auto seat = roster_.of(*pilot);
    return seat ? roster_.seats()[*seat].name : "pilot";
}

}  // namespace aquarama::conductor
