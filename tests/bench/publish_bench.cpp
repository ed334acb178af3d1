// SPDX-License-Identifier: Apache-2.0
// What it costs to publish a frame to twelve nodes over the loopback, plain and with keys.
#include <cstdint>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/net/channels.h"

namespace aquarama::bench {
namespace {

constexpr int kNodes = 12;

double cpuMicroseconds(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

// A master, and nodes that hear its states.
class Wall {
  public:
    explicit Wall(bool hasKeys) {
        const net::KeyPair masters = net::makeKeyPair();
        const net::KeyPair nodes = net::makeKeyPair();
        const auto allowed = [nodes] { return net::Allowed{{nodes.publicKey, "node"}}; };
        const std::string any = "tcp://127.0.0.1:*";
        master_ = hasKeys ? net::bindMaster(any, any, {}, net::MasterKeys{masters, allowed})
                          : net::bindMaster(any, any);
        for (int node = 0; node < kNodes; ++node) {
            nodes_.push_back(hasKeys ? net::connectNode(master_->controlAddress(),
                                                        {},
                                                        net::PeerKeys{masters.publicKey, nodes})
                                     : net::connectNode(master_->controlAddress()));
            nodes_.back()->subscribeState(master_->stateAddress());
        }
    }
    // A frame, to those that hear already.
    void publish(net::ByteView frame) { master_->publishState(frame); }
    // How many nodes hear something within so long.
    [[nodiscard]] int hear(net::Duration atMost) {
        int heard = 0;
        for (const auto& node : nodes_) {
            auto state = node->receiveState();
            for (; !state; state = node->receiveState()) {
                const net::Moment begin = net::monotonicNow();
                node->wait(atMost);
                if (net::monotonicNow() - begin >= atMost) break;
            }
            if (state) ++heard;
        }
        return heard;
    }

  private:
    std::unique_ptr<net::MasterChannels> master_;
    std::vector<std::unique_ptr<net::NodeChannels>> nodes_;
};

// range(0): with keys; range(1): bytes of a frame. 1 kB is a frame of the reef, 64 kB one of
// 250 000 fish.
void publish(benchmark::State& bench) {
    Wall wall(bench.range(0) != 0);
    const net::ByteVector frame(static_cast<std::size_t>(bench.range(1)), std::byte{1});
    int heard = 0;
    for (int trial = 0; trial < 100 && heard < kNodes; ++trial) {
        wall.publish(frame);
        heard = wall.hear(std::chrono::milliseconds(20));
    }
    while (wall.hear(std::chrono::milliseconds(20)) > 0) {
    }
    if (heard < kNodes) return bench.SkipWithError("not all nodes hear the states");
    double publishing = 0;
    const double begin = cpuMicroseconds(CLOCK_PROCESS_CPUTIME_ID);
    for ([[maybe_unused]] auto _ : bench) {
        const double start = cpuMicroseconds(CLOCK_THREAD_CPUTIME_ID);
        wall.publish(frame);
        publishing += cpuMicroseconds(CLOCK_THREAD_CPUTIME_ID) - start;
        if (wall.hear(std::chrono::seconds(1)) < kNodes)
            return bench.SkipWithError("a node has lost a frame");
    }
    const auto frames = static_cast<double>(bench.iterations());
    bench.counters["publish_us"] = publishing / frames;
    bench.counters["all_threads_us"] = (cpuMicroseconds(CLOCK_PROCESS_CPUTIME_ID) - begin) / frames;
    bench.counters["mbit_per_s_a_node"] = 60 * 8e-6 * static_cast<double>(bench.range(1));
}

BENCHMARK(publish)
    ->Name("publish/nodes:12")
    ->ArgNames({"keys", "bytes"})
    ->ArgsProduct({{0, 1}, {1000, 64000}})
    ->Iterations(600)
    ->UseRealTime();

}  // namespace
}  // namespace aquarama::bench
