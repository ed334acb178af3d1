// SPDX-License-Identifier: Apache-2.0
// The list of visitors' drawings: on a master's disk, as text, and on the wire, as a blob.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>

#include "common/config/keys.pb.h"

namespace aquarama::wire {

// Throws Error, with line and column, where it cannot be read or breaks its rules.
[[nodiscard]] v1::KeptDrawings readKeptDrawings(const std::filesystem::path& path);
// Replaces the file as a whole, readable by this user only. Throws Error where it cannot.
void keepDrawings(const std::filesystem::path& path, v1::KeptDrawings list);

// The list in a blob, which names the skin of each; nothing where it is none.
[[nodiscard]] std::optional<v1::KeptDrawings> keptDrawingsIn(std::span<const std::byte> blob);

}  // namespace aquarama::wire
