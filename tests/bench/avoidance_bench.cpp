// SPDX-License-Identifier: Apache-2.0
// What it costs a thought to feel sand, rocks and borders: with the chart, and worked out.
#include <vector>

#include <benchmark/benchmark.h>

#include "common/base/hash.h"
#include "common/place/place.h"
#include "master/surroundings/avoidance.h"
#include "tests/support/school_region.h"

namespace aquarama::bench {
namespace {

constexpr float kReachMetres = 1.5F;  // of a scad at medium speed

struct Swimmer {
    glm::vec3 position, heading;
};

// Strewn through the water of the reef; outwards to its borders as often as anywhere else.
std::vector<Swimmer> swimmers(const place::Region& water) {
    std::vector<Swimmer> all;
    for (std::uint32_t i = 0; i < 4096; ++i) {
        const auto draw = [&](std::uint32_t of) { return signedUnitOf(hashOf(hashOf(9, i), of)); };
        all.push_back({water.centre + water.halfExtent * glm::vec3{draw(0), draw(1), draw(2)},
                       place::directionOf({draw(3), 0.3F * draw(4), draw(5)}, {1, 0, 0})});
    }
    return all;
}

template <glm::vec3 (*avoid)(
    const place::Obstacles&, glm::vec3, glm::vec3, float, const surroundings::Berth&)>
void avoidanceCost(benchmark::State& state) {
    const place::Obstacles obstacles = place::obstaclesOf({1}, test::schoolRegion());
    const std::vector<Swimmer> fish = swimmers(obstacles.water);
    for (auto _ : state)
        for (const Swimmer& one : fish)
            benchmark::DoNotOptimize(avoid(obstacles, one.position, one.heading, kReachMetres, {}));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(fish.size()));
}
BENCHMARK(avoidanceCost<surroundings::avoidance>)->Name("avoidance/charted");
BENCHMARK(avoidanceCost<surroundings::plainAvoidance>)->Name("avoidance/plain");

}  // namespace
}  // namespace aquarama::bench
