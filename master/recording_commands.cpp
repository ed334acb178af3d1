// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

#include "common/units/digest.h"
#include "common/units/log.h"
#include "common/wire/recording.h"
#include "master/commands.h"
#include "master/simulation/living_world.h"
#include "master/simulation/recorded_world.h"

namespace aquarama {

namespace {

void tell(const std::string& path, const wire::Recording& recording) {
    for (const std::string& doubt : wire::doubtsAbout(recording))
        std::cout << path << ": " << doubt << '\n';
}

int check(const std::string& path) {
    const wire::Recording recording = wire::readRecording(path);
    tell(path, recording);
    simulation::LivingWorld world(simulation::worldOptionsOf(recording.assets));
    simulation::Playback playback(recording, world);
    while (!playback.over()) playback.advance();
    std::cout << fmt::format("{}: {} ticks, {} inputs, {} hashes compared\n",
                             path,
                             world.tick().value,
                             playback.inputs(),
                             playback.compared());
    if (playback.compared() == 0)
        throw Error(path + ": was cut short before its first hash; there is nothing to compare");
    if (!playback.difference()) {
        std::cout << fmt::format(
            "{}: the replay is the same world, its hash is {:016x}\n", path, world.hash());
        return 0;
    }
    const simulation::Difference& found = *playback.difference();
    std::cout << fmt::format(
        "{}: differs at tick {} (recorded {:016x}, replayed {:016x}); {}\n",
        path,
        found.tick.value,
        found.recorded,
        found.replayed,
        found.lastSame ? fmt::format("it last was the same at tick {}", found.lastSame->value)
                       : std::string("it never was the same"));
    return 1;
}

std::string wordsFor(const wire::RecordedInput& input) {
    if (const auto* food = std::get_if<wire::RecordedFood>(&input.input))
        return fmt::format("food, {} pellets at {:.2f} {:.2f} {:.2f} m",
                           food->pellets,
                           food->position.x,
                           food->position.y,
                           food->position.z);
    if (const auto* s = std::get_if<Steering>(&input.input))
        return fmt::format("steering ahead {} aside {} up {} turn {} tilt {}",
                           s->ahead,
                           s->aside,
                           s->up,
                           s->turn,
                           s->tilt);
    const auto& moved = std::get<wire::RecordedSubmarine>(input.input);
    return fmt::format("submarine at {:.2f} {:.2f} {:.2f} m",
                       moved.position.x,
                       moved.position.y,
                       moved.position.z);
}

int inspect(const std::string& path) {
    constexpr std::size_t kMostInputsShown = 20;
    const wire::Recording recording = wire::readRecording(path);
    const wire::AssetBundle& assets = recording.assets;
    std::cout << fmt::format(
        "{}: a recording of a show\n"
        "written by   {} (protocol {})\n"
        "ticks        {} ({:.1f} s)\n"
        "seed         {}\n"
        "scene        {} bytes\n",
        path,
        recording.build,
        recording.protocol,
        recording.lastTick().value,
        static_cast<double>(recording.lastTick().value) / kTicksPerSecond,
        assets.seed,
        assets.scene.size());
    for (const wire::SpeciesAssets& species : assets.cast)
        std::cout << fmt::format("species      {:>7} of {}, repertoire {} of {} bytes\n",
                                 species.fish,
                                 species.file.substr(species.file.rfind(' ') + 1),
                                 toHex(digestOf(species.repertoire)).substr(0, 12),
                                 species.repertoire.size());
    std::cout << fmt::format("inputs       {}\n", recording.inputs.size());
    for (std::size_t i = 0; i < std::min(recording.inputs.size(), kMostInputsShown); ++i)
        std::cout << fmt::format(
            "  tick {:>8}  {}\n", recording.inputs[i].tick.value, wordsFor(recording.inputs[i]));
    if (recording.inputs.size() > kMostInputsShown) std::cout << "  ...\n";
    std::cout << fmt::format("checkpoints  {}\n", recording.checkpoints.size());
    tell(path, recording);
    return 0;
}

void add(CLI::App& app,
         cli::Job& job,
         const char* name,
         const char* what,
         int (*run)(const std::string& path)) {
    auto path = std::make_shared<std::string>();
    CLI::App& command = *app.add_subcommand(name, what);
    command.add_option("FILE", *path, "the recording")->required();
    command.callback([path, run, &job] { job = [path, run] { return run(*path); }; });
}

}  // namespace

void addReplay(CLI::App& app, cli::Job& job) {
    add(app, job, "replay", "whether a recording gives the same world again", check);
}

void addInspect(CLI::App& app, cli::Job& job) {
    add(app, job, "inspect", "what a recording holds", inspect);
}

}  // namespace aquarama
