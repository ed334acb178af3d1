// SPDX-License-Identifier: Apache-2.0
#include "releases/agent.h"

#include <algorithm>
#include <chrono>

#include "common/base/log.h"

namespace aquarama::releases {

namespace {

constexpr double kBetweenReports = 1;  // seconds
constexpr double kBetweenAsking = 2;   // until a piece is asked for again
constexpr auto kAgentSleep = std::chrono::milliseconds(100);

// A damaged memory is none: the machine then asks before it shows anything.
FollowerMemory memoryIn(const std::filesystem::path& file) {
    try {
        return keptFollower(file).value_or(FollowerMemory{});
    } catch (const Error& problem) {
        logWarning("{}; the depot is asked first", problem.what());
        return {};
    }
}

ReleaseFollower followerOf(const FollowerMemory& memory,
                           const Machine::Started& started,
                           const Shelf& shelf) {
    return {memory, releases::idIn(shelf.folderOf(started.version)), started.boot};
}

}  // namespace

Agent::Agent(AgentSetup setup, std::unique_ptr<net::NodeChannels> channels)
    : setup_{std::move(setup)},
      channels_{std::move(channels)},
      machine_{setup_.program},
      shelf_{setup_.system},
      kept_{memoryIn(setup_.memory)},
      follower_{followerOf(kept_, machine_.started(), shelf_)} {
    logInfo("release {} runs", follower_.booted().version);
}

void Agent::stop() {
    isOver_ = true;
    channels_->wake();
}

void Agent::run() {
    while (!isOver_) {
        switchChannels();
        const double now = net::monotonicSeconds();
        if (now - reportedAt_ >= kBetweenReports) report();
        if (copy_ && now - askedAt_ >= kBetweenAsking) askPiece();
        channels_->wait(kAgentSleep);
        while (const auto packet = isOver_ ? std::nullopt : channels_->receiveControl())
            if (const auto message = decode(*packet)) hear(*message);
    }
}

// What is shown follows the word of the depot, and ends with its lease.
void Agent::switchChannels() {
    const bool mayShow = follower_.mayShow(net::monotonicSeconds());
    if (isShown_ == mayShow) return;
    machine_.show(mayShow);
    isShown_ = mayShow;
}

std::vector<ReleaseId> Agent::held() const {
    std::vector<ReleaseId> held = shelf_.good();
    held.insert(held.end(), checked_.begin(), checked_.end());
    return held;
}

// A lease begins before the report leaves. Frames count while a release is on trial.
void Agent::report() {
    reportedAt_ = net::monotonicSeconds();
    const bool isOnTrial = isShown_ == true && kept_.settled != follower_.booted();
    const MachineReport report{.booted = follower_.booted(),
                               .epoch = follower_.epoch(),
                               .held = held(),
                               .frames = isOnTrial ? machine_.frames() : 0,
                               .leftIn = follower_.leftIn(),
                               .problem = problem_};
    v1::DepotMessage message;
    write(report, *message.mutable_report());
    message.mutable_report()->set_place(setup_.place);
    message.mutable_report()->set_sent_s(reportedAt_);
    channels_->sendControl(encode(message));
}

void Agent::hear(const v1::DepotMessage& message) {
    if (message.has_order()) obey(message.order());
    if (message.has_piece()) take(message.piece());
}

// Whether the release may be started: the boot loader holds it for good, or it was checked.
bool Agent::isWhole(const ReleaseId& release) {
    const std::vector<ReleaseId> known = held();
    if (std::ranges::find(known, release) != known.end()) return true;
    try {
        if (checkRelease(shelf_.folderOf(release.version), setup_.key).id != release) return false;
    } catch (const Error&) {
        return false;
    }
    checked_.push_back(release);
    return true;
}

// An order is of this moment: what was not done for the one before is dropped.
void Agent::obey(const v1::MachineOrder& message) {
    const MachineOrder order = orderIn(message);
    if (order.epoch != follower_.epoch()) {
        problem_.clear();
        failed_ = {};
    }
    if (order.run && order.run != follower_.booted()) static_cast<void>(isWhole(order.run));
    const FollowerDuties duties =
        follower_.obey(order, held(), message.answers_s(), message.lease_s());
    if (duties.isDark) switchChannels();
    if (duties.start) return start(duties.start);
    if (duties.isBlessed)
        shelf_.change(stepsToBless(shelf_.entries(), follower_.booted()), machine_);
    remember();
    if (!duties.fetch) copy_.reset();
    if (duties.fetch && !copy_) fetch(duties.fetch);
}

void Agent::remember() {
    if (kept_ == follower_.memory()) return;
    keep(follower_.memory(), setup_.memory);
    kept_ = follower_.memory();
}

void Agent::start(const ReleaseId& release) {
    logInfo("the machine starts with release {}", release.version);
    shelf_.change(stepsToStart(shelf_.entries(), release), machine_);
    remember();
    machine_.reboot();
    isOver_ = true;
}

// Room is made first: only the release that runs, and the new one, stay.
void Agent::fetch(const ReleaseId& release) {
    if (failed_ == release || isWhole(release)) return;
    try {
        shelf_.keepOnly({follower_.booted(), release}, machine_);
        copy_.emplace(release, follower_.booted(), shelf_.folderOf(release.version), setup_.key);
        askPiece();
    } catch (const Error& problem) {
        fail(release, problem.what());
    }
}

void Agent::askPiece() {
    askedAt_ = net::monotonicSeconds();
    const auto wanted = copy_->wanted();
    v1::DepotMessage message;
    message.mutable_piece_request()->set_version(wanted->version);
    message.mutable_piece_request()->set_file(wanted->file);
    message.mutable_piece_request()->set_offset(wanted->offset);
    channels_->sendControl(encode(message));
}

void Agent::take(const v1::ReleasePiece& piece) {
    if (!copy_) return;
    const ReleaseId release = copy_->release();
    try {
        const WantedPiece place{piece.version(), piece.file(), piece.offset()};
        if (place != copy_->wanted()) return;
        copy_->take({place,
                     piece.has_total() ? std::optional(piece.total()) : std::nullopt,
                     std::as_bytes(std::span(piece.content()))});
        if (copy_->wanted()) return askPiece();
        logInfo("release {} is here, whole", release.version);
        checked_.push_back(release);
        copy_.reset();
    } catch (const Error& problem) {
        fail(release, problem.what());
    }
}

void Agent::fail(const ReleaseId& release, const std::string& problem) {
    logWarning("{}", problem);
    problem_ = problem;
    failed_ = release;
    copy_.reset();
}

}  // namespace aquarama::releases
