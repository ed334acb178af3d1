// SPDX-License-Identifier: Apache-2.0
// What the commands share that can do one part of their work (--part), and `merge`, which makes the
// whole of the parts.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/base/digest.h"
#include "common/parts/part.h"
#include "common/parts/part_file.h"
#include "master/supervisor/supervise.h"

namespace aquarama {

// Adds the option --part. Empty: the whole work.
void describePart(CLI::App& command, std::optional<parts::Part>& part);

// Writes the file of a part beside `out`, what the whole work would write, and prints its path.
void writePart(const std::string& out,
               parts::Part part,
               parts::WorkKind kind,
               const Digest& inputs,
               std::vector<std::byte> content);

// Each writes what the whole work writes to `out`. All parts are there, in order. They throw
// Error where a content is not what this build writes.
using WorkInParts = std::vector<parts::FinishedPart>;
void mergeCapture(const std::string& out, const WorkInParts& work);
void mergeStudy(const std::string& out, const WorkInParts& work);
void mergeSearch(const std::string& out, const WorkInParts& work);
void mergeClip(const std::string& out, const WorkInParts& work);

// Films one part of a replay by `run`, as a clip beside the file of the part. `options` are
// those of the whole film. Returns the exit status.
[[nodiscard]] int replayPart(const supervisor::RunOptions& options,
                             parts::Part part,
                             int (*run)(const supervisor::RunOptions&));

// For a content that was decoded: throws Error unless all of it could be read.
void requireWhole(bool isWhole, const parts::FinishedPart& part);

}  // namespace aquarama
