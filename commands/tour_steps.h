// SPDX-License-Identifier: Apache-2.0
// The steps of `aquarama tour`, in their order, and the look at a hall by which they judge.
#pragma once

#include <span>
#include <string>

#include "commands/doctor.h"
#include "commands/tour_findings.h"
#include "commands/tour_record.h"
#include "common/config/rig.h"

namespace aquarama {

// A hall at one moment.
struct TourView {
    std::string rigPath;
    config::Rig rig = {};
    std::string rigProblem = {};  // why it cannot be shown; empty: it can
    MasterAnswer master = {};
    BackupFacts backup = {};
    TourRecord record = {};
};
// Reads the files of a hall and asks its master, which takes some seconds where none answers.
[[nodiscard]] TourView lookAround(const std::string& rigPath, const TourRecord& record);

// One step.
struct TourStep {
    const char* name;  // a word
    const char* aim;
    StepFinding (*look)(const TourView& view);
    bool showsGrid = false;  // while somebody is asked to confirm it
};
[[nodiscard]] std::span<const TourStep> tourSteps();

// What a step finds; done where it finds what was confirmed.
[[nodiscard]] StepFinding findingOf(const TourStep& step, const TourView& view);

}  // namespace aquarama
