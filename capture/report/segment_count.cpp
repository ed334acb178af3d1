// SPDX-License-Identifier: Apache-2.0
#include "capture/report/segment_count.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>
#include <random>

#include "capture/compile_segment.h"
#include "capture/report/compare.h"
#include "capture/report/replica.h"
#include "capture/turn.h"
#include "common/base/units.h"

namespace aquarama::report {

namespace {

// Grades.

// The vocabularies that are compared, from the smallest to the largest.
const std::vector<Vocabulary>& vocabularies() {
    static const std::vector<Vocabulary> all{
        {{0.5}, {}},
        {{0.5}, {0.6}},
        {{0, 0.5, 1}, {0.6}},
        {{0, 0.5, 1}, {0.5, 1}},
        {{0, 0.25, 0.5, 0.75, 1}, {1.0 / 3, 2.0 / 3, 1}},
        {{0, 1.0 / 6, 1.0 / 3, 0.5, 2.0 / 3, 5.0 / 6, 1}, {0.25, 0.5, 0.75, 1}},
    };
    return all;
}

enum class Way : std::uint8_t { Ahead, Left, Right };

// A segment or a command: a speed (Ahead) or a turn, with its grade.
struct Grade {
    Way way = Way::Ahead;
    double value = 0.5;
    friend auto operator<=>(const Grade&, const Grade&) = default;
};

double between(double a, double b, double share) {
    return a + share * (b - a);
}

// Piecewise linear between the three gaits, in frequency and in gain.
config::Gait gaitAt(const config::Swim& swim, double grade) {
    assert(grade >= 0);
    assert(grade <= 1);
    const config::Gait& from = grade < 0.5 ? swim.slow : swim.medium;
    const config::Gait& to = grade < 0.5 ? swim.medium : swim.fast;
    const double share = grade < 0.5 ? 2 * grade : 2 * grade - 1;
    return {between(from.beatHertz, to.beatHertz, share), between(from.gain, to.gain, share)};
}

// Piecewise linear between no bend (at the tempo of the gradual one), gradual and sharp.
config::Bend bendAt(const config::Turn& turn, double grade) {
    assert(grade >= 0);
    assert(grade <= 1);
    if (grade < 0.5) return {2 * grade * turn.gradual.strength, turn.gradual.tempo};
    const double share = 2 * grade - 1;
    return {between(turn.gradual.strength, turn.sharp.strength, share),
            between(turn.gradual.tempo, turn.sharp.tempo, share)};
}

// A command in three forms: its grade, for the replica; its length, for compare(), where the
// manoeuvre only says whether it is a turn; and the order to the biomechanical fish.
struct GradedCommand {
    Grade grade;
    ScriptCommand command;
    capture::Order order;
};

// Random speeds and turns, uniform over their ranges (turns from a grade of 0.2). After a run-in it
// repeats: a random speed for 3 to 6 beats, medium swimming for 3, a turn. Keeps references to its
// arguments.
class GradedScript {
  public:
    GradedScript(const config::Species& species,
                 const motion::Repertoire& repertoire,
                 std::uint64_t seed,
                 double seconds)
        : species_(species), repertoire_(repertoire), random_(seed) {
        add({}, 6);
        while (ticks_ < seconds * kTicksPerSecond) {
            add({Way::Ahead, share()}, 3 + 3 * share());
            add({}, 3);
            const Way side = share() < 0.5 ? Way::Left : Way::Right;
            add({side, 0.2 + 0.8 * share()}, 0);
        }
    }
    [[nodiscard]] const std::vector<GradedCommand>& commands() const { return commands_; }

  private:
    // Uniform in [0, 1); the same with every standard library.
    double share() { return static_cast<double>(random_() >> 32U) / 4294967296.0; }

