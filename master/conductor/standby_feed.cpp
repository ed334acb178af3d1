// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/standby_feed.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/base/log.h"
#include "common/motion/motor.h"
#include "common/wire/wanted_show.h"

namespace aquarama::conductor {

namespace {

// Of one that simulates along, and of one that makes its world, where it may have to capture fish.
constexpr net::Duration kStandbySilence = std::chrono::seconds(2);
constexpr net::Duration kLongestBeginning = std::chrono::minutes(10);
constexpr net::Duration kHeartbeat = std::chrono::milliseconds(50);
// Parts on their way, fewer than fit into the queue of a socket.
constexpr std::uint64_t kMostUnderWay = 32;

bool areSame(const FollowedShow& one, const FollowedShow& other) {
    return one.scene == other.scene && wire::areSame(one.wanted, other.wanted) &&
           wire::areSame(one.kept, other.kept) && one.drawings == other.drawings;
}

}  // namespace

std::string StandbyFeed::objectionTo(const v1::Follow& follow) const {
    if (!isWanted_) return "the rig names no standby, or the show keeps no journal";
    if (follow.major() != wire::kProtocolMajor || follow.build() != AQUARAMA_VERSION)
        return fmt::format(
            "its build is {} (protocol {}), the master's {} ({}); install the same "
            "version on both",
            follow.build(),
            follow.major(),
            AQUARAMA_VERSION,
            wire::kProtocolMajor);
    static const std::uint64_t ownHash = motion::motorSelfTest();
    if (follow.motor_hash() != ownHash)
        return "its processor or build moves fish to other places; install the same version on "
               "both";
    return {};
}

void StandbyFeed::refuse(const net::PeerId& peer,
                         const v1::Follow& follow,
                         const std::string& objection) {
    constexpr std::size_t kMostObjections = 100;
    if (objections_.size() < kMostObjections && objections_.insert(objection).second)
        logWarning("refused standby {}: {}", follow.machine(), objection);
    v1::Envelope refusal;
    refusal.mutable_refusal()->set_reason(objection);
    sender_.say(peer, std::move(refusal));
}

void StandbyFeed::hear(const net::PeerId& peer, const v1::Follow& follow, net::Moment now) {
    if (const std::string objection = objectionTo(follow); !objection.empty())
        return refuse(peer, follow, objection);
    if (!peer_.empty() && follow.machine() != machine_)
        return refuse(peer, follow, machine_ + " stands by already");
    const bool isAnswered = peer == peer_ && follow.request() == request_;
    peer_ = peer;
    machine_ = follow.machine();
    request_ = follow.request();
    lastHeard_ = now;
    if (!isAnswered)
        beginAgain();
    else if (follow.stream() == stream_)  // else its beginning is on the way
        note(follow);
}

v1::StandbyStatus StandbyFeed::status(const std::string& machine, net::Moment now) const {
    v1::StandbyStatus status;
    status.set_master(machine);
    status.set_master_s(net::secondsIn(now - begun_));
    if (isInStep_) status.set_machine(machine_);
    return status;
}

void StandbyFeed::note(const v1::Follow& follow) {
    taken_ = std::clamp(follow.taken(), taken_, sentParts_);
    drawings_.reset();
    if (follow.has_drawings()) drawings_ = wire::digestIn(follow.drawings());
    if (!std::exchange(isInStep_, follow.in_step()) && isInStep_)
        logInfo("{} stands by: it simulates along", machine_);
}

void StandbyFeed::beginAgain() {
    ++stream_;
    nextPart_ = sentParts_ = taken_ = 0;
    parts_.clear();
    told_.reset();
    isInStep_ = false;
    mustBegin_ = awaitsBeginning_ = true;
}

bool StandbyFeed::takesBeginning() {
    return !peer_.empty() && std::exchange(mustBegin_, false);
}

void StandbyFeed::drop(const std::string& why) {
    logWarning("{} does not stand by any more: {}; nobody would take over", machine_, why);
    peer_.clear();
    isInStep_ = awaitsBeginning_ = false;
    parts_.clear();
}

void StandbyFeed::turn(Simulation& simulation, const FollowedShow& show, net::Moment now) {
    if (peer_.empty()) return;
    if (now - lastHeard_ > (isInStep_ ? kStandbySilence : kLongestBeginning))
        return drop("it is silent");
    if (parts_.empty()) cutNext(simulation, show, now);
    send(now);
}

void StandbyFeed::cutNext(Simulation& simulation, const FollowedShow& show, net::Moment now) {
    const auto piece = pieceOf(simulation);
    if (piece && isNews(*piece, show, now)) cut(*piece, show);
}

// Of a stream that was given up nothing is wanted any more.
std::optional<JournalPiece> StandbyFeed::pieceOf(Simulation& simulation) {
    auto piece = simulation.followed();
    if (!piece || (awaitsBeginning_ && !piece->begins)) return std::nullopt;
    awaitsBeginning_ = false;
    return piece;
}

bool StandbyFeed::isNews(const JournalPiece& piece,
                         const FollowedShow& show,
                         net::Moment now) const {
    const bool isShown = told_ && areSame(*told_, show);
    return !isShown || !piece.entries.empty() || piece.tick != tick_ ||
           now - lastSent_ > kHeartbeat;
}

void StandbyFeed::send(net::Moment now) {
    for (; !parts_.empty() && sentParts_ < taken_ + kMostUnderWay; parts_.pop_front()) {
        sender_.say(peer_, std::move(parts_.front()));
        ++sentParts_;
        lastSent_ = now;
    }
}

void StandbyFeed::cut(const JournalPiece& piece, const FollowedShow& show) {
    tick_ = piece.tick;
    std::size_t at = 0;
    do {
        const std::size_t size = std::min(piece.entries.size() - at, wire::kBlobChunkBytes);
        v1::Journalled& part = *parts_.emplace_back().mutable_journalled();
        part.set_stream(stream_);
        part.set_part(nextPart_++);
        part.set_tick(piece.tick.value);
        part.set_entries(piece.entries.data() + at, size);
        at += size;
        if (at < piece.entries.size()) part.set_goes_on(true);
    } while (at < piece.entries.size());
    if (!told_ || !areSame(*told_, show)) writeShow(show, *parts_.back().mutable_journalled());
}

void StandbyFeed::writeShow(const FollowedShow& show, v1::Journalled& part) {
    told_ = show;
    part.set_scene(show.scene);
    *part.mutable_wanted() = show.wanted;
    *part.mutable_kept() = show.kept;
    if (show.drawings) part.set_drawings(wire::bytesOf(*show.drawings));
}

void StandbyFeed::sayFarewell() {
    if (peer_.empty()) return;
    v1::Envelope farewell;
    farewell.mutable_farewell();
    sender_.say(peer_, std::move(farewell));
}

}  // namespace aquarama::conductor
