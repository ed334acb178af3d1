// SPDX-License-Identifier: Apache-2.0
// How far apart three nodes let go of a frame, and how long it takes from a hand to the
// frame that shows it.
#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>
#include <spdlog/spdlog.h>

#include "tests/support/stage.h"

namespace aquarama::bench {
namespace {

// Shows in which nodes sleep instead of drawing; when each let go of each frame.
class Releases {
  public:
    void attend(session::Session& session, net::Duration drawing) {
        while (const auto admission = session.join()) {
            session.prepared(1, config::QualityTier::Low, test::stillMotion(*admission));
            while (const auto state = session.nextFrame()) {
                std::this_thread::sleep_for(drawing);
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
    std::map<std::uint64_t, std::vector<net::Moment>> times_;
};

constexpr std::uint64_t kFrames = 300;

// Three nodes and their master over the loopback: 300 frames, of which `left` draws each for
// range(0) and the others for range(1) milliseconds. 12 and 12, and 30 and 3, are what
// SGCT was measured with: 9.2 and 57 ms.
void barrierSkew(benchmark::State& bench) {
    spdlog::set_level(spdlog::level::warn);
    const std::vector<std::string> names = {"left", "middle", "right"};
    Releases releases;
    for (auto _ : bench) {
        conductor::ConductorOptions options;
        options.frames = kFrames;
        test::StageMaster master(options);
        const auto blobs = test::freshDirectory();
        std::vector<std::thread> nodes;
        for (const std::string& name : names) {
            const std::chrono::milliseconds drawing(bench.range(name == "left" ? 0 : 1));
            nodes.emplace_back([&, drawing] {
                const auto session = session::makeSession(name, master.connect(), blobs);
                releases.attend(*session, drawing);
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
    ->ArgNames({"left_ms", "others_ms"})
    ->Args({0, 0})
    ->Args({12, 12})
    ->Args({30, 3})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// Steers ahead and back at random moments, each time when the last has been seen.
class Hand {
  public:
    explicit Hand(session::Session& session)
        : session_(session), thread_([this](const std::stop_token& end) { move(end); }) {}
    // A frame with the eye here was let go of now.
    void see(float aheadMetres) {
        const std::int64_t since = movedNs_;
        if (since == 0 || aheadMetres == before_) return;
        refreshes.push_back(
            net::secondsIn(net::monotonicNow() - net::Moment{net::Duration{since}}) * 60);
        movedNs_ = 0;
    }
    std::vector<double> refreshes;  // of 60 Hz, from the hand to the release

  private:
    void move(const std::stop_token& end) {
        std::mt19937 random(1);
        for (std::int8_t ahead = 50; !end.stop_requested();) {
            std::this_thread::sleep_for(std::chrono::microseconds(200000 + random() % 100000));
            if (movedNs_ != 0) continue;
            before_ = ahead;
            ahead = static_cast<std::int8_t>(150 - ahead);
            movedNs_ = net::monotonicNow().time_since_epoch().count();
            session_.steer({.ahead = ahead});
        }
    }

    session::Session& session_;
    std::atomic<float> before_ = 0;
    std::atomic<std::int64_t> movedNs_ = 0;
    std::jthread thread_;
};

// From a hand that steers in a node's window to the release of the first frame whose eye has moved,
// 100 times. All three nodes draw for range(0) milliseconds.
void inputToLight(benchmark::State& bench) {
    spdlog::set_level(spdlog::level::warn);
    std::vector<double> refreshes;
    for (auto _ : bench) {
        test::StageMaster master(conductor::ConductorOptions{});
        const std::chrono::milliseconds drawing(bench.range(0));
        test::Journal journal;
        const test::StageNode::Habits habits{.drawing = drawing};
        test::StageNode middle("middle", master.connect(), journal, habits);
        test::StageNode right("right", master.connect(), journal, habits);
        const auto blobs = test::freshDirectory();
        const auto session = session::makeSession("left", master.connect(), blobs);
        const auto admission = session->join();
        if (!admission) return bench.SkipWithError("no show");
        session->prepared(1, config::QualityTier::Low, test::stillMotion(*admission));
        Hand hand(*session);
        while (hand.refreshes.size() < 100) {
            const auto state = session->nextFrame();
            if (!state) return bench.SkipWithError("the show was interrupted");
            std::this_thread::sleep_for(drawing);
            if (session->readyThenWait(state->frame) == session::Release::Present)
                hand.see(-state->eye.positionMetres.z);
        }
        refreshes = hand.refreshes;
        std::filesystem::remove_all(blobs);
    }
    std::ranges::sort(refreshes);
    bench.counters["median_refreshes"] = refreshes[refreshes.size() / 2];
    bench.counters["p99_refreshes"] = refreshes[refreshes.size() * 99 / 100];
}

BENCHMARK(inputToLight)
    ->Name("input_to_light")
    ->ArgName("draws_ms")
    ->Arg(0)
    ->Arg(8)
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aquarama::bench
