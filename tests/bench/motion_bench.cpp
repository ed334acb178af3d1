// SPDX-License-Identifier: Apache-2.0
// What a fish costs to move (paper, Table 1: 10 microseconds for frame and nodal points). Times are
// per iteration; the counter ns_per_fish is what to read.
#include <algorithm>
#include <ctime>
#include <random>

#include <benchmark/benchmark.h>

#include "common/body/cage_tables.h"
#include "common/config/species.h"
#include "common/motion/motor.h"
#include "common/motion/reconstruct.h"
#include "tests/support/synthetic_repertoire.h"

namespace aquarama::bench {
namespace {

const motion::Repertoire& repertoire() {
    static const motion::Repertoire kRepertoire = test::syntheticRepertoire(true);
    return kRepertoire;
}

const motion::MotorTables& tables() {
    static const auto kTables = motion::makeMotorTables(repertoire());
    return *kTables;
}

const motion::ReconstructTables& posesOfRepertoire() {
    static const motion::ReconstructTables kPoses = motion::makeReconstructTables(repertoire());
    return kPoses;
}

// A school at sea: every fish in some segment and phase, and some 1.5 changes of segment a second.
struct School {
    motion::MotionStates states;
    motion::MotorCommands commands;
    std::vector<motion::FishTraits> traits;
    std::mt19937 random{1};

    explicit School(std::size_t fish) : traits(fish) {
        states.resize(fish);
        commands.resize(fish);
        for (std::size_t i = 0; i < fish; ++i) {
            traits[i] = {static_cast<std::uint32_t>(i),
                         static_cast<std::uint16_t>(100 + random() % 300)};
            motion::setBodyFrame(states, i, {});
            states.phase[i] = static_cast<std::uint16_t>(random());
            decide(i);
            states.segment[i] = commands.segment[i];
        }
    }

    void decide(std::size_t fish) {
        const auto action = static_cast<motion::Action>(random() % motion::kActions);
        commands.segment[fish] = static_cast<std::uint8_t>(action);
        commands.phaseRate[fish] = motion::recordedPhaseRate(tables(), action);
        commands.yawRate[fish] = static_cast<std::int16_t>(random() % 2000);
        commands.pitch[fish] = static_cast<std::int16_t>(random() % 8000);
    }
    void decideSome() {
        for (std::size_t i = 0; i < traits.size() / 40; ++i) decide(random() % traits.size());
    }

