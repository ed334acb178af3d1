// SPDX-License-Identifier: Apache-2.0
#include "releases/depot.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/base/characters.h"
#include "common/base/dates.h"
#include "common/base/log.h"
#include "common/base/output_file.h"

namespace aquarama::releases {

namespace {

namespace fs = std::filesystem;

constexpr const char* kStateFile = "rollout.txtpb";
constexpr auto kDepotSleep = std::chrono::milliseconds(250);
constexpr double kBetweenHours = 10;  // seconds
constexpr std::size_t kMostTextBytes = 2000;

// Epochs of a depot that has lost its state are none that machines remember.
RolloutState firstState() {
    return {.epoch = static_cast<std::uint64_t>(systemSeconds())};
}

// "crew", "left" of the user "crew left".
std::pair<std::string, std::string> partsOf(const std::string& user) {
    const std::size_t space = user.find(' ');
    if (space == std::string::npos) return {};
    return {user.substr(0, space), user.substr(space + 1)};
}

// Where the machine is that this user speaks for; empty: for none.
std::string placeOf(const std::string& user) {
    const auto [role, name] = partsOf(user);
    if (role == "node" || role == "standby") return name;
    return role == "crew" ? "main" : "";
}

// A piece of a file, and the size of all of it; nothing where it cannot be read.
void readPiece(const fs::path& path, std::uint64_t offset, v1::ReleasePiece& piece) {
    std::error_code failure;
    const std::uint64_t total = fs::file_size(path, failure);
    if (failure || total > kMostReleaseFileBytes) return;
    std::ifstream file(path, std::ios::binary);
    std::string content(offset < total ? std::min<std::uint64_t>(kPieceBytes, total - offset) : 0,
                        '\0');
    file.seekg(static_cast<std::streamoff>(offset));
    file.read(content.data(), static_cast<std::streamsize>(content.size()));
    content.resize(static_cast<std::size_t>(file.gcount()));
    piece.set_total(total);
    piece.set_content(std::move(content));
}

}  // namespace

Depot::Depot(DepotSetup setup, std::unique_ptr<net::MasterChannels> channels)
    : setup_{std::move(setup)},
      channels_{std::move(channels)},
      file_{setup_.folder / kStateFile},
      kept_{keptRollout(file_)},
      rollout_{setup_.machines.names,
               kept_.value_or(firstState()),
               setup_.limits,
               net::monotonicSeconds()} {
    requireWritableFolder(setup_.folder);
    keepState();
}

void Depot::stop() {
    isOver_ = true;
    channels_->wake();
}

void Depot::run() {
    while (!isOver_) {
        channels_->wait(kDepotSleep);
        while (const auto from = channels_->receiveControl()) hear(*from);
        static_cast<void>(channels_->discardNoise());
        const double now = net::monotonicSeconds();
        endCheck(now);
        rollout_.pass(now);
        goWhenClosed(now);
        keepState();
    }
}

void Depot::keepState() {
    const RolloutState& state = rollout_.state();
    if (kept_ == state) return;
    keep(state, file_);
    if (kept_ && kept_->phase != state.phase)
        logInfo("{}: {} {}", nameOf(state.phase), state.stable.version, state.candidate.version);
    if (!state.reason.empty() && kept_ && kept_->reason != state.reason)
        logWarning("{}", state.reason);
    kept_ = state;
}

void Depot::goWhenClosed(double now) {
    if (!setup_.isClosed || !rollout_.isReady() || now - askedHoursAt_ < kBetweenHours) return;
    askedHoursAt_ = now;
    if (setup_.isClosed()) rollout_.go(now);
}

void Depot::hear(const net::FromPeer& from) {
    const auto message = decode(from.bytes);
    if (!message || (setup_.hasKeys && from.user.empty())) return;
    v1::DepotMessage answer;
    if (message->has_report()) answer = orderFor(from.user, message->report());
    if (message->has_piece_request()) answer = pieceFor(message->piece_request());
    if (message->has_request()) answer = replyTo(from, message->request());
    if (answer.message_case() != v1::DepotMessage::MESSAGE_NOT_SET)
        channels_->sendControl(from.peer, encode(answer));
}

// The decision is on the disk before anybody hears of it.
v1::DepotMessage Depot::orderFor(const std::string& user, const v1::MachineReport& report) {
    const auto machine =
        setup_.machines.machineOf.find(setup_.hasKeys ? placeOf(user) : report.place());
    v1::DepotMessage answer;
    if (machine == setup_.machines.machineOf.end()) return answer;
    const double now = net::monotonicSeconds();
    rollout_.hear(machine->second, reportIn(report), now);
    keepState();
    write(rollout_.orderFor(machine->second, now), *answer.mutable_order());
    answer.mutable_order()->set_lease_s(setup_.limits.lease());
    answer.mutable_order()->set_answers_s(report.sent_s());
    return answer;
}

// Names of list and release have no path.
v1::DepotMessage Depot::pieceFor(const v1::PieceRequest& request) const {
    v1::DepotMessage answer;
    v1::ReleasePiece& piece = *answer.mutable_piece();
    piece.set_version(request.version());
    piece.set_file(request.file());
    piece.set_offset(request.offset());
    if (isVersion(request.version()) && isVersion(request.file()))
        readPiece(setup_.folder / request.version() / request.file(), request.offset(), piece);
    return answer;
}

v1::DepotMessage Depot::replyTo(const net::FromPeer& from, const v1::DepotRequest& request) {
    try {
        const bool isQuestion = request.what() == v1::DepotRequest::STATUS;
        if (setup_.hasKeys && !isQuestion && partsOf(from.user).first != "crew")
            throw Error("only the crew changes the release; show its key (--key)");
        if (request.what() == v1::DepotRequest::STAGE) {
            beginCheck(from, request);
            return {};
        }
        carryOut(request);
        return answerTo(request.number(), "");
    } catch (const Error& problem) {
        return answerTo(request.number(), problem.what());
    }
}

// Empty refusal: it was done.
v1::DepotMessage Depot::answerTo(std::uint32_t number, const std::string& refusal) {
    keepState();
    v1::DepotMessage answer;
    v1::DepotReply& reply = *answer.mutable_reply();
    reply.set_number(number);
    if (!refusal.empty()) reply.set_refusal(legible(refusal, kMostTextBytes));
    describe(reply);
    return answer;
}

void Depot::carryOut(const v1::DepotRequest& request) {
    const double now = net::monotonicSeconds();
    if (request.what() == v1::DepotRequest::GO) rollout_.go(now);
    if (request.what() == v1::DepotRequest::BACK) rollout_.back(now);
}

// A release is checked whole before any machine hears of it. That takes seconds, and a minute on a
// slow disk: machines are heard meanwhile.
void Depot::beginCheck(const net::FromPeer& from, const v1::DepotRequest& request) {
    if (!isVersion(request.version())) throw Error("name the version of a release");
    if (check_) throw Error("another release is being checked; wait for its end");
    check_ = Check{from.peer,
                   request.number(),
                   std::async(std::launch::async,
                              [folder = setup_.folder / request.version(), &key = setup_.key] {
                                  return checkRelease(folder, key);
                              })};
}

void Depot::endCheck(double now) {
    if (!check_ || check_->content.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    Check check = *std::exchange(check_, std::nullopt);
    std::string refusal;
    try {
        rollout_.stage(check.content.get().id, now);
    } catch (const Error& problem) {
        refusal = problem.what();
    }
    channels_->sendControl(check.peer, encode(answerTo(check.number, refusal)));
}

void Depot::describe(v1::DepotReply& reply) const {
    const double now = net::monotonicSeconds();
    write(rollout_.state(), *reply.mutable_rollout());
    reply.set_is_ready(rollout_.isReady());
    if (const std::string waits = rollout_.waitingFor(now); !waits.empty())
        reply.set_waiting_for(legible(waits, kMostTextBytes));
    for (const MachineSeat& seat : rollout_.seats()) {
        v1::MachineStatus& status = *reply.add_machines();
        status.set_name(seat.name);
        if (!seat.report) continue;
        write(seat.report->booted, *status.mutable_booted());
        status.set_silent_s(now - seat.heardAt);
        status.set_frames(seat.report->frames);
        if (!seat.report->problem.empty()) status.set_problem(seat.report->problem);
    }
}

}  // namespace aquarama::releases