    // `beats` is for swimming only: a turn lasts as long as its segment.
    void add(const Grade& grade, double beats) {
        GradedCommand graded;
        graded.grade = grade;
        const bool turns = grade.way != Way::Ahead;
        const config::Gait gait = gaitAt(species_.swim, turns ? 0.5 : grade.value);
        graded.command.manoeuvre = turns ? Manoeuvre::TurnLeftSharp : Manoeuvre::ForwardMedium;
        graded.command.beatTicks = kTicksPerSecond / gait.beatHertz;
        if (turns) {
            graded.order.controller = grade.way == Way::Left ? capture::Controller::LeftTurn
                                                             : capture::Controller::RightTurn;
            graded.order.bend = bendAt(species_.turn, grade.value);
            graded.command.ticks = turnTicks(grade.value);
        } else {
            graded.order.controller = capture::Controller::ForwardSwim;
            graded.order.gait = gait;
            graded.command.ticks = static_cast<int>(std::ceil(beats * graded.command.beatTicks));
        }
        ticks_ += graded.command.ticks;
        commands_.push_back(graded);
    }
    // Interpolated between the lengths of the recorded turns; below gradual, that of the gradual
    // one.
    [[nodiscard]] int turnTicks(double grade) const {
        const auto seconds = [&](motion::Action action) {
            const auto index = static_cast<std::size_t>(action);
            return static_cast<double>(repertoire_.segments.at(index).periodSeconds);
        };
        const double share = std::max(0.0, 2 * grade - 1);
        return static_cast<int>(
            std::ceil(kTicksPerSecond * between(seconds(motion::Action::TurnLeftGradual),
                                                seconds(motion::Action::TurnLeftSharp),
                                                share)));
    }

    const config::Species& species_;
    const motion::Repertoire& repertoire_;
    std::mt19937_64 random_;
    std::vector<GradedCommand> commands_;
    int ticks_ = 0;
};

// Segments by grade. Each is captured when it is first needed and kept: the vocabularies share
// many. References to segments stay valid. Keeps a reference to the species.
class Library {
  public:
    explicit Library(const config::Species& species) : species_(species) {}

    const motion::ActionSegment& segment(const Grade& grade) {
        const auto known = segments_.find(grade);
        return known != segments_.end() ? known->second
                                        : segments_.emplace(grade, capture(grade)).first->second;
    }

  private:
    [[nodiscard]] motion::ActionSegment capture(const Grade& grade) const {
        if (grade.way == Way::Ahead) {
            const config::Gait gait = gaitAt(species_.swim, grade.value);
            return capture::compileForward(capture::swimUntilSteady(species_, gait).beat);
        }
        const capture::RecordedCycle turn =
            capture::recordTypicalLeftTurn(species_,
                                           capture::swimUntilSteady(species_, species_.swim.medium),
                                           bendAt(species_.turn, grade.value));
        const motion::ActionSegment left = capture::compileLeftTurn(turn);
        return grade.way == Way::Left ? left : capture::mirroredLeftRight(left);
    }

    const config::Species& species_;
    // A map never moves its elements.
    std::map<Grade, motion::ActionSegment> segments_;
};

// A replica with any vocabulary. The motor's repertoire has a fixed number of segments, so the next
// segment is loaded just before it is played, in turn into one of two places: the other place holds
// the segment that is still playing. Keeps references to the species and the library.
class Polyglot {
  public:
    Polyglot(const config::Species& species, const motion::Repertoire& repertoire, Library& library)
        : swim_(species.swim), library_(library), replica_(repertoire) {
        replica_.play(motion::Action::ForwardMedium, 1);
    }

    void command(const GradedCommand& graded, const Vocabulary& vocabulary) {
        const Grade nearest = nearestTo(graded.grade, vocabulary);
        if (!playing_ || *playing_ != nearest) {
            place_ = place_ == motion::Action::ForwardSlow ? motion::Action::TurnLeftGradual
                                                           : motion::Action::ForwardSlow;
            replica_.learn(place_, library_.segment(nearest));
            playing_ = nearest;
        }
        // Straight swimming is played at the commanded beat frequency, a turn as recorded.
        const double tempo = nearest.way == Way::Ahead && graded.grade.way == Way::Ahead
                                 ? gaitAt(swim_, graded.grade.value).beatHertz /
                                       gaitAt(swim_, nearest.value).beatHertz
                                 : 1;
        replica_.play(place_, tempo);
    }
    Replica& replica() { return replica_; }

