// SPDX-License-Identifier: Apache-2.0
#include "master/standby/follower.h"

#include <algorithm>
#include <span>
#include <utility>

#include "common/base/amounts.h"
#include "common/base/log.h"
#include "common/motion/motor.h"
#include "master/journal/journal.h"
#include "master/simulation/recorded_world.h"

namespace aquarama::standby {

namespace {

using std::chrono::milliseconds;

constexpr net::Duration kBetweenFollows = milliseconds(50);
constexpr std::uint64_t kMostUntold = 8;  // parts
constexpr net::Duration kLongestWait = milliseconds(5);
// A master that is silent for so long is sought by a fresh connection, as old ones may be dead
// without notice, and ZeroMQ never retries one whose key was refused.
constexpr net::Duration kSilence = std::chrono::seconds(2);
constexpr std::size_t kMostTicksATurn = 4;  // so that it is known when messages came
constexpr std::uint64_t kMostTicksBehind = 30;
// What is wrong may be put right while the master goes on: after a pause it tries again.
constexpr net::Duration kPause = std::chrono::seconds(5);
constexpr net::Duration kLongPause = std::chrono::minutes(1);

}  // namespace

Follower::Follower(FollowerOptions options)
    : options_{std::move(options)},
      channels_{options_.connect()},
      drawings_{options_.drawings,
                [this](v1::Envelope message) {
                    channels_->sendControl(wire::encode(0, std::move(message)));
                }},
      lastHeard_{net::monotonicNow()} {}

void Follower::turn() {
    const net::Moment now = net::monotonicNow();
    if (now - lastFollow_ >= kBetweenFollows || parts_.untold() >= kMostUntold) follow(now);
    if (now - lastHeard_ > kSilence) {
        channels_ = options_.connect();
        lastHeard_ = now;
    }
    hear();
    drawings_.turn(now);
    if (world_) advance(kMostTicksATurn);
}

void Follower::hear() {
    const bool isBehind = world_ && tick() < known_;
    channels_->wait(isBehind ? net::Duration{0} : kLongestWait);
    while (const auto bytes = channels_->receiveControl())
        if (const auto message = wire::decode(*bytes)) read(*message);
}

void Follower::follow(net::Moment now) {
    static const std::uint64_t ownHash = motion::motorSelfTest();
    const bool isInStep =
        hasWorld() && parts_.stream() != 0 && known_.value - tick().value < kMostTicksBehind;
    if (isInStep && std::exchange(saidInStep_, parts_.stream()) != parts_.stream())
        logInfo("{} simulates along with the master, at {}", options_.machine, timeOf(tick()));
    v1::Envelope message;
    v1::Follow& follow = *message.mutable_follow();
    follow.set_machine(options_.machine);
    follow.set_major(wire::kProtocolMajor);
    follow.set_build(AQUARAMA_VERSION);
    follow.set_motor_hash(ownHash);
    follow.set_stream(parts_.stream());
    follow.set_request(parts_.request());
    follow.set_taken(parts_.taken());
    follow.set_in_step(isInStep);
    if (const auto& list = drawings_.kept()) follow.set_drawings(wire::bytesOf(*list));
    channels_->sendControl(wire::encode(0, std::move(message)));
    parts_.told();
    lastFollow_ = now;
}

// Anything else: the master prepares.
void Follower::read(const v1::Envelope& message) {
    lastHeard_ = net::monotonicNow();
    if (message.has_journalled()) {
        take(message.journalled());
        // Of a master whose world is not here whole it is not the lease yet.
        if (parts_.stream() != 0 && !parts_.goesOn()) lease_ = message.lease_revision();
        return;
    }
    if (message.has_blob_chunk()) drawings_.take(message.blob_chunk());
    if (message.has_refusal() && refusal_ != message.refusal().reason()) {
        refusal_ = message.refusal().reason();
        logError("the master refuses the standby {}: {}", options_.machine, refusal_);
    }
    if (message.has_farewell() && hasWorld()) {
        isOver_ = true;
        logInfo("the master has ended the show");
    }
}

void Follower::take(const v1::Journalled& part) {
    if (!parts_.take(part)) return;
    if (part.has_scene()) takeShow(part);
    if (const auto piece = parts_.takePiece()) takePiece(*piece, Tick{part.tick()});
}

void Follower::takeShow(const v1::Journalled& part) {
    show_ = {part.scene(), part.wanted(), part.kept(), {}};
    if (!part.has_drawings()) return;
    show_.drawings = wire::digestIn(part.drawings());
    drawings_.want(*show_.drawings);
}

void Follower::takePiece(const wire::Packet& piece, Tick tick) {
    if (wire::isRecording(piece))
        tryToBegin(piece);
    else if (world_ && !goOn(piece))
        return parts_.askAnew();
    known_ = tick;
    clock_.add(known_, net::monotonicNow());
}

void Follower::tryToBegin(const wire::Packet& piece) {
    try {
        begin(piece);
        problem_.clear();
    } catch (const Error& error) {
        if (std::exchange(problem_, error.what()) != error.what())
            logError("{} does not stand by: {}", options_.machine, problem_);
        parts_.askAnew();
        lastFollow_ = net::monotonicNow() + kPause;
    }
}

// Its own journal begins another recording.
void Follower::begin(const wire::Packet& piece) {
    const wire::Recording sent = wire::decodeRecording(piece, "the master's world");
    if (sent.saves.size() != 1) return parts_.askAnew();
    world_.reset();
    if (sent.assets.cast.empty()) throw Error("the master's world has no species");
    const wire::SpeciesAssets& school = sent.assets.cast.front();
    const WantedWorld wanted{show_.scene, sent.assets.seed, school.fish - school.drawings};
    if (!assets_ || assetsOf_ != wanted) {
        assets_ = options_.assets(wanted);
        assetsOf_ = wanted;
    }
    if (!journal::makeOneWorld(assets_->bytes, sent.assets)) {
        assets_.reset();  // to be read again
        throw Error("scene " + show_.scene +
                    " or a species of it is another one than the master's; copy the folder of the "
                    "rig from there");
    }
    auto living = journal::emptyWorld(*assets_);
    const wire::RecordedSave& save = sent.saves.front();
    living->restore(std::span(piece).subspan(save.at, save.bytes), sent.source);
    auto journal =
        std::make_unique<journal::Journal>(options_.journal, assets_->bytes, living->world());
    world_ = std::make_unique<journal::JournalledWorld>(
        std::move(living), std::move(journal), assets_->bytes, sent.inputs);
    beginning_ = wire::beginningOf(sent.assets, wire::Repertoires::Named);
    expected_.assign(sent.checkpoints.begin(), sent.checkpoints.end());
    clock_.forget();
    isOver_ = false;
}

// Read behind the beginning, so that every bound is checked.
bool Follower::goOn(const wire::Packet& entries) {
    if (entries.empty()) return true;
    wire::Packet recording = beginning_;
    recording.insert(recording.end(), entries.begin(), entries.end());
    try {
        const wire::Recording sent = wire::decodeRecording(recording, "the master's journal");
        if (sent.bytesLeftOver != 0) return false;
        for (const wire::RecordedInput& input : sent.inputs)
            world_->applyAt(input.tick, simulation::inputOf(input));
        expected_.insert(expected_.end(), sent.checkpoints.begin(), sent.checkpoints.end());
        return true;
    } catch (const Error& error) {
        logError("{}", error.what());
        return false;
    }
}

void Follower::advance(std::size_t mostTicks) {
    for (std::size_t i = 0; i < mostTicks && world_->tick() < known_; ++i) {
        world_->advance();
        compare();
    }
}

void Follower::compare() {
    while (!expected_.empty() && expected_.front().tick <= world_->tick()) {
        const wire::RecordedHash expected = expected_.front();
        expected_.pop_front();
        if (expected.tick != world_->tick() || expected.hash == world_->hash()) continue;
        logError(
            "the world of the standby {} differs from the master's at tick {}: check this "
            "machine's memory; it takes the master's next save",
            options_.machine,
            expected.tick.value);
        parts_.askAnew();
        // A machine that is always wrong is not sent one save after the other.
        const net::Moment now = net::monotonicNow();
        if (now - std::exchange(lastDiffered_, now) < kLongPause) lastFollow_ = now + kLongPause;
        return;
    }
}

Follower::TakenOver Follower::takeOver() {
    const net::Moment begun = net::monotonicNow();
    const Tick stood = world_->tick();
    const auto due = [&] {
        const Tick now = clock_.tickAt(net::monotonicNow()).value_or(known_);
        const bool isAway = now.value > known_.value + journal::kMostTicksAway;
        return show_.wanted.freeze() || isAway ? known_ : std::max(known_, now);
    };
    while (world_->tick() < due() && net::monotonicNow() - begun < journal::kMostTimeAway)
        world_->advance();
    logInfo("{} takes over at {}; its world stood at tick {}, and goes on at tick {}",
            options_.machine,
            timeOf(world_->tick()),
            stood.value,
            world_->tick().value);
    return {std::move(world_), *std::move(assets_), show_};
}

}  // namespace aquarama::standby
