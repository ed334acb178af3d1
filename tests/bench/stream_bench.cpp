// SPDX-License-Identifier: Apache-2.0
// What the fish of a scene cost on the wire, beside records of two ticks in each frame: bits for
// each fish and frame, nanoseconds to code and decode a step, and to follow it with the motor.
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/school/keyframe.h"
#include "common/school/school_motion.h"
#include "master/world/world.h"
#include "tests/master/world/captured_fish.h"
#include "tests/master/world/node_motion.h"

namespace aquarama::bench {
namespace {

// Sums the processor time of work in turn, of all threads: other processes do not count.
class Watch {
  public:
    template <class Work>
    auto time(const Work& work) {
        const double begin = now();
        auto result = work();
        nanoseconds_ += now() - begin;
        return result;
    }
    [[nodiscard]] double nanoseconds() const { return nanoseconds_; }

  private:
    static double now() {
        timespec time{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
    }
    double nanoseconds_ = 0;
};

// The models of the code have learned for ten seconds when it begins to count.
void measure(benchmark::State& state, const world::WorldOptions& options) {
    constexpr int kLearning = 600;
    world::World world(options);
    const auto motion = world::nodeMotion(options, world);
    const std::size_t fish = world.states().size();
    school::StepMemory memory = school::makeStepMemory(world::ratesOf(options), fish);
    motion::MotorCommands known = world.commands();
    std::vector<motion::FishRecord> records;
    world.records(records);
    school::Keyframe node =
        *school::decodeKeyframe(school::encodeKeyframe(world.tick(), records, known, memory), fish);
    Watch coding;
    Watch decoding;
    Watch moving;
    std::size_t bytes = 0;
    std::size_t ticks = 0;
    const auto follow = [&](Watch& codes, Watch& decodes, Watch& moves) {
        world.advance();
        world.records(records);
        std::vector<school::PlacedFish> placed;
        for (const std::uint32_t one : world.placed()) placed.push_back({one, records[one]});
        const auto step = codes.time([&] {
            return school::encodeStep(world.tick(), world.commands(), placed, known, memory);
        });
        const auto back = decodes.time([&] {
            return school::decodeStep(world.tick(), step, node.school.commands, node.memory);
        });
        moves.time([&] {
            motion->advance(node.school);
            return 0;
        });
        for (const school::PlacedFish& one : *back) node.school.set(one.fish, one.record);
        return step.size();
    };
    for (int tick = 0; tick < kLearning; ++tick) {
        Watch unseen;
        follow(unseen, unseen, unseen);
    }
    for ([[maybe_unused]] auto _ : state) {
        bytes += follow(coding, decoding, moving);
        ++ticks;
    }
    std::vector<motion::FishRecord> nodes;
    node.school.records(nodes);
    if (nodes != records) return state.SkipWithError("the node has other fish");
    const double each = static_cast<double>(ticks) * static_cast<double>(fish);
    state.counters["bits_per_fish_frame"] = 8.0 * static_cast<double>(bytes) / each;
    state.counters["records_bits"] = 2 * 8 * sizeof(motion::FishRecord);
    state.counters["encode_ns"] = coding.nanoseconds() / each;
    state.counters["decode_ns"] = decoding.nanoseconds() / each;
    state.counters["motor_ns"] = moving.nanoseconds() / each;
}

void scene(benchmark::State& state, const std::string& name) {
    measure(state, world::optionsOfScene(name));
}

void openSea(benchmark::State& state) {
    world::WorldOptions options = world::optionsOfScene("empty_sea");
    options.cast.front().fish = static_cast<std::uint32_t>(state.range(0));
    options.threads = 2;
    measure(state, options);
}

BENCHMARK_CAPTURE(scene, reef, "reef")->Name("wire/scene:reef")->Iterations(3600);
BENCHMARK_CAPTURE(scene, bait_ball, "bait_ball")->Name("wire/scene:bait_ball")->Iterations(3600);
BENCHMARK(openSea)->Name("wire/scene:empty_sea/fish")->Arg(10'000)->Iterations(600);
BENCHMARK(openSea)->Name("wire/scene:empty_sea/fish")->Arg(250'000)->Iterations(60);

}  // namespace
}  // namespace aquarama::bench