  private:
    // The segment of the vocabulary that is nearest to a command. Without any turn in the
    // vocabulary a turn is played as medium swimming.
    static Grade nearestTo(const Grade& grade, const Vocabulary& vocabulary) {
        assert(!vocabulary.speeds.empty());
        const bool turns = grade.way != Way::Ahead && !vocabulary.turns.empty();
        const std::vector<double>& known = turns ? vocabulary.turns : vocabulary.speeds;
        const double wanted = turns || grade.way == Way::Ahead ? grade.value : 0.5;
        return {turns ? grade.way : Way::Ahead,
                *std::ranges::min_element(
                    known, {}, [&](double value) { return std::abs(value - wanted); })};
    }

    const config::Swim& swim_;
    Library& library_;
    Replica replica_;
    // The place that was loaded last, and what it holds. The first to be loaded is ForwardSlow,
    // since a replica starts with ForwardMedium.
    motion::Action place_ = motion::Action::TurnLeftGradual;
    std::optional<Grade> playing_;
};

// The trace of a replica under the commands; before each of them its phase is set to that of the
// fish.
Trace traceWith(const Vocabulary& vocabulary,
                const std::vector<GradedCommand>& commands,
                const Trace& fish,
                Polyglot polyglot) {
    Replica& replica = polyglot.replica();
    Trace trace{replica.point()};
    for (const GradedCommand& graded : commands) {
        replica.bringToPhaseOf(fish[trace.size() - 1].pose);
        polyglot.command(graded, vocabulary);
        for (int tick = 0; tick < graded.command.ticks; ++tick) {
            replica.tick();
            trace.push_back(replica.point());
        }
    }
    return trace;
}

// Memory of increments, nodal points and control points at all phases.
constexpr std::size_t kBytesOfSegment =
    motion::kPhases *
    (sizeof(motion::FrameIncrement) + sizeof(motion::NodalPose) + sizeof(motion::ControlPointPose));

}  // namespace

std::vector<VocabularyErrors> compareVocabularies(const config::Species& species,
                                                  const motion::Repertoire& repertoire,
                                                  std::uint64_t seed,
                                                  double seconds) {
    // The biomechanical fish is simulated once, for all vocabularies.
    const GradedScript graded(species, repertoire, seed, seconds);
    Script script;
    std::vector<TimedOrder> orders;
    for (const GradedCommand& command : graded.commands()) {
        script.push_back(command.command);
        orders.push_back({command.order, command.command.ticks});
    }
    const Trace fish = traceFish(species, orders);
    Library library(species);

    std::vector<VocabularyErrors> all;
    for (const Vocabulary& vocabulary : vocabularies()) {
        const Trace replica =
            traceWith(vocabulary, graded.commands(), fish, Polyglot(species, repertoire, library));
        // The third trace is for open-loop errors, which are not used here.
        const Comparison comparison = compare(script, {fish, replica, replica});
        std::vector<CommandErrors> turns;
        for (const CommandErrors& errors : comparison.commands)
            if (isTurn(errors.command.manoeuvre)) turns.push_back(errors);
        const Summary summary = summarise(comparison.commands);
        all.push_back({.segments = vocabulary.segments(),
                       .bytes = vocabulary.segments() * kBytesOfSegment,
                       .shapeWithin = summary.shapeWithin,
                       .pathError = summary.pathErrorMedian,
                       .turnHeadingError = summarise(turns).headingErrorRms});
    }
    return all;
}

}  // namespace aquarama::report
