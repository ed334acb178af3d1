// SPDX-License-Identifier: Apache-2.0
#include "releases/messages.h"

#include <google/protobuf/stubs/logging.h>
#include <google/protobuf/text_format.h>

#include "common/base/characters.h"
#include "common/base/files.h"
#include "common/config/rules.h"
#include "common/config/text_reader.h"

namespace aquarama::releases {

namespace {

namespace fs = std::filesystem;
namespace pb = google::protobuf;

constexpr std::uint32_t kFileVersion = 1;
constexpr std::size_t kMostReasonBytes = 2048;

static_assert(int{v1::KeptRollout::SETTLED} == static_cast<int>(RolloutState::Phase::Settled) + 1 &&
              int{v1::KeptRollout::RETURNING} ==
                  static_cast<int>(RolloutState::Phase::Returning) + 1);

void keepText(const pb::Message& message, const fs::path& file) {
    std::string text;
    pb::TextFormat::PrintToString(message, &text);
    writeWhole(file, std::as_bytes(std::span(text)));
}

// False: it is not there.
bool readText(const fs::path& file, pb::Message& message) {
    if (!fs::exists(file)) return false;
    config::TextReader(config::readTextFile(file.string()), file.string(), message).check();
    return true;
}

}  // namespace

std::vector<std::byte> encode(const v1::DepotMessage& message) {
    std::vector<std::byte> packet(message.ByteSizeLong());
    message.SerializeToArray(packet.data(), static_cast<int>(packet.size()));
    return packet;
}

std::optional<v1::DepotMessage> decode(std::span<const std::byte> packet) {
    const pb::LogSilencer silencer;
    v1::DepotMessage message;
    if (packet.size() > 2 * kPieceBytes ||
        !message.ParseFromArray(packet.data(), static_cast<int>(packet.size())) ||
        message.message_case() == v1::DepotMessage::MESSAGE_NOT_SET || !config::keepsRules(message))
        return std::nullopt;
    return message;
}

void write(const ReleaseId& id, v1::ReleaseName& message) {
    message.set_version(id.version);
    message.set_serial(id.serial);
}

ReleaseId idIn(const v1::ReleaseName& message) {
    return {message.version(), message.serial()};
}

void write(const MachineReport& report, v1::MachineReport& message) {
    write(report.booted, *message.mutable_booted());
    message.set_epoch(report.epoch);
    for (const ReleaseId& held : report.held) write(held, *message.add_held());
    message.set_frames(report.frames);
    message.set_left_in(report.leftIn);
    if (!report.problem.empty()) message.set_problem(legible(report.problem, kMostProblemBytes));
}

MachineReport reportIn(const v1::MachineReport& message) {
    MachineReport report{.booted = idIn(message.booted()),
                         .epoch = message.epoch(),
                         .frames = message.frames(),
                         .leftIn = message.left_in(),
                         .problem = message.problem()};
    for (const v1::ReleaseName& held : message.held()) report.held.push_back(idIn(held));
    return report;
}

void write(const MachineOrder& order, v1::MachineOrder& message) {
    message.set_epoch(order.epoch);
    if (order.run) write(order.run, *message.mutable_run());
    message.set_is_settled(order.isSettled);
    message.set_may_show(order.mayShow);
    if (order.fetch) write(order.fetch, *message.mutable_fetch());
}

MachineOrder orderIn(const v1::MachineOrder& message) {
    return {.epoch = message.epoch(),
            .run = idIn(message.run()),
            .isSettled = message.is_settled(),
            .mayShow = message.may_show(),
            .fetch = idIn(message.fetch())};
}

void write(const RolloutState& state, v1::KeptRollout& message) {
    message.set_version(kFileVersion);
    message.set_epoch(state.epoch);
    message.set_phase(static_cast<v1::KeptRollout::Phase>(static_cast<int>(state.phase) + 1));
    if (state.stable) write(state.stable, *message.mutable_stable());
    if (state.candidate) write(state.candidate, *message.mutable_candidate());
    if (state.before) write(state.before, *message.mutable_before());
    if (!state.reason.empty()) message.set_reason(legible(state.reason, kMostReasonBytes));
}

RolloutState stateIn(const v1::KeptRollout& message) {
    return {.epoch = message.epoch(),
            .phase = static_cast<RolloutState::Phase>(static_cast<int>(message.phase()) - 1),
            .stable = idIn(message.stable()),
            .candidate = idIn(message.candidate()),
            .before = idIn(message.before()),
            .reason = message.reason()};
}

void keep(const RolloutState& state, const fs::path& file) {
    v1::KeptRollout message;
    write(state, message);
    keepText(message, file);
}

std::optional<RolloutState> keptRollout(const fs::path& file) {
    v1::KeptRollout message;
    if (!readText(file, message)) return std::nullopt;
    return stateIn(message);
}

void keep(const FollowerMemory& memory, const fs::path& file) {
    v1::KeptFollower message;
    message.set_version(kFileVersion);
    if (memory.settled) write(memory.settled, *message.mutable_settled());
    message.set_tried_in(memory.triedIn);
    if (memory.tried) write(memory.tried, *message.mutable_tried());
    if (!memory.triedFrom.empty()) message.set_tried_from(memory.triedFrom);
    keepText(message, file);
}

std::optional<FollowerMemory> keptFollower(const fs::path& file) {
    v1::KeptFollower message;
    if (!readText(file, message)) return std::nullopt;
    return FollowerMemory{.settled = idIn(message.settled()),
                          .triedIn = message.tried_in(),
                          .tried = idIn(message.tried()),
                          .triedFrom = message.tried_from()};
}

}  // namespace aquarama::releases
