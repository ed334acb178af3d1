// SPDX-License-Identifier: Apache-2.0
// What each step of `aquarama tour` finds: functions of what was read and heard alone.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "commands/doctor.h"
#include "commands/tour_record.h"
#include "common/base/versions.h"
#include "common/config/hours.h"
#include "common/config/rig.h"

namespace aquarama {

// ToConfirm: only somebody in the hall can tell.
enum class StepState : std::uint8_t { Done, ToConfirm, ToDo };

// As programs are told it: "done", "confirm", "todo".
[[nodiscard]] std::string_view nameOf(StepState state);

// What a step has found, and what to do about it; `todo` is empty where it is done.
struct StepFinding {
    StepState state = StepState::ToDo;
    std::string what = {}, todo = {};
};

// "cylinder, radius 2.620 m, arc 120.0 degrees, 2.438 m high"
[[nodiscard]] std::string textOf(const config::Rig& rig);

// Whether the screen of a rig was measured. `shipped`: files and screens of the rigs that come with
// the programs: a screen as one of them has it is to be confirmed.
[[nodiscard]] StepFinding lookAtScreen(
    const config::Rig& rig, std::span<const std::pair<std::string, std::string>> shipped);

// Whether a node of every channel has come to the master.
[[nodiscard]] StepFinding lookAtMachines(const std::string& rigPath, const MasterAnswer& master);

// Whether each channel has its key, and its node runs on the machine that the rig names.
// `keyProblems`: of keys that are missing or cannot be used; `ownHost`: name of this machine, the
// master's.
[[nodiscard]] StepFinding lookAtChannels(const std::string& rigPath,
                                         const MasterAnswer& master,
                                         std::span<const std::string> keyProblems,
                                         const std::string& ownHost);

// Whether the doctor finds no fault with a running show.
[[nodiscard]] StepFinding lookAtHealth(const std::string& rigPath, const Findings& findings);

// Whether the crew has focused the projectors of a rig, by a pattern that its show can have.
// `confirmed`: the finding that they have confirmed.
[[nodiscard]] StepFinding lookAtFocus(const std::string& rigPath,
                                      const config::Rig& rig,
                                      const MasterAnswer& master,
                                      const std::string& confirmed);

// Whether the wall is calibrated. `kept`: the calibrations of the file that the rig names, the
// newest first.
[[nodiscard]] StepFinding lookAtCalibration(const std::string& rigPath,
                                            const config::Rig& rig,
                                            std::span<const FileVersion> kept);

// Whether the rig has hours, by which something changes within a year from a moment of Unix time.
[[nodiscard]] StepFinding lookAtHours(const std::string& rigPath,
                                      const std::optional<config::Hours>& hours,
                                      long long now);

// A copy of the hall. Times are seconds of Unix time, 0 where there is none.
struct BackupFacts {
    std::string file = {};  // where it should lie; empty: no folder was named
    double writtenAt = 0;   // 0: is not there; the stick may be out
    bool isOnDiskOfRig = false;
    double hallChangedAt = 0;  // the newest of what it has a copy of
};
// Whether there is a copy of the hall as it is now. `seenAt`: when the copy was written that was
// seen last.
[[nodiscard]] StepFinding lookAtBackup(const std::string& rigPath,
                                       const BackupFacts& facts,
                                       double seenAt);

}  // namespace aquarama
