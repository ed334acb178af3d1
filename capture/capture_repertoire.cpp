// SPDX-License-Identifier: Apache-2.0
#include "capture/capture_repertoire.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <exception>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>

#include "capture/compile_segment.h"
#include "capture/measure.h"
#include "capture/speed_response.h"
#include "capture/turn.h"
#include "common/base/digest.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/worker_pool.h"
#include "common/motion/repertoire.h"

namespace aquarama::capture {

namespace {

// Capture. A species has jobs in two groups. The first simulates what it does steadily: each gait
// straight on, on two curves and on a loop upwards, the retreat, and straight on half-way between
// two gaits; and what it does in its place. The second, the two turns, the three fast starts and
// the speed response, starts from the gaits. Within a group the jobs are independent of one
// another, so they run in parallel.

constexpr std::size_t kGaits = motion::kForwardGaits;  // slow, medium, fast
enum class Way : std::uint8_t { Straight, WideCurve, TightCurve, Loop };
constexpr std::size_t kWays = 4;
constexpr std::size_t kRetreatJob =
    kGaits * kWays;  // job i before: gait i % kGaits, way i / kGaits
constexpr std::size_t kInPlaceJob = kRetreatJob + 1;  // hover, pivot, pitch
constexpr std::array kInPlace{Controller::Hover, Controller::LeftPivot, Controller::PitchUp};
constexpr std::size_t kBetweenJob =
    kInPlaceJob + kInPlace.size();  // slow and medium; then medium and fast
constexpr std::size_t kSteadyJobs = kBetweenJob + kGaits - 1;
constexpr std::size_t kTurnJob = kSteadyJobs;    // gradual, sharp
constexpr std::size_t kStartJob = kTurnJob + 2;  // small, middle, large
constexpr std::size_t kResponseJob = kStartJob + kBendShares.size();
constexpr std::size_t kJobs = kResponseJob + 1;
constexpr std::size_t kLaterJobs = kJobs - kSteadyJobs;

// Values of Order::curve and liftRadians. Over all species a wide curve has a radius of 3.8 to 7.8
// body lengths by the tail, and 1.6 to 1.8 where fins row.
constexpr double kWideCurve = 0.2;
constexpr double kLoopLiftRadians = 0.4;

// The results of one species' jobs. Each job writes its own member only, so no lock is needed.
struct Swum {
    std::array<std::optional<SteadySwimming>, kSteadyJobs> steady;
    std::array<RecordedCycle, 2> leftTurn;                               // gradual, sharp
    std::array<std::vector<EnteredTurn>, 2> enteredLeft;                 // likewise
    std::array<std::vector<EnteredTurn>, kBendShares.size()> leftStart;  // the first out of rest
    motion::SpeedResponse response;
    std::array<std::string, kJobs> errors;  // of each job

