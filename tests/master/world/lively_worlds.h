// SPDX-License-Identifier: Apache-2.0
// All scenes, and what visitors may do to them: for tests of what holds in every world.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/base/digest.h"
#include "master/world/world.h"
#include "tests/master/world/captured_fish.h"

namespace aquarama::world {

// Scenes of the folder and of those within, by their path without the ending.
inline std::vector<std::string> allScenes() {
    const std::filesystem::path folder = AQUARAMA_SOURCE_DIR "/config/scenes";
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".txtpb")
            names.push_back(
                std::filesystem::relative(entry.path(), folder).replace_extension("").string());
    std::ranges::sort(names);
    return names;
}

// A scene as shown, but with little life before its first tick, and with fish that wait for
// drawings.
inline WorldOptions optionsFor(const std::string& scene) {
    WorldOptions options = optionsOfScene(scene);
    options.scene.livedSeconds = std::min(options.scene.livedSeconds, 2.0);
    options.scene.day.followsHall = true;
    if (!options.cast.empty()) {
        options.cast.back().fish += 2;
        options.cast.back().drawings = 2;
    }
    return options;
}

// What visitors do at a tick of a world of so many fish: all that can be done to one.
template <class AnyWorld>
void doAt(AnyWorld& world, std::size_t school) {
    const std::uint64_t tick = world.tick().value;
    const auto fish = static_cast<std::uint32_t>(school);
    if (tick % 97 == 3) world.apply(DropFood{.position = {0.5F, -5, -4}, .pellets = 20});
    if (tick % 151 == 7) world.apply(Steering{.ahead = 90, .turn = -40});
    if (tick % 151 == 90) world.apply(Steering{});
    if (tick % 83 < 40) world.apply(WallHands{{.id = 3, .point = {0.4F, 0.1F, -3}}});
    if (tick % 211 == 11) world.apply(SetClock{0.8, 7200});
    if (fish >= 2 && tick % 131 == 13)
        world.apply(
            EnterDrawing{.fish = fish - 1, .number = 7, .picture = digestOf("a"), .aside = 1});
    if (tick % 173 == 20) world.apply(SetDay{.timeOfDay = 0.8, .glideSeconds = 1});
    if (tick % 173 == 120) world.apply(SetDay{.timeOfDay = {}, .glideSeconds = 1});
    for (std::uint32_t species = 0; tick % 119 == 17 && species < 20; ++species)
        world.apply(ReleaseHunter{species});
    if (fish >= 2 && tick % 131 == 100) world.apply(LeaveDrawing{.fish = fish - 1});
}

}  // namespace aquarama::world
