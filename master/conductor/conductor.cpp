// SPDX-License-Identifier: Apache-2.0
// The frame loop. Who comes and goes is in reception.cpp.
#include "master/conductor/conductor.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <random>
#include <utility>

#include <glm/geometric.hpp>

#include "common/base/log.h"
#include "common/wire/messages.h"

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;

// Time for a release to reach every node: ten times the median of a busy machine's loopback.
constexpr net::Instant kLead = milliseconds(2);
// A state is published so long before the release of the frame before it: nodes begin to draw then.
constexpr net::Instant kPublishLead = milliseconds(3);
// A frame shows the world as it was so long before its release, which is a refresh after the one
// before: the two ticks on either side are simulated when it is published.
constexpr net::Instant kShownAge = 2 * kTickPeriod + kPublishLead + milliseconds(1);
constexpr net::Instant kBeacon = milliseconds(50);
constexpr net::Instant kRepeat = std::chrono::seconds(1);
constexpr net::Instant kLongestWait = milliseconds(10);
constexpr std::size_t kMostNodes = 64;  // as many as a rig has channels

net::Instant fromSeconds(double seconds) {
    return std::chrono::duration_cast<net::Instant>(std::chrono::duration<double>(seconds));
}

BarrierLimits limitsOf(const config::Timing& timing, const ConductorOptions& options) {
    const double deadline = timing.presentDeadlineSeconds > 0 ? timing.presentDeadlineSeconds
                                                              : 1.0 / timing.refreshHertz;
    return {options.pace == wire::Pace::Lockstep,
            fromSeconds(deadline),
            fromSeconds(timing.membershipSeconds),
            options.patience};
}

std::vector<std::string> namesOf(const config::Rig& rig, const ConductorOptions& options) {
    if (!options.expected.empty()) return options.expected;
    std::vector<std::string> names;
    for (const config::Channel& channel : rig.channels) names.push_back(channel.name);
    return names;
}

// From no seed: two runs must not be taken for one another.
std::uint64_t freshSession() {
    std::random_device device;
    const std::uint64_t high = device();
    return (high << 32U | device()) | 1U;  // never 0
}

GrowingFile openTrace(const std::filesystem::path& directory) {
    if (directory.empty()) return {};
    GrowingFile trace(directory / "master.csv");
    trace.append("frame,state_ns,ready_ns,present_ns\n");
    return trace;
}

}  // namespace

Blobs blobsOf(const wire::AssetBundle& assets) {
    Blobs blobs;
    for (const wire::SpeciesAssets& species : assets.cast) {
        const auto text = std::as_bytes(std::span{species.text});
        blobs.emplace(digestOf(text),
                      std::make_shared<const net::ByteVector>(text.begin(), text.end()));
        blobs.emplace(digestOf(species.repertoire),
                      std::make_shared<const net::ByteVector>(species.repertoire));
    }
    return blobs;
}

v1::Look lookOf(const wire::AssetBundle& assets, std::span<const motion::FishTraits> school) {
    v1::Look look;
    look.set_scene_text(assets.scene);
    look.set_seed(assets.seed);
    for (const motion::FishTraits& fish : school) {
        look.add_fish_ids(fish.id);
        look.add_length_millimetres(fish.lengthMillimetres);
    }
    for (const wire::SpeciesAssets& species : assets.cast) {
        v1::SpeciesBlobs& member = *look.add_cast();
        member.set_species(wire::bytesOf(digestOf(species.text)));
        member.set_repertoire(wire::bytesOf(digestOf(species.repertoire)));
        member.set_fish(species.fish);
    }
    return look;
}

Conductor::Conductor(const config::Rig& rig,
                     ConductorOptions options,
                     Simulation& simulation,
                     const wire::AssetBundle& assets,
                     std::span<const motion::FishTraits> school,
                     std::unique_ptr<net::MasterChannels> channels)
    : options_(std::move(options)),
      simulation_(&simulation),
      fishOfSchool_(static_cast<std::uint32_t>(school.size())),
      rigText_(rig.text),
      control_(options_.wanted, options_.kept),
      windowsEndShow_(rig.windowsEndShow),
      look_(std::make_unique<v1::Look>(lookOf(assets, school))),
      blobs_(blobsOf(assets)),
      channels_(std::move(channels)),
      session_(freshSession()),
      barrier_(namesOf(rig, options_).size(), limitsOf(rig.timing, options_), net::monotonicNow()),
      refresh_(fromSeconds(1.0 / rig.timing.refreshHertz)),
      deadline_(limitsOf(rig.timing, options_).deadline),
      trace_(openTrace(options_.traceDirectory)),
      keptOnDisk_(options_.kept),
      metrics_(isLockstep() ? std::uint16_t{0} : rig.metricsPort) {
    assert(rig.channels.size() <= kMostNodes);
    for (const std::string& name : namesOf(rig, options_)) {
        slots_.emplace_back().name = name;
        const auto channel = std::ranges::find(rig.channels, name, &config::Channel::name);
        slots_.back().machine = channel->machine;
    }
    figures_ = makeFigures();
    for (const auto& [name, content] : rig.files) {
        const Digest digest = digestOf(std::span{*content});
        rigFiles_.emplace(name, digest);
        blobs_.emplace(digest, content);
    }
    nameRigFiles(*look_, rigFiles_);
    look_->set_number(control_.look());
    look_->set_world(control_.hasWorld());
    if (const auto& quality = control_.wanted().quality)
        look_->set_quality(static_cast<std::uint32_t>(*quality));
    welcomeToLook();
    v1::Envelope beacon;
    beacon.mutable_beacon();
    beacon_ = wire::encode(session_, std::move(beacon));
}

