// SPDX-License-Identifier: Apache-2.0
// aquarama_world_hash SEED FISH TICKS THREADS: what the world's hash is then, to compare two builds.
#include <cstdio>
#include <cstdlib>

#include "tests/master/world/school_of_synthetic_fish.h"

int main(int argc, char** argv) {
    using namespace aquarama;
    if (argc != 5) {
        std::fprintf(stderr, "usage: %s SEED FISH TICKS THREADS\n", argv[0]);
        return 2;
    }
    const auto number = [&](int i) { return std::strtoul(argv[i], nullptr, 10); };
    World world = syntheticWorld(static_cast<std::uint32_t>(number(1)),
                                 static_cast<std::uint32_t>(number(2)),
                                 static_cast<unsigned>(number(4)));
    for (unsigned long i = 0; i < number(3); ++i) world.advance();
    std::printf("%016llx\n", static_cast<unsigned long long>(world.hash()));
}
