// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <span>
#include <vector>

#include "common/base/digest.h"
#include "common/base/log.h"
#include "master/simulation/living_world.h"
#include "master/world/world_state.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"
#include "tests/support/synthetic_assets.h"

namespace aquarama {

namespace {

// The bytes with their last ones replaced by the digest of those before.
std::vector<std::byte> stamped(std::span<const std::byte> bytes) {
    const std::size_t body = bytes.size() - std::min(bytes.size(), sizeof(Digest::bytes));
    std::vector<std::byte> all(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(body));
    const Digest digest = digestOf(all);
    for (const std::uint8_t byte : digest.bytes) all.push_back(std::byte{byte});
    return all;
}

}  // namespace

// A state that is read can be gone on from, also one that no world was ever in.
int fuzzSave(const std::uint8_t* bytes, std::size_t size) {
    static world::World world(simulation::worldOptionsOf(test::syntheticAssets()));
    static const world::WorldState like = [] {
        world::WorldState state;
        world.save(state);
        return state;
    }();
    const world::StateBounds bounds{world.speciesParameters(), world.surroundings()};
    try {
        world.restore(world::decodeState(
            stamped(std::as_bytes(std::span(bytes, size))), like, bounds, "fuzzed"));
        for (int tick = 0; tick < 9; ++tick) world.advance();
    } catch (const Error& error) {
        promise(*error.what() != '\0', "an error says what is wrong");
    }
    return 0;
}

}  // namespace aquarama