Conductor::~Conductor() = default;

void Conductor::stop() {
    stopped_ = true;
    channels_->wake();
}

ShowReport Conductor::run() {
    over_ = options_.frames == 0U;
    if (!isLockstep() && !net::runInRealTime())
        logInfo(
            "no real-time priority: frames are late where this machine is busy; "
            "docs/cluster.md says how to allow it");
    startSimulation();
    if (options_.service != nullptr) options_.service->ready();
    while (!over_ && !stopped_) {
        const net::Instant now = net::monotonicNow();
        hear(now);
        takeTicks();
        answer();
        changeShow(now);
        conduct(now);
        nameMissing(now);
        count(now);
        sayAlive(now);
        if (now - lastPublished_ > kBeacon) {
            channels_->publishState(beacon_);
            lastPublished_ = now;
        }
        channels_->wait(untilDue());
    }
    if (options_.service != nullptr) options_.service->stopping();
    simulationThread_.reset();
    sayFarewell();
    if (keeping_.valid()) keeping_.wait();
    keepWhatWasSet();
    trace_.close();
    if (!failure_.empty()) throw Error(failure_);
    return report_;
}

// In the log, every few seconds: nodes of other machines are started by other hands.
void Conductor::nameMissing(net::Instant now) {
    constexpr net::Instant kBetweenRolls = std::chrono::seconds(5);
    if (now - lastRoll_ < kBetweenRolls) return;
    lastRoll_ = now;
    std::string missing;
    for (const ChannelSlot& slot : slots_) {
        if (!slot.peer.empty()) continue;
        missing += (missing.empty() ? "" : ", ") + slot.name;
        if (!slot.machine.empty()) missing += " (machine " + slot.machine + ")";
    }
    if (!missing.empty()) logInfo("waiting for {}", missing);
}

// Repeats the farewell until every node has answered, two seconds at most: closing a connection
// while a node still sends would discard our last message to it.
void Conductor::sayFarewell() {
    constexpr net::Instant kLongest = std::chrono::seconds(2);
    constexpr net::Instant kFarewellRepeat = std::chrono::milliseconds(100);
    const net::Instant begin = net::monotonicNow();
    net::Instant lastSaid = begin - kFarewellRepeat;
    v1::Envelope farewell;
    farewell.mutable_farewell();
    while (
        std::ranges::any_of(slots_, [](const ChannelSlot& slot) { return !slot.peer.empty(); })) {
        const net::Instant now = net::monotonicNow();
        if (now - begin > kLongest) return;
        if (now - lastSaid >= kFarewellRepeat) {
            for (const ChannelSlot& slot : slots_)
                if (!slot.peer.empty()) say(slot.peer, farewell);
            lastSaid = now;
        }
        channels_->wait(kFarewellRepeat / 4);
        hear(net::monotonicNow());
    }
}

// Lockstep takes a tick when its frame comes up, so that the tick thread waits for the frames.
void Conductor::takeTicks() {
    while (!isLockstep() || snapshots_.newest() < Tick{unpublished_.value}) {
        auto snapshot = simulationThread_->take();
        if (!snapshot) return;
        snapshots_.add(std::move(*snapshot));
    }
}

bool Conductor::isLast(Frame frame) const {
    return options_.frames && frame.value + 1 >= *options_.frames;
}

void Conductor::conduct(net::Instant now) {
    for (const std::size_t node : barrier_.expelSilent(now)) {
        ++slots_[node].dropped;
        vacate(node);
    }
    const auto decision = barrier_.decide(now);
    if (decision.verdict == PresentBarrier::Verdict::Silent) {
        failure_ = "node \"" + slots_[decision.node].name + "\" has been silent for " +
                   std::to_string(options_.patience / std::chrono::seconds(1)) +
                   " s; see its own output, and start the show again";
        over_ = true;
        return;
    }
    if (!drawing_) return beginNext(now);
    // As late as possible, so that what it shows is fresh; early enough to be there on time.
    const bool isDue = isLockstep() || now + kPublishLead >= nextRelease(now);
    if (barrier_.anyReady() && isDue && !isLast(next_)) publish({next_.value + 1}, now);
    if (decision.verdict == PresentBarrier::Verdict::Present) return release(now);
    if (decision.verdict == PresentBarrier::Verdict::Idle) {
        if (const auto awaited = barrier_.nextAwaited()) {
            next_ = *awaited;
            beginNext(now);
        }
    }
    if (now - lastRepeat_ > repeatAfter_) publishAgain(now);
}

