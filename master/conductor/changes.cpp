// SPDX-License-Identifier: Apache-2.0
// How a show comes to show what is set: another world is made beside the present one, nodes build
// its look behind their pictures, and the wall goes through black to it.
#include <algorithm>
#include <cassert>
#include <chrono>
#include <span>
#include <utility>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/wire/messages.h"
#include "master/conductor/conductor.h"

namespace aquarama::conductor {
namespace {

using Phase = ShowControl::Phase;

constexpr net::Instant kRepeat = std::chrono::seconds(1);
// To build a look; software OpenGL on a busy machine takes some ten seconds.
constexpr net::Instant kMostPreparing = std::chrono::seconds(120);
// Requests that are known again when they are repeated.
constexpr std::size_t kRemembered = 16;

template <class Result>
bool isReady(const std::future<Result>& future) {
    return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

// The files of a rig that has changed, with their digests; none where it has not.
std::map<std::string, std::pair<Digest, net::Blob>> filesOf(const std::optional<config::Rig>& rig) {
    std::map<std::string, std::pair<Digest, net::Blob>> files;
    if (!rig) return files;
    for (const auto& [name, content] : rig->files)
        files.emplace(name, std::pair{digestOf(std::span{*content}), content});
    return files;
}

}  // namespace

std::optional<config::QualityTier> Conductor::measuredTier() const {
    std::optional<config::QualityTier> least;
    for (const ChannelSlot& slot : slots_) {
        if (!slot.bears) return std::nullopt;
        least = std::min(least.value_or(*slot.bears), *slot.bears);
    }
    return least;
}

std::string Conductor::objectionToScene(const std::string& scene) const {
    if (scene != control_.wanted().scene && !options_.makeWorld) return options_.whyOneScene;
    if (scene.find_first_of("/\\") != std::string::npos || scene.ends_with(".txtpb"))
        return "a scene is named without folder and ending";
    return {};
}

std::string Conductor::objectionToQuality(v1::WantedShow::Tier quality) const {
    if (quality == v1::WantedShow::AUTO && !measuredTier())
        return "not every node has measured which quality it bears; that is done when a show "
               "starts without a chosen quality";
    return {};
}

std::string Conductor::objectionTo(const v1::WantedShow& show) const {
    if (isLockstep()) return "a show in lockstep is the same every time; run it with --live";
    const bool isOfLook = show.has_scene() || show.has_quality() || show.has_pattern();
    if (scan_.pattern() && isOfLook) return "a scan holds the wall; wait for its end, or end it";
    std::string objection;
    if (show.has_scene()) objection = objectionToScene(show.scene());
    if (show.has_quality() && objection.empty()) objection = objectionToQuality(show.quality());
    return objection;
}

Answer Conductor::change(const std::string& user, const v1::Order& order) {
    if (std::string objection = objectionTo(order.show()); !objection.empty())
        return {Outcome::Refused, std::move(objection)};
    const ShowChange change = wire::changeIn(order.show());
    const std::uint64_t before = control_.version();
    Answer answer = control_.set(order.request(), change);
    if (simulationThread_) simulationThread_->freeze(control_.wanted().freeze);
    if (control_.version() != before) logInfo("{} sets {}", user, textOf(change));
    return answer;
}

// A wall that is set black stays black, whoever scans it.
std::string Conductor::objectionToScan() const {
    if (isLockstep()) return "a show in lockstep is the same every time; run it with --live";
    if (control_.wanted().black) return "the wall is set black; set black off for a scan";
    if (control_.phase() != Phase::Steady) return "another change is under way; wait for its end";
    return {};
}

std::string Conductor::notShowingScan() const {
    std::string missing;
    for (const ChannelSlot& slot : slots_) {
        const bool isThere = slot.prepared && !slot.peer.empty();
        if (isThere && scan_.first() <= slot.released) continue;
        missing += (missing.empty() ? "" : ", ") + slot.name + (isThere ? " (late)" : " (absent)");
    }
    return missing;
}

Frame Conductor::newestReleased() const {
    return std::ranges::max(slots_, {}, &ChannelSlot::released).released;
}

Answer Conductor::scan(const std::string& user, const v1::HeldScan& scan, net::Instant now) {
    if (!scan.has_pattern()) {
        scan_.end(scan.holder());
        return {};
    }
    if (std::string objection = objectionToScan(); !objection.empty())
        return {Outcome::Refused, std::move(objection)};
    const auto pattern = wire::readScanPattern(scan.pattern());
    const bool begins = !scan_.pattern();
    if (!scan_.hold(scan.holder(), pattern.value(), std::max(unpublished_, Frame{1}), now))
        return {Outcome::Refused, "another scan holds the wall; wait for its end, or end it"};
    if (begins) logInfo("{} holds the wall for a scan", user);
    const std::string missing = notShowingScan();
    return missing.empty() ? Answer{} : Answer{Outcome::Waiting, "not shown yet by " + missing};
}

std::string Conductor::objectionToEnding(const std::string& channel) const {
    if (isLockstep()) return "a node of a show in lockstep is not restarted";
    const auto node = seatNamed(channel);
    if (!node) return "the rig has no channel " + channel;
    if (slots_[*node].peer.empty()) return channel + " is absent: start it on its machine";
    return {};
}

Answer Conductor::restart(const std::string& user, const v1::Order& order) {
    if (std::ranges::find(restarts_, order.request()) != restarts_.end()) return {};
    const std::string& channel = order.restart().channel();
    if (std::string objection = objectionToEnding(channel); !objection.empty())
        return {Outcome::Refused, std::move(objection)};
    restarts_.push_back(order.request());
    if (restarts_.size() > kRemembered) restarts_.pop_front();
    logInfo("{} restarts node {}", user, channel);
    v1::Envelope message;
    *message.mutable_order() = order;
    say(slots_[*seatNamed(channel)].peer, std::move(message));
    return {};
}

// Nodes of another build do not say whether their machine takes the word.
std::string Conductor::objectionToPower(const v1::Order& order) const {
    const std::string& channel = order.power().channel();
    if (std::string objection = objectionToEnding(channel); !objection.empty()) return objection;
    const auto& report = slots_[*seatNamed(channel)].report;
    if (!report) return "nothing is known of the machine of " + channel + " yet; say it again";
    if (report->takes_power_word()) return {};
    return "the machine of " + channel + " takes no such word; set up aquarama-power.path there";
}

Answer Conductor::answerTo(const PowerRequest& request, net::Instant now) const {
    constexpr net::Instant kPatience = std::chrono::seconds(3);
    const std::string machine = "the machine of " + slots_[request.node].name;
    if (request.answer) return *request.answer;
    if (now - request.said < kPatience) return {Outcome::Waiting, machine + " is told"};
    return {Outcome::Lost, machine + " has not answered; look whether it ends"};
}

// Said once: a word that was lost is not said again by itself.
Answer Conductor::switchMachine(const std::string& user, const v1::Order& order, net::Instant now) {
    const auto known = std::ranges::find(powerRequests_, order.request(), &PowerRequest::request);
    if (known != powerRequests_.end()) return answerTo(*known, now);
    if (std::string objection = objectionToPower(order); !objection.empty())
        return {Outcome::Refused, std::move(objection)};
    powerRequests_.push_back({order.request(), *seatNamed(order.power().channel()), now, {}});
    if (powerRequests_.size() > kRemembered) powerRequests_.pop_front();
    const PowerRequest& request = powerRequests_.back();
    logInfo("{} switches the machine of {}: {}",
            user,
            order.power().channel(),
            order.power().word() == v1::Power::POWEROFF ? "poweroff" : "reboot");
    v1::Envelope message;
    *message.mutable_order() = order;
    say(slots_[request.node].peer, std::move(message));
    return answerTo(request, now);
}

void Conductor::switched(std::size_t node, const v1::OrderReply& reply) {
    const auto known = std::ranges::find(powerRequests_, reply.request(), &PowerRequest::request);
    if (known != powerRequests_.end() && known->node == node)
        known->answer = {static_cast<Outcome>(reply.outcome()), reply.reason()};
}

Answer Conductor::carryOut(const std::string& user, const v1::Order& order, net::Instant now) {
    if (order.run() != 0 && order.run() != session_)
        return {Outcome::Refused,
                "the show was started again meanwhile: look, and say it once more"};
    if (order.has_scan()) return scan(user, order.scan(), now);
    if (order.has_restart()) return restart(user, order);
    if (order.has_power()) return switchMachine(user, order, now);
    return change(user, order);
}

// Whoever shows no key is an account of this machine.
void Conductor::obey(const net::FromPeer& from, const v1::Order& order, net::Instant now) {
    const std::string user = from.user.empty() ? "somebody here" : from.user;
    const Answer answer = carryOut(user, order, now);
    v1::Envelope message;
    v1::OrderReply& reply = *message.mutable_order_reply();
    if (order.has_scan() && answer.outcome == Outcome::Done)
        reply.set_frame(newestReleased().value);
    reply.set_request(order.request());
    reply.set_outcome(static_cast<v1::OrderReply::Outcome>(answer.outcome));
    reply.set_reason(answer.reason);
    say(from.peer, std::move(message));
}

void Conductor::changeShow(net::Instant now) {
    if (scan_.expires(now)) logWarning("a scan has fallen silent: the wall shows what it did");
    if (control_.phase() == Phase::Steady) watchRigFiles(now);
    if (control_.phase() == Phase::Making) makeNextWorld();
    if (control_.phase() == Phase::Preparing) prepareNodes(now);
    if (control_.phase() == Phase::Switching) switchLook();
    // Nobody draws, so nobody has to see black.
    if (control_.phase() == Phase::Fading && !barrier_.hasMembers()) control_.blackShown();
    keepWhatWasSet();
}

void Conductor::watchRigFiles(net::Instant now) {
    constexpr net::Instant kBetween = std::chrono::seconds(1);
    if (!options_.changedRig || isLockstep()) return;
    if (!rereading_.valid() && now - lastReread_ > kBetween) {
        lastReread_ = now;
        rereading_ = std::async(std::launch::async,
                                [&changed = options_.changedRig] { return filesOf(changed()); });
    }
    if (!isReady(rereading_)) return;
    try {
        auto files = rereading_.get();
        RigFiles next;
        for (const auto& [name, file] : files) next.emplace(name, file.first);
        if (next.empty() || next == rigFiles_ || !control_.renew()) return;
        nextRigFiles_ = std::move(next);
        for (auto& [name, file] : files) blobs_.try_emplace(file.first, std::move(file.second));
        logInfo("the files of the wall have changed; nodes build them");
    } catch (const Error& problem) {
        logWarning("the wall stays as it is: {}", problem.what());
    }
}

void Conductor::nameRigFiles(v1::Look& look, const RigFiles& files) {
    look.clear_rig_files();
    for (const auto& [name, digest] : files) {
        v1::RigFile& file = *look.add_rig_files();
        file.set_name(name);
        file.set_digest(wire::bytesOf(digest));
    }
}

void Conductor::forgetRigFiles(const RigFiles& old, const RigFiles& kept) {
    for (const auto& [name, digest] : old)
        if (std::ranges::none_of(
                kept, [&gone = digest](const auto& file) { return file.second == gone; }))
            blobs_.erase(digest);
}

void Conductor::makeNextWorld() {
    if (!making_.valid())
        making_ = std::async(std::launch::async, [this, scene = control_.next().scene] {
            return options_.makeWorld(scene);
        });
    if (!isReady(making_)) return;
    try {
        made_ = making_.get();
        blobs_.merge(blobsOf(made_->assets));
        control_.made();
    } catch (const Error& problem) {
        logWarning("the scene stays: {}", problem.what());
        control_.fail(problem.what());
    }
}

void Conductor::announceNextLook(net::Instant now) {
    nextLook_ = std::make_unique<v1::Look>(made_ ? lookOf(made_->assets, made_->school) : *look_);
    nameRigFiles(*nextLook_, nextRigFiles_.value_or(rigFiles_));
    nextLook_->set_number(control_.nextLook());
    nextLook_->set_world(control_.nextHasWorld());
    const auto& quality = control_.next().quality;
    if (const auto tier = quality ? quality : measuredTier())
        nextLook_->set_quality(static_cast<std::uint32_t>(*tier));
    v1::Envelope message;
    *message.mutable_prepare()->mutable_look() = *nextLook_;
    prepare_ = wire::encode(session_, std::move(message));
    preparingSince_ = now;
    lastPrepare_ = {};
}

// Those that take part are waited for; one that comes later builds it before it is switched to, or
// joins anew after that.
void Conductor::prepareNodes(net::Instant now) {
    if (!nextLook_) announceNextLook(now);
    const bool isDue = now - lastPrepare_ > kRepeat;
    if (isDue) lastPrepare_ = now;
    std::string missing;
    for (const ChannelSlot& slot : slots_) {
        if (!slot.prepared || slot.builtLook == nextLook_->number()) continue;
        missing += (missing.empty() ? "" : ", ") + slot.name;
        if (isDue) channels_->sendControl(slot.peer, prepare_);
    }
    if (missing.empty()) return control_.prepared();
    control_.setWaitingFor("prepared by all nodes but " + missing);
    if (now - preparingSince_ > kMostPreparing) giveUpNextLook(missing);
}

void Conductor::giveUpNextLook(const std::string& missing) {
    logWarning("the wall stays as it is: {} did not build the next look in time", missing);
    if (nextRigFiles_) forgetRigFiles(*nextRigFiles_, rigFiles_);
    nextRigFiles_.reset();
    control_.fail("not prepared within two minutes by " + missing + "; see its log");
    nextLook_.reset();
    made_.reset();
}

void Conductor::switchLook() {
    assert(nextLook_);
    if (nextRigFiles_) {
        forgetRigFiles(rigFiles_, *nextRigFiles_);
        rigFiles_ = std::move(*nextRigFiles_);
        nextRigFiles_.reset();
    }
    look_ = std::move(nextLook_);
    if (made_) {
        simulationThread_.reset();
        // The world before is large: it ends beside the frames.
        retiring_ = std::async(std::launch::async, [old = std::move(own_)] {});
        own_ = std::move(made_->simulation);
        simulation_ = own_.get();
        fishOfSchool_ = static_cast<std::uint32_t>(made_->school.size());
        made_.reset();
        snapshots_ = {};
        startSimulation();
    }
    black_.reset();
    control_.switched();
    welcomeToLook();
    logInfo("showing look {}: scene {}, quality {}",
            control_.look(),
            control_.wanted().scene,
            config::nameOf(quality()));
}

void Conductor::startSimulation() {
    std::optional<Tick> lastTick;
    if (isLockstep() && options_.frames) lastTick = Tick{*options_.frames - 1};
    simulationThread_ = std::make_unique<SimulationThread>(
        *simulation_, options_.pace, lastTick, [this] { channels_->wake(); });
    if (!isLockstep()) simulationThread_->freeze(control_.wanted().freeze);
}

void Conductor::welcomeToLook() {
    v1::Envelope message;
    v1::Welcome& welcome = *message.mutable_welcome();
    calibration_ = wire::calibrationOf(rigText_, *look_);
    welcome.set_rig_text(rigText_);
    welcome.set_state_address(channels_->stateAddress());
    welcome.set_pace(static_cast<v1::Pace>(options_.pace));
    *welcome.mutable_look() = *look_;
    welcome_ = wire::encode(session_, std::move(message));
    const std::filesystem::path scene = control_.wanted().scene;
    sceneName_ = scene.stem().string().substr(0, wire::kMostNameBytes);
}

wire::Show Conductor::shown(net::Instant now) const {
    const WantedShow& wanted = control_.wanted();
    const bool isScan = scan_.pattern().has_value();
    return {.version = control_.version() + scan_.changes(),
            .look = control_.look(),
            .scene = sceneName_,
            .quality = quality(),
            .pattern = isScan ? wire::Pattern::Scan : wanted.pattern,
            .black = wanted.black,
            .brightness = brightness_,
            .frozen = wanted.freeze,
            .pilot = pilotName(now),
            .calibration = calibration_,
            .scan = scan_.pattern()};
}

// On the way to the next scene it is noted when light went, for the log, and which frame is black.
void Conductor::dim(net::Instant now, Frame frame) {
    if (isLockstep()) return;
    brightness_ = control_.brightness(now);
    const bool fades = control_.phase() == Phase::Fading;
    if (fades && !dimmedSince_) dimmedSince_ = now;
    if (fades && brightness_ == 0 && !black_) black_ = frame;
    if (brightness_ < 1 || !dimmedSince_) return;
    logInfo("through black in {:.1f} s",
            std::chrono::duration<double>(now - *std::exchange(dimmedSince_, {})).count());
}

// A disk may take its time: the frames do not wait for it.
void Conductor::keepWhatWasSet() {
    if (isReady(keeping_))
        if (const std::string problem = keeping_.get(); !problem.empty())
            warnOnceOf(options_.keptAt, problem, "what was set is lost with the next start");
    if (options_.keptAt.empty() || keeping_.valid() || control_.kept() == keptOnDisk_) return;
    keptOnDisk_ = control_.kept();
    keeping_ = std::async(std::launch::async,
                          [path = options_.keptAt, kept = keptOnDisk_]() -> std::string {
                              try {
                                  wire::keepShow(path, kept);
                                  return {};
                              } catch (const Error& problem) {
                                  return problem.what();
                              }
                          });
}

}  // namespace aquarama::conductor
