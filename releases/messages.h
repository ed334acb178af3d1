// SPDX-License-Identifier: Apache-2.0
// The packets of depot, machines and people, and their files: from and to plain values, within the
// bounds of releases.proto.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "releases/follower.h"
#include "releases/releases.pb.h"
#include "releases/rollout.h"

namespace aquarama::releases {

// Of a piece of a file.
inline constexpr std::size_t kPieceBytes = std::size_t{256} << 10U;
// Of a text from a machine; longer ones are cut.
inline constexpr std::size_t kMostProblemBytes = 1024;

// The packet of a message; empty bytes decode to nothing, as does what breaks a rule.
[[nodiscard]] std::vector<std::byte> encode(const v1::DepotMessage& message);
[[nodiscard]] std::optional<v1::DepotMessage> decode(std::span<const std::byte> packet);

// To a message and from one, field by field.
void write(const ReleaseId& id, v1::ReleaseName& message);
[[nodiscard]] ReleaseId idIn(const v1::ReleaseName& message);
void write(const MachineReport& report, v1::MachineReport& message);
[[nodiscard]] MachineReport reportIn(const v1::MachineReport& message);
void write(const MachineOrder& order, v1::MachineOrder& message);
[[nodiscard]] MachineOrder orderIn(const v1::MachineOrder& message);
void write(const RolloutState& state, v1::KeptRollout& message);
[[nodiscard]] RolloutState stateIn(const v1::KeptRollout& message);

// Files, each replaced whole. Reading throws Error where one is malformed; nothing: it is not
// there.
void keep(const RolloutState& state, const std::filesystem::path& file);
[[nodiscard]] std::optional<RolloutState> keptRollout(const std::filesystem::path& file);
void keep(const FollowerMemory& memory, const std::filesystem::path& file);
[[nodiscard]] std::optional<FollowerMemory> keptFollower(const std::filesystem::path& file);

}  // namespace aquarama::releases
