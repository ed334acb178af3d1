// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/capture_repertoire.h"

#include <algorithm>
#include <array>
#include <exception>
#include <mutex>
#include <optional>

#include "common/units/error.h"
#include "common/units/worker_pool.h"
#include "master/capture/compile/compile_segment.h"
#include "master/capture/compile/speed_response.h"
#include "master/capture/compile/steady_swimming.h"
#include "master/capture/compile/turn.h"

namespace aquarama::capture {

namespace {

constexpr std::size_t kGaits = 3;  // slow, medium, fast
constexpr std::size_t kJobs = 2 * kGaits;

// What one species' jobs leave behind. The first three swim its gaits and do not need one another;
// nor do the last three, but they set out from those gaits.
struct Swum {
    std::array<std::optional<SteadySwimming>, kGaits> forward;
    std::array<RecordedCycle, 2> leftTurn;  // gradual, sharp
    motion::SpeedResponse response;
    std::array<std::string, kJobs> errors;  // of each job
};

void runJob(const config::Species& species, std::size_t job, Swum& swum) {
    const auto& [slow, medium, fast] = swum.forward;
    const config::Swim& swim = species.swim;
    const std::array gaits{&swim.slow, &swim.medium, &swim.fast};
    if (job < kGaits)
        swum.forward.at(job) = swimUntilSteady(species, *gaits.at(job));
    else if (!slow || !medium || !fast)
        return;
    else if (job == 3)
        swum.leftTurn[0] = recordTypicalLeftTurn(species, *medium, species.turn.gradual);
    else if (job == 4)
        swum.leftTurn[1] = recordTypicalLeftTurn(species, *medium, species.turn.sharp);
    else
        swum.response = fitResponse(swimTransitions(species, {&*slow, &*medium, &*fast}));
}

motion::Repertoire compile(const config::Species& species, const Swum& swum) {
    const body::FishBody body = body::makeBody(species);
    motion::Repertoire repertoire;
    repertoire.species = species.name;
    repertoire.recordedLengthMetres = body.typicalLengthMetres;
    repertoire.response = swum.response;
    const auto segment = [&](motion::Action action) -> motion::ActionSegment& {
        return repertoire.segments.at(static_cast<std::size_t>(action));
    };
    segment(motion::Action::ForwardSlow) = compileForward(swum.forward[0]->beat);
    segment(motion::Action::ForwardMedium) = compileForward(swum.forward[1]->beat);
    segment(motion::Action::ForwardFast) = compileForward(swum.forward[2]->beat);
    segment(motion::Action::TurnLeftGradual) = compileLeftTurn(swum.leftTurn[0]);
    segment(motion::Action::TurnLeftSharp) = compileLeftTurn(swum.leftTurn[1]);
    segment(motion::Action::TurnRightGradual) = compileRightTurn(swum.leftTurn[0]);
    segment(motion::Action::TurnRightSharp) = compileRightTurn(swum.leftTurn[1]);
    if (species.recordsControlPoints)
        for (int action = 0; action < motion::kCapturedActions; ++action)
            addControlPoints(body, segment(static_cast<motion::Action>(action)));
    motion::addGlide(repertoire);
    return repertoire;
}

CaptureOutcome outcomeOf(const config::Species& species, const Swum& swum) {
    const auto error = std::ranges::find_if_not(swum.errors, &std::string::empty);
    if (error != swum.errors.end()) return {.repertoire = {}, .error = *error};
    try {
        return {.repertoire = compile(species, swum), .error = {}};
    } catch (const std::exception& thrown) {
        return {.repertoire = {}, .error = thrown.what()};
    }
}

}  // namespace

std::vector<CaptureOutcome> captureRepertoires(const std::vector<config::Species>& species,
                                               const CaptureRun& run) {
    std::vector<Swum> swum(species.size());
    std::mutex telling;
    std::size_t done = 0;
    const auto runOne = [&](std::size_t job, std::size_t fish) {
        std::string& error = swum[fish].errors.at(job);
        if (run.isStopped()) {
            error = species[fish].name + ": interrupted";
            return;
        }
        try {
            runJob(species[fish], job, swum[fish]);
        } catch (const std::exception& thrown) {
            error = thrown.what();
        }
        const std::lock_guard lock(telling);
        run.progress(static_cast<double>(++done) / static_cast<double>(kJobs * species.size()));
    };
    WorkerPool pool(run.threads);
    for (const std::size_t first : {std::size_t{0}, kGaits})
        pool.run(kGaits * species.size(),
                 [&](std::size_t i) { runOne(first + i / species.size(), i % species.size()); });

    std::vector<CaptureOutcome> outcomes(species.size());
    pool.run(species.size(), [&](std::size_t i) { outcomes[i] = outcomeOf(species[i], swum[i]); });
    return outcomes;
}

motion::Repertoire captureRepertoire(const config::Species& species, const Progress& progress) {
    CaptureOutcome outcome =
        std::move(captureRepertoires({species}, {.progress = progress}).front());
    if (!outcome.repertoire) throw Error(outcome.error);
    return *std::move(outcome.repertoire);
}

}  // namespace aquarama::capture
