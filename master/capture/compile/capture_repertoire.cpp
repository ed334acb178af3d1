// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/capture_repertoire.h"

#include <algorithm>
#include <array>
#include <exception>
#include <mutex>

#include "common/units/error.h"
#include "master/capture/compile/compile_segment.h"
#include "master/capture/compile/speed_response.h"
#include "master/capture/compile/turn.h"
#include "master/capture/compile/work_queue.h"

namespace aquarama {

namespace {

// What one species' jobs leave behind. They do not need one another.
struct Recordings {
    std::array<Recording, 3> forward;   // slow, medium, fast
    std::array<Recording, 2> leftTurn;  // gradual, sharp
    SpeedResponse response;
    std::array<std::string, 6> errors;  // of each job
};
constexpr std::size_t kJobs = std::tuple_size_v<decltype(Recordings::errors)>;

// The long ones come first, so that no thread is left alone with one at the end.
void runJob(const Species& species, std::size_t job, Recordings& recordings) {
    const auto& [gradual, sharp] = species.turn;
    const Swim& swim = species.swim;
    switch (job) {
        case 0:
            recordings.response = fitResponse(swimTransitions(species));
            break;
        case 1:
            recordings.leftTurn[0] = recordTypicalLeftTurn(species, gradual);
            break;
        case 2:
            recordings.leftTurn[1] = recordTypicalLeftTurn(species, sharp);
            break;
        case 3:
            recordings.forward[0] = swimUntilSteady(species, swim.slow).beat;
            break;
        case 4:
            recordings.forward[1] = swimUntilSteady(species, swim.medium).beat;
            break;
        case 5:
            recordings.forward[2] = swimUntilSteady(species, swim.fast).beat;
            break;
        default:
            break;
    }
}

Repertoire compile(const Species& species, const Recordings& recordings) {
    const FishBody body = makeBody(species);
    Repertoire repertoire;
    repertoire.species = species.name;
    repertoire.recordedLengthMetres = body.typicalLengthMetres;
    repertoire.response = recordings.response;
    const auto segment = [&](Action action) -> ActionSegment& {
        return repertoire.segments.at(static_cast<std::size_t>(action));
    };
    segment(Action::ForwardSlow) = compileForward(recordings.forward[0]);
    segment(Action::ForwardMedium) = compileForward(recordings.forward[1]);
    segment(Action::ForwardFast) = compileForward(recordings.forward[2]);
    segment(Action::TurnLeftGradual) = compileLeftTurn(recordings.leftTurn[0]);
    segment(Action::TurnLeftSharp) = compileLeftTurn(recordings.leftTurn[1]);
    segment(Action::TurnRightGradual) = compileRightTurn(recordings.leftTurn[0]);
    segment(Action::TurnRightSharp) = compileRightTurn(recordings.leftTurn[1]);
    if (species.recordsControlPoints)
        for (int action = 0; action < kCapturedActions; ++action)
            addControlPoints(body, segment(static_cast<Action>(action)));
    addGlide(repertoire);
    return repertoire;
}

CaptureOutcome outcomeOf(const Species& species, const Recordings& recordings) {
    const auto error = std::ranges::find_if_not(recordings.errors, &std::string::empty);
    if (error != recordings.errors.end()) return {.repertoire = {}, .error = *error};
    return {.repertoire = compile(species, recordings), .error = {}};
}

}  // namespace

std::vector<CaptureOutcome> captureRepertoires(const std::vector<Species>& species,
                                               const CaptureRun& run) {
    std::vector<Recordings> recordings(species.size());
    const std::size_t jobs = kJobs * species.size();
    std::mutex telling;
    std::size_t done = 0;
    shareOut(jobs, run.threads, [&](std::size_t i) {
        const std::size_t fish = i % species.size();
        const std::size_t job = i / species.size();
        std::string& error = recordings[fish].errors.at(job);
        if (run.isStopped()) {
            error = species[fish].name + ": interrupted";
            return;
        }
        try {
            runJob(species[fish], job, recordings[fish]);
        } catch (const std::exception& thrown) {
            error = thrown.what();
        }
        const std::lock_guard lock(telling);
        run.progress(static_cast<double>(++done) / static_cast<double>(jobs));
    });

    std::vector<CaptureOutcome> outcomes(species.size());
    shareOut(species.size(), run.threads, [&](std::size_t i) {
        try {
            outcomes[i] = outcomeOf(species[i], recordings[i]);
        } catch (const std::exception& thrown) {
            outcomes[i].error = thrown.what();
        }
    });
    return outcomes;
}

Repertoire captureRepertoire(const Species& species, const Progress& progress) {
    CaptureOutcome outcome =
        std::move(captureRepertoires({species}, {.progress = progress}).front());
    if (!outcome.repertoire) throw Error(outcome.error);
    return *std::move(outcome.repertoire);
}

}  // namespace aquarama