    [[nodiscard]] motion::MotorStep step() {
        return {.tables = &tables(),
                .traits = traits,
                .commands = &commands,
                .states = &states,
                .first = 0,
                .last = traits.size()};
    }
};

// Of this thread alone: what else the machine does is not the motor's.
double processorSeconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Times `work` alone, not what prepares it.
template <class Prepare, class Work>
void measure(benchmark::State& state, std::size_t fish, Prepare&& prepare, Work&& work) {
    double total = 0;
    for ([[maybe_unused]] auto iteration : state) {
        prepare();
        const double begin = processorSeconds();
        work();
        const double seconds = processorSeconds() - begin;
        state.SetIterationTime(seconds);
        total += seconds;
    }
    const double played = static_cast<double>(state.iterations()) * static_cast<double>(fish);
    state.counters["ns_per_fish"] = total / played * 1e9;
    state.SetItemsProcessed(static_cast<std::int64_t>(played));
}

constexpr double kStateBytes =
    sizeof(motion::FishRecord) + 4;  // orientation lies in 13 bytes, not in 8
constexpr double kCommandBytes = 7;

void bodyFrame(benchmark::State& state) {
    School school(static_cast<std::size_t>(state.range(0)));
    measure(
        state, school.traits.size(), [&] { school.decideSome(); }, [&] { school.step().run(); });
    state.counters["bytes_per_fish"] = 2 * kStateBytes + kCommandBytes + sizeof(motion::FishTraits);
}
BENCHMARK(bodyFrame)
    ->Name("body_frame")
    ->ArgName("fish")
    ->Arg(60)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Arg(1000000)
    ->UseManualTime();

void bodyFrameSteady(benchmark::State& state) {
    School school(static_cast<std::size_t>(state.range(0)));
    measure(
        state, school.traits.size(), [] {}, [&] { school.step().run(); });
}
BENCHMARK(bodyFrameSteady)
    ->Name("body_frame_steady")
    ->ArgName("fish")
    ->Arg(1000)
    ->Arg(100000)
    ->UseManualTime();

void bodyFrameReference(benchmark::State& state) {
    School school(static_cast<std::size_t>(state.range(0)));
    measure(
        state,
        school.traits.size(),
        [&] { school.decideSome(); },
        [&] { school.step().runReference(); });
}
BENCHMARK(bodyFrameReference)
    ->Name("body_frame_reference")
    ->ArgName("fish")
    ->Arg(10000)
    ->UseManualTime();

void hash(benchmark::State& state) {
    const School school(static_cast<std::size_t>(state.range(0)));
    measure(
        state,
        school.traits.size(),
        [] {},
        [&] { benchmark::DoNotOptimize(motion::hashOf(school.states)); });
}
BENCHMARK(hash)->Name("state_hash")->ArgName("fish")->Arg(10000)->UseManualTime();

// What a fish makes the memory move, and how fast that went.
void countBytes(benchmark::State& state, std::size_t bytesPerFish) {
    const auto bytes = static_cast<double>(bytesPerFish);
    state.counters["bytes_per_fish"] = bytes;
    state.counters["gb_per_s"] = bytes / state.counters["ns_per_fish"].value;
}

// How fast this machine's memory is today: a plain copy, counted as STREAM does (read and written).
void copyMemory(benchmark::State& state) {
    const std::vector<float> from(static_cast<std::size_t>(state.range(0)) / sizeof(float), 1.0F);
    std::vector<float> to(from.size());
    measure(
        state, 1, [] {}, [&] { std::copy(from.begin(), from.end(), to.begin()); });
    benchmark::DoNotOptimize(to.data());
    countBytes(state, 2 * from.size() * sizeof(float));
}
BENCHMARK(copyMemory)
    ->Name("copy")
    ->ArgName("bytes")
    ->Arg(300'000)
    ->Arg(100'000'000)
    ->UseManualTime();

// Every fish between two ticks; of them `warping` in a hundred between two segments.
std::vector<motion::PresentedFish> presented(std::size_t fish, unsigned warping) {
    School school(fish);
    std::vector<motion::PresentedFish> shown(fish);
    for (std::size_t i = 0; i < fish; ++i) {
        const motion::FishRecord record = motion::recordOf(school.states, i);
        shown[i] = motion::present(record, record, 0.5F, school.traits[i]);
        if (school.random() % 100 >= warping) continue;
        shown[i].fromSegment = static_cast<std::uint32_t>(school.random() % motion::kActions);
        shown[i].fromPhase = static_cast<float>(school.random() % 65536) / 65536.0F;
        shown[i].warpWeight = 0.4F;
    }
    return shown;
}

void nodalPointsOfMany(benchmark::State& state) {
    const auto shown =
        presented(static_cast<std::size_t>(state.range(0)), static_cast<unsigned>(state.range(1)));
    std::vector<body::NodalPoints> nodes(shown.size());
    measure(
        state,
        shown.size(),
        [] {},
        [&] { motion::nodalPoints(posesOfRepertoire(), shown, nodes); });
    countBytes(state, sizeof(motion::PresentedFish) + sizeof(body::NodalPoints));
    state.counters["table_bytes"] = static_cast<double>(posesOfRepertoire().nodes.bytes());
}
BENCHMARK(nodalPointsOfMany)
    ->Name("nodal_points")
    ->ArgNames({"fish", "percent_warping"})
    ->Args({1000, 0})
    ->Args({1000, 100})
    ->Args({100000, 100})
    ->Args({1000000, 100})
    ->UseManualTime();

void nodalPointsReference(benchmark::State& state) {
    const auto shown = presented(static_cast<std::size_t>(state.range(0)), 100);
    std::vector<body::NodalPoints> nodes(shown.size());
    measure(
        state,
        shown.size(),
        [] {},
        [&] {
            for (std::size_t i = 0; i < shown.size(); ++i) {
                motion::nodalPoints(repertoire(), shown[i], nodes[i]);
            }
        });
}
BENCHMARK(nodalPointsReference)
    ->Name("nodal_points_reference")
    ->ArgName("fish")
    ->Arg(1000)
    ->UseManualTime();

void controlPointsOfMany(benchmark::State& state) {
    const auto shown =
        presented(static_cast<std::size_t>(state.range(0)), static_cast<unsigned>(state.range(1)));
    std::vector<glm::vec3> points(shown.size() * body::kControlPoints);
    measure(
        state,
        shown.size(),
        [] {},
        [&] { motion::controlPoints(posesOfRepertoire(), shown, points); });
    countBytes(state, sizeof(motion::PresentedFish) + body::kControlPoints * sizeof(glm::vec3));
    state.counters["table_bytes"] = static_cast<double>(posesOfRepertoire().controlPoints.bytes());
}
BENCHMARK(controlPointsOfMany)
    ->Name("control_points")
    ->ArgNames({"fish", "percent_warping"})
    ->Args({60, 10})
    ->Args({60, 100})
    ->Args({1000, 100})
    ->Args({20000, 100})
    ->UseManualTime();

const body::FishBody& scadBody() {
    static const body::FishBody kBody = body::makeBody(
        config::readSpecies(AQUARAMA_SOURCE_DIR "/config/species/bigeye_scad.txtpb"));
    return kBody;
}

std::vector<float> lengthsOf(const std::vector<motion::PresentedFish>& shown) {
    std::vector<float> lengths;
    for (const motion::PresentedFish& fish : shown) lengths.push_back(fish.lengthMetres);
    return lengths;
}

// The other side of the paper's trade of memory against time (section 3.1): from nodal points.
void controlPointsFromNodes(benchmark::State& state) {
    const auto shown =
        presented(static_cast<std::size_t>(state.range(0)), static_cast<unsigned>(state.range(1)));
    const body::CageTables cage = body::makeCageTables(scadBody());
    const std::vector<float> lengths = lengthsOf(shown);
    std::vector<body::NodalPoints> nodes(shown.size());
    std::vector<glm::vec3> points(shown.size() * body::kControlPoints);
    measure(
        state,
        shown.size(),
        [] {},
        [&] {
            motion::nodalPoints(posesOfRepertoire(), shown, nodes);
            body::poseCages(cage, nodes, lengths, points);
        });
    countBytes(state, sizeof(motion::PresentedFish) + body::kControlPoints * sizeof(glm::vec3));
    state.counters["table_bytes"] =
        static_cast<double>(posesOfRepertoire().nodes.bytes() + sizeof(cage));
}
BENCHMARK(controlPointsFromNodes)
    ->Name("control_points_from_nodes")
    ->ArgNames({"fish", "percent_warping"})
    ->Args({60, 10})
    ->Args({60, 100})
    ->Args({1000, 100})
    ->Args({20000, 100})
    ->UseManualTime();

// One fish as poseCage() poses it; a render node does so 512 times for a species without recorded
// control points, when it loads.
void poseCageReference(benchmark::State& state) {
    std::vector<glm::vec3> points(body::kControlPoints);
    measure(
        state, 1, [] {}, [&] { body::poseCage(scadBody(), scadBody().restNodes, points); });
    benchmark::DoNotOptimize(points.data());
}
BENCHMARK(poseCageReference)->Name("pose_cage_reference")->UseManualTime();

}  // namespace
}  // namespace aquarama::bench