void Conductor::beginNext(net::Instant now) {
    const bool mayBegin = isLockstep()
                              ? barrier_.allPrepared()
                              : barrier_.hasMembers() && now + kPublishLead >= lastRelease_;
    drawing_ = mayBegin && publish(next_, now);
    if (drawing_) barrier_.begin(next_);
}

// How long the loop may sleep where nothing is heard: the next state has its time.
net::Instant Conductor::untilDue() const {
    const net::Instant due = lastRelease_ - kPublishLead - net::monotonicNow();
    return drawing_ || isLockstep() || due < net::Instant{0} ? kLongestWait
                                                             : std::min(due, kLongestWait);
}

net::Instant Conductor::nextRelease(net::Instant now) const {
    constexpr net::Instant kBelieved = std::chrono::seconds(2);
    std::array<net::Blanks, kMostNodes> displays;
    std::size_t count = 0;
    for (std::size_t node = 0; node < slots_.size(); ++node) {
        const auto& blanks = slots_[node].blanks;
        if (blanks && blanks->last > now - kBelieved && barrier_.isWaitedFor(node))
            displays[count++] = *blanks;
    }
    return releaseTime(now + kLead, lastRelease_, refresh_, std::span(displays).first(count));
}

// Of the frame that is drawn, or of the one after it.
net::Instant Conductor::releaseOf(Frame frame, net::Instant now) const {
    return nextRelease(now) + (next_ < frame ? refresh_ : net::Instant{0});
}

void Conductor::release(net::Instant now) {
    const net::Instant at = nextRelease(now);
    v1::Envelope message;
    message.mutable_present()->set_frame(next_.value);
    message.mutable_present()->set_at_ns(isLockstep() ? 0 : at.count());
    lastPresent_.emplace(next_, wire::encode(session_, std::move(message)));
    for (const ChannelSlot& slot : slots_) {
        if (slot.prepared) channels_->sendControl(slot.peer, lastPresent_->second);
    }
    if (black_ && *black_ <= next_) control_.blackShown();
    if (report_.frames++ > 0) {
        frameTimes_.add(at - lastRelease_);
        framePeak_.add(now, at - lastRelease_);
        figures_.frameSeconds(net::secondsIn(at - lastRelease_));
    }
    lastRelease_ = at;
    over_ = over_ || isLast(next_);
    drawing_ = false;
    ++next_.value;
    if (!over_) beginNext(now);
}

// True where the frame's state has been published, now or earlier.
bool Conductor::publish(Frame frame, net::Instant now) {
    if (frame < unpublished_) return true;
    takeTicks();
    auto state = isLockstep() ? snapshots_.showing(frame, Tick{frame.value})
                              : snapshots_.showing(frame, releaseOf(frame, now) - kShownAge);
    if (!state) return false;
    dim(now, frame);
    state->show = shown(now);
    state->motionHash = motion::hashOf(state->after);
    const wire::Packet& packet = published_[frame] = wire::encodeState(session_, *state);
    channels_->publishState(packet);
    publishedBytes_ += packet.size();
    if (options_.log != nullptr) options_.log->masterFrame = frame.value;
    lastPublished_ = lastRepeat_ = net::monotonicNow();
    repeatAfter_ = isLockstep() ? kRepeat : deadline_;
    if (trace_.isOpen())
        trace_.appendOrLog(fmt::format("{},{},,\n", frame.value, lastPublished_.count()));
    if (published_.size() > 2) published_.erase(published_.begin());
    unpublished_ = {frame.value + 1};
    noteEye(*state);
    report_.tick = state->tick;
    report_.worldHash = state->worldHash;
    return true;
}

void Conductor::noteEye(const wire::StateView& state) {
    const double ticks =
        static_cast<double>(state.tick.value) - 1 + static_cast<double>(state.fraction);
    const double seconds = (ticks - std::exchange(eyeTicks_, ticks)) / kTicksPerSecond;
    const float metres = glm::distance(state.eye.positionMetres, eye_.positionMetres);
    speedMetresPerSecond_ = seconds > 0 ? metres / static_cast<float>(seconds) : 0.0F;
    eye_ = state.eye;
}

// Where all wait for a state that was lost on its way, it must come again; less and less often, as
// they may just be slow.
void Conductor::publishAgain(net::Instant now) {
    for (const auto& [frame, packet] : published_) channels_->publishState(packet);
    lastRepeat_ = now;
    repeatAfter_ = std::min(2 * repeatAfter_, kRepeat);
}

void Conductor::say(const net::PeerId& peer, v1::Envelope message) {
    assert(!peer.empty());
    channels_->sendControl(peer, wire::encode(session_, std::move(message)));
}

}  // namespace aquarama::conductor
