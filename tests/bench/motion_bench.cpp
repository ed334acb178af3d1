// SPDX-License-Identifier: Apache-2.0
// What it costs the master to move a fish: body frame and motion state, and the nodal points that
// it asks for, with the captured repertoire of the show. Times are per iteration; the counter
// ns_per_fish is what to read.
#include <algorithm>
#include <ctime>
#include <random>
#include <span>

#include <benchmark/benchmark.h>

#include "common/body/fish_body.h"
#include "common/motion/motor.h"
#include "common/motion/reconstruct.h"
#include "tests/support/scad.h"

namespace aquarama::bench {
namespace {

const motion::MotorTables& tables() {
    static const auto kTables = motion::makeMotorTables(test::scadRepertoire());
    return *kTables;
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
            states.segment[i] =
                motion::firstSegmentOf(static_cast<motion::Action>(commands.action[i]));
        }
    }

    void decide(std::size_t fish) {
        const auto action = static_cast<motion::Action>(random() % motion::kActions);
        commands.action[fish] = static_cast<std::uint8_t>(action);
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

// The paper's quantity (Table 1): the body frame and all nodal points of every fish at every tick,
// by the functions of the show. Chunk by chunk, as the world moves its fish; the nodal points of a
// chunk are written over those of the one before.
void frameAndNodes(benchmark::State& state) {
    constexpr std::size_t kChunk = 256;
    School school(static_cast<std::size_t>(state.range(0)));
    std::vector<body::NodalPoints> nodes(kChunk);
    measure(
        state,
        school.traits.size(),
        [&] { school.decideSome(); },
        [&] {
            motion::MotorStep step = school.step();
            const std::size_t fish = step.last;
            for (step.first = 0; step.first < fish; step.first = step.last) {
                step.last = std::min(step.first + kChunk, fish);
                step.run();
                motion::nodalPoints(tables(),
                                    school.traits,
                                    school.states,
                                    step.first,
                                    std::span(nodes).first(step.last - step.first));
                benchmark::DoNotOptimize(nodes.data());
            }
        });
}
BENCHMARK(frameAndNodes)
    ->Name("frame_and_nodes")
    ->ArgName("fish")
    ->Arg(1000)
    ->Arg(10000)
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

// One fish as poseCage() poses it; a render node does so 512 times for a species without recorded
// control points, when it loads.
void poseOneCage(benchmark::State& state) {
    const body::FishBody body = body::makeBody(test::scad());
    std::vector<glm::vec3> points(body::kControlPoints);
    measure(
        state, 1, [] {}, [&] { body::poseCage(body, body.restNodes, points); });
    benchmark::DoNotOptimize(points.data());
}
BENCHMARK(poseOneCage)->Name("pose_cage")->UseManualTime();

}  // namespace
}  // namespace aquarama::bench
