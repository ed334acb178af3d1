// SPDX-License-Identifier: Apache-2.0
// aquarama_world_hash SCENE FISH TICKS THREADS [TARGET]: the hash of a scene of config/scenes after
// so many ticks from its very beginning, its school of FISH and the other species on their captured
// repertoires, to compare two builds. TARGET is an instruction set by its name in Highway (AVX2,
// SSE4, EMU128 ...), by default the best; exit status 3 where this machine has none of that name.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/master/world/captured_fish.h"
#include "tests/support/instruction_sets.h"

namespace {

bool use(std::string_view name) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        if (name != hwy::TargetName(target)) continue;
        aquarama::test::useOnly(target);
        return true;
    }
    std::fprintf(stderr, "no instruction set %.*s here; there are:", int(name.size()), name.data());
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
        std::fprintf(stderr, " %s", hwy::TargetName(target));
    std::fputc('\n', stderr);
    return false;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace aquarama;
    if (argc != 5 && argc != 6) {
        std::fprintf(stderr, "usage: %s SCENE FISH TICKS THREADS [TARGET]\n", argv[0]);
        return 2;
    }
    if (argc == 6 && !use(argv[5])) return 3;
    const auto number = [&](int i) { return std::strtoul(argv[i], nullptr, 10); };
    world::WorldOptions options = world::optionsOfScene(argv[1]);
    options.scene.livedSeconds = 0;
    options.cast.front().fish = static_cast<std::uint32_t>(number(2));
    options.threads = static_cast<unsigned>(number(4));
    world::World world(options);
    for (unsigned long i = 0; i < number(3); ++i) world.advance();
    std::printf("%016llx\n", static_cast<unsigned long long>(world.hash()));
}