    [[nodiscard]] const RecordedCycle& beat(std::size_t gait, Way way) const {
        return steady.at(static_cast<std::size_t>(way) * kGaits + gait)->beat;
    }
};

Order orderOf(const config::Species& species, std::size_t job) {
    if (job == kRetreatJob) return rowingOrder(species, Controller::Retreat);
    if (job >= kInPlaceJob && job < kBetweenJob)
        return rowingOrder(species, kInPlace.at(job - kInPlaceJob));
    const std::array gaits{&species.swim.slow, &species.swim.medium, &species.swim.fast};
    if (job >= kBetweenJob) {
        const config::Gait& slower = *gaits.at(job - kBetweenJob);
        const config::Gait& faster = *gaits.at(job - kBetweenJob + 1);
        return {.controller = Controller::ForwardSwim,
                .gait = {.beatHertz = (slower.beatHertz + faster.beatHertz) / 2,
                         .gain = (slower.gain + faster.gain) / 2}};
    }
    Order order{.controller = Controller::ForwardSwim, .gait = *gaits.at(job % kGaits)};
    switch (static_cast<Way>(job / kGaits)) {
        case Way::Straight:
            break;
        case Way::WideCurve:
            order.curve = kWideCurve;
            order.bankRadians = kBankRadians / 2;
            break;
        case Way::TightCurve:
            return tightCurve(order.gait);
        case Way::Loop:
            order.liftRadians = kLoopLiftRadians;
            break;
    }
    return order;
}

// A turn out of a glide, and out of the beats of all speeds, from slow to fast.
void recordTurn(const config::Species& species, std::size_t sharp, Swum& swum) {
    const config::Bend& bend = sharp == 1 ? species.turn.sharp : species.turn.gradual;
    const auto steady = [&](std::size_t job) { return &*swum.steady.at(job); };
    RecordedCycle& turn = swum.leftTurn.at(sharp);
    turn = recordTypicalLeftTurn(species, *steady(1), bend);
    swum.enteredLeft.at(sharp) = recordEnteredTurns(
        species,
        {steady(0), steady(kBetweenJob), steady(1), steady(kBetweenJob + 1), steady(2)},
        bend,
        turn.periodSeconds);
}

// A fast start out of rest, and out of the beats of slow and medium swimming.
void recordStart(const config::Species& species, std::size_t size, Swum& swum) {
    std::vector<EnteredTurn>& starts = swum.leftStart.at(size);
    starts = recordEnteredStarts(
        species, {&*swum.steady.at(0), &*swum.steady.at(1)}, kBendShares.at(size));
    starts.insert(starts.begin(), capture::recordStart(species, kBendShares.at(size)));
}

// Throws Error where the simulation fails. A job of the second group does nothing when one of the
// first has failed; the error of that one is reported instead.
void runJob(const config::Species& species, std::size_t job, Swum& swum) {
    assert(job < kJobs);
    if (job < kSteadyJobs) {
        swum.steady.at(job) = swimUntilSteady(species, orderOf(species, job));
        return;
    }
    if (!std::ranges::all_of(swum.steady, [](const auto& steady) { return steady.has_value(); }))
        return;
    const auto steady = [&](std::size_t first) -> const SteadySwimming& {
        return *swum.steady.at(first);
    };
    if (job < kStartJob)
        recordTurn(species, job - kTurnJob, swum);
    else if (job < kResponseJob)
        recordStart(species, job - kStartJob, swum);
    else
        swum.response = fitResponse(
            swimTransitions(species, {&steady(0), &steady(1), &steady(2)}, steady(kRetreatJob)));
}

// The segments of one gait: those to the right and downwards are mirror images.
void compileGait(const Swum& swum, std::size_t gait, bool rows, motion::Repertoire& repertoire) {
    using motion::Action;
    const auto segment = [&](Action slow) -> motion::ActionSegment& {
        return repertoire.segments.at(indexOf(atGait(slow, static_cast<Action>(gait))));
    };
    const RecordedCycle& straight = swum.beat(gait, Way::Straight);
    const RecordedCycle& loop = swum.beat(gait, Way::Loop);
    segment(Action::ForwardSlow) = rows ? compileRowed(straight) : compileForward(straight);
    segment(Action::CurveLeftWideSlow) = compileCurve(swum.beat(gait, Way::WideCurve));
    segment(Action::CurveLeftTightSlow) = compileCurve(swum.beat(gait, Way::TightCurve));
    segment(Action::CurveRightWideSlow) = mirroredLeftRight(segment(Action::CurveLeftWideSlow));
    segment(Action::CurveRightTightSlow) = mirroredLeftRight(segment(Action::CurveLeftTightSlow));
    segment(Action::ClimbSlow) = rows ? compileRowedSlope(loop) : compileSlope(loop);
    segment(Action::DiveSlow) = mirroredTopBottom(segment(Action::ClimbSlow));
}

// The paths of a left turn or fast start by speed and phase of the beat. Every other phase is a
// blend of the recorded ones about it.
std::vector<motion::TurnPath> pathsOf(std::span<const EnteredTurn> turns, const SwimsOn& on) {
    constexpr std::size_t kRecorded = kRecordedPhases;
    static_assert(kRecorded * 2 == motion::kEntryPhases);
    std::vector<motion::TurnPath> paths;
    for (std::size_t speed = 0; speed < turns.size() / kRecorded; ++speed) {
        for (std::size_t i = 0; i < kRecorded; ++i) {
            const auto recorded = [&](std::size_t phase) {
                return compileEntered(turns[speed * kRecorded + phase % kRecorded], on);
            };
            paths.push_back(recorded(i));
            paths.push_back(blended(recorded(i), recorded(i + 1)));
        }
    }
    return paths;
}

// Those to the right: the mirror image is the left one half a beat later.
std::vector<motion::TurnPath> mirroredPaths(std::span<const motion::TurnPath> left) {
    std::vector<motion::TurnPath> right;
    for (std::size_t i = 0; i < left.size(); ++i) {
        const std::size_t phase = (i + motion::kEntryPhases / 2) % motion::kEntryPhases;
        const std::size_t speed = i / motion::kEntryPhases;
        right.push_back(mirroredLeftRight(left[speed * motion::kEntryPhases + phase]));
    }
    return right;
}

// What a fish does with its pectoral fins alone.
void compileInPlace(const Swum& swum, motion::Repertoire& repertoire) {
    using motion::Action;
    const auto segment = [&](Action action) -> motion::ActionSegment& {
        return repertoire.segments.at(indexOf(action));
    };
    const auto recorded = [&](std::size_t job) { return swum.steady.at(job)->beat; };
    segment(Action::Retreat) = compileRowed(recorded(kRetreatJob));
    segment(Action::Hover) = compileHover(recorded(kInPlaceJob));
    segment(Action::PivotLeft) = compilePivot(recorded(kInPlaceJob + 1));
    segment(Action::PivotRight) = mirroredLeftRight(segment(Action::PivotLeft));
    segment(Action::PitchUp) = compilePitch(recorded(kInPlaceJob + 2));
    segment(Action::PitchDown) = mirroredTopBottom(segment(Action::PitchUp));
}

// How a fish swims on at a gait.
SwimsOn swimsOn(const motion::Repertoire& repertoire, motion::Action gait) {
    const motion::ActionSegment& segment = repertoire.segments.at(indexOf(gait));
    return {
        .speed = measure(segment).strideBodyLengths / static_cast<double>(segment.periodSeconds),
        .drag = static_cast<double>(repertoire.response.swimDrag.at(indexOf(gait)))};
}

// The turns to the left and, mirrored, to the right.
void compileTurns(const Swum& swum, motion::Repertoire& repertoire) {
    using motion::Action;
    const SwimsOn on = swimsOn(repertoire, Action::ForwardMedium);
    for (const auto& [toLeft, toRight, sharp] :
         {std::tuple{Action::TurnLeftGradual, Action::TurnRightGradual, 0U},
          std::tuple{Action::TurnLeftSharp, Action::TurnRightSharp, 1U}}) {
        motion::ActionSegment& left = repertoire.segments.at(indexOf(toLeft));
        motion::ActionSegment& right = repertoire.segments.at(indexOf(toRight));
        left = compileLeftTurn(swum.leftTurn.at(sharp));
        left.entered = pathsOf(swum.enteredLeft.at(sharp), on);
        right = mirroredLeftRight(left);
        right.entered = mirroredPaths(left.entered);
    }
}

// The fast starts to the left and, mirrored, to the right.
void compileStarts(const Swum& swum, motion::Repertoire& repertoire) {
    const SwimsOn on = swimsOn(repertoire, motion::Action::ForwardFast);
    for (std::size_t size = 0; size < kBendShares.size(); ++size) {
        const std::size_t first = indexOf(motion::Action::StartLeftSmall) + size;
        motion::ActionSegment& left = repertoire.segments.at(first);
        motion::ActionSegment& right = repertoire.segments.at(first + kBendShares.size());
        const std::span starts(swum.leftStart.at(size));
        left = compileStart(starts.front().turn);
        left.entered = pathsOf(starts.subspan(1), on);
        right = mirroredLeftRight(left);
        right.entered = mirroredPaths(left.entered);
        const motion::TurnPath outOfRest = compileEntered(starts.front(), on);
        left.entered.insert(left.entered.begin(), outOfRest);
        right.entered.insert(right.entered.begin(), mirroredLeftRight(outOfRest));
    }
}

// From recordings to a repertoire; right turns are the mirror images of the left ones, the glide is
// derived from the captured segments. All jobs of the species must have succeeded.
motion::Repertoire compile(const config::Species& species, const Swum& swum) {
    using motion::Action;
    const body::FishBody body = body::makeBody(species);
    motion::Repertoire repertoire;
    repertoire.species = species.name;
    repertoire.recordedLengthMetres = body.typicalLengthMetres;
    repertoire.response = swum.response;
    const std::array gaits{&species.swim.slow, &species.swim.medium, &species.swim.fast};
    for (std::size_t gait = 0; gait < kGaits; ++gait)
        compileGait(swum, gait, gaits.at(gait)->rows > 0, repertoire);
    compileInPlace(swum, repertoire);
    compileTurns(swum, repertoire);
    compileStarts(swum, repertoire);
    if (species.recordsControlPoints)
        for (int action = 0; action < motion::kCapturedActions; ++action)
            addControlPoints(body, repertoire.segments.at(static_cast<std::size_t>(action)));
    motion::addGlide(repertoire);
    return repertoire;
}

// The first error of its jobs, in their order, else what compile() gives.
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
    assert(run.progress);
    assert(run.isStopped);
    std::vector<Swum> swum(species.size());
    std::mutex telling;  // guards `done` and the calls of run.progress
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
    // The pool's jobs may not throw: runOne() keeps each error. The second group starts when all
    // jobs of the first have ended, of every species.
    WorkerPool pool(run.threads);
    for (const auto& [first, jobs] :
         {std::pair{std::size_t{0}, kSteadyJobs}, std::pair{kSteadyJobs, kLaterJobs}})
        pool.run(jobs * species.size(), [&, first = first](std::size_t i) {
            runOne(first + i / species.size(), i % species.size());
        });

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
