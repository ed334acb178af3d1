// SPDX-License-Identifier: Apache-2.0
// What the doctor finds, and what a running master says, for the commands that need either.
#pragma once

#include <optional>
#include <string>

#include "commands/findings.h"
#include "common/wire/messages.h"

namespace aquarama {

// The answer of a master: its status, or what it prepares; both empty where none answers.
struct MasterAnswer {
    std::optional<v1::StatusReply> status = {};
    std::string preparing = {};
    std::string problem = {};  // why none could be asked, as a key that cannot be read
};
// Asks the master of a rig, for two seconds at most. `keyFolder`: empty: the user's. Does not
// throw.
[[nodiscard]] MasterAnswer answerOfMaster(const std::string& rigPath, const std::string& keyFolder);

// All that `aquarama doctor` finds of a rig, in its order. `keyFolder`: empty: the user's. Does not
// throw.
[[nodiscard]] Findings findingsOfDoctor(const std::string& rigPath, const std::string& keyFolder);

}  // namespace aquarama
