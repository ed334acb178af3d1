// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/conductor.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <utility>

#include "master/conductor/hall_clock.h"

namespace aquarama::conductor {
namespace {

using Phase = ShowControl::Phase;

// Drawings come and go once a second.
constexpr std::uint64_t kTicksBetweenDrawings = 60;

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
    // One that another machine has taken the lead from goes on as a standby.
    if (options_.service != nullptr && !options_.isSuperseded()) options_.service->stopping();
    visitors_.enter(nullptr, visitors_.fish());
    simulationThread_.reset();
    if (!options_.isSuperseded()) sayFarewell();
    keeper_.finish(orders_.control().kept());
    if (!presentation_.failure().empty()) throw Error(presentation_.failure());
    return report_;
}

void Conductor::feedStandby(net::Moment now) {
    drawings_.awaitCopy(standby_.lacks(drawings_.kept()));
    if (!standby_.isThere()) return;
    if (standby_.takesBeginning() && !simulationThread_->betweenTicks([](Simulation& simulation) {
            simulation.beginFollowed();
        }))
        standby_.beginAgain();
    const ShowControl& control = orders_.control();
    standby_.turn(*simulation_,
                  {looks_.sceneName(), control.wanted(), control.kept(), drawings_.kept()},
                  now);
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
    keeper_.keep(control.kept(), now);
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
