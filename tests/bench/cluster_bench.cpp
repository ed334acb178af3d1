// SPDX-License-Identifier: Apache-2.0
// What a fish costs on the wire, and how far apart three nodes let go of a frame.
#include <algorithm>
#include <map>
#include <mutex>
#include <vector>

#include <benchmark/benchmark.h>
#include <spdlog/spdlog.h>

#include "common/wire/messages.h"
#include "tests/support/stage.h"

namespace aquarama::bench {
namespace {

wire::StateFrame stateOf(std::int64_t fish) {
    wire::StateFrame state;
    for (std::int64_t i = 0; i < fish; ++i) {
        const auto n = static_cast<std::uint32_t>(i) * 2654435761U;
        state.after.push_back({.x = static_cast<std::int32_t>(n),
                               .y = static_cast<std::int32_t>(n >> 3U),
                               .z = static_cast<std::int32_t>(n >> 5U),
                               .orientationLow = n,
                               .orientationHigh = ~n,
                               .phase = static_cast<std::uint16_t>(n),
                               .fromPhase = 0,
                               .segment = static_cast<std::uint8_t>(n % motion::kSegments),
                               .fromSegment = 0,
                               .warpFrame = 0,
                               .warpLength = 0});
    }
    return state;
}

// Nanoseconds a fish, and bytes a fish in a frame that shows one tick (live: twice as many).
void report(benchmark::State& bench, std::int64_t fish, std::size_t packetBytes) {
    bench.counters["per_fish"] = benchmark::Counter(
        static_cast<double>(fish),
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    bench.counters["bytes_per_fish"] = static_cast<double>(packetBytes) / static_cast<double>(fish);
}

void encodeFish(benchmark::State& bench) {
    const wire::StateFrame state = stateOf(bench.range(0));
    std::size_t bytes = 0;
    for (auto _ : bench) {
        const wire::Packet packet = wire::encodeState(1, wire::viewOf(state));
        bytes = packet.size();
        benchmark::DoNotOptimize(packet.data());
    }
    report(bench, bench.range(0), bytes);
}

void decodeFish(benchmark::State& bench) {
    const wire::Packet packet = wire::encodeState(1, wire::viewOf(stateOf(bench.range(0))));
    for (auto _ : bench) {
        auto state = wire::readState(wire::decode(packet)->state());
        benchmark::DoNotOptimize(state);
    }
    report(bench, bench.range(0), packet.size());
}

BENCHMARK(encodeFish)->Name("encode")->ArgName("fish")->Arg(51)->Arg(1000)->Arg(10000);
BENCHMARK(decodeFish)->Name("decode")->ArgName("fish")->Arg(51)->Arg(1000)->Arg(10000);

// Shows that nodes draw nothing for; when each let go of each frame.
class Releases {
  public:
    void attend(session::Session& session) {
        while (session.join()) {
            session.prepared(1, config::QualityTier::Low);
            while (const auto state = session.nextFrame()) {
                if (session.readyThenWait(state->frame) != session::Release::Present) continue;
                const std::lock_guard lock(mutex_);
                times_[state->frame.value].push_back(net::monotonicNow());
            }
            if (session.interruption() == session::Release::Quit) return;
        }
    }
    // Latest minus earliest of each frame that all of them presented, in ascending order.
    std::vector<double> skewsMicroseconds(std::size_t nodes) const {
        std::vector<double> skews;
        for (const auto& [frame, times] : times_) {
            if (times.size() != nodes) continue;
            const auto [first, last] = std::ranges::minmax(times);
            skews.push_back(std::chrono::duration<double, std::micro>(last - first).count());
        }
        std::ranges::sort(skews);
        return skews;
    }

  private:
    std::mutex mutex_;
    std::map<std::uint64_t, std::vector<net::Instant>> times_;
};

// Three nodes and their master over the loopback, five seconds at 60 Hz.
void barrierSkew(benchmark::State& bench) {
    spdlog::set_level(spdlog::level::warn);
    const std::vector<std::string> names = {"left", "middle", "right"};
    constexpr std::uint64_t kFrames = 300;
    Releases releases;
    for (auto _ : bench) {
        conductor::ConductorOptions options;
        options.frames = kFrames;
        test::StageMaster master(options);
        const auto blobs = test::freshDirectory();
        std::vector<std::thread> nodes;
        for (const std::string& name : names) {
            nodes.emplace_back([&] {
                const auto session = session::makeSession(name, master.connect(), blobs);
                releases.attend(*session);
            });
        }
        master.report();
        for (std::thread& node : nodes) node.join();
        std::filesystem::remove_all(blobs);
    }
    const auto skews = releases.skewsMicroseconds(names.size());
    if (skews.empty()) return bench.SkipWithError("no frame was presented by all nodes");
    bench.counters["median_us"] = skews[skews.size() / 2];
    bench.counters["p99_us"] = skews[skews.size() * 99 / 100];
    bench.counters["together"] = static_cast<double>(skews.size()) / kFrames;
}

BENCHMARK(barrierSkew)
    ->Name("barrier_skew")
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aquarama::bench
