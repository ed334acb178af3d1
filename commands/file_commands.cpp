// SPDX-License-Identifier: Apache-2.0
// `aquarama inspect`, shows the contents of files of every kind; and the check of a recording by
// replaying it.
#include <algorithm>
#include <iostream>
#include <string>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

#include "capture/repertoire_files.h"
#include "capture/report/report_data.h"
#include "commands/commands.h"
#include "common/base/counted.h"
#include "common/base/digest.h"
#include "common/base/log.h"
#include "common/cli/outputs.h"
#include "common/wire/recording.h"
#include "master/simulation/living_world.h"
#include "master/simulation/recorded_world.h"
#include "master/supervisor/children.h"
#include "master/supervisor/preflight.h"

namespace aquarama {

namespace {

// The reasons why a replay of this recording may differ, one line each.
void printDoubts(const std::string& path, const wire::Recording& recording) {
    for (const std::string& doubt : wire::doubtsAbout(recording))
        std::cout << path << ": " << doubt << '\n';
}

// A cue, or a visitor's drawing, as text for a person.
std::string wordsForCue(const wire::RecordedInput& input) {
    if (const auto* day = std::get_if<wire::RecordedDay>(&input.input)) {
        const std::string to = day->timeOfDay ? fmt::format("{:.4f} of the day", *day->timeOfDay)
                                              : "that of the clock";
        return fmt::format("time of day to {} in {:.0f} s", to, day->glideSeconds);
    }
    if (const auto* release = std::get_if<wire::RecordedRelease>(&input.input))
        return fmt::format("a hunter of species {} comes", release->species);
    if (const auto* drawing = std::get_if<wire::RecordedDrawing>(&input.input))
        return fmt::format("drawing {} on fish {}", drawing->number, drawing->fish);
    return fmt::format("fish {} leaves", std::get<wire::RecordedDeparture>(input.input).fish);
}

// An input as text for a person.
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
    if (const auto* clock = std::get_if<wire::RecordedClock>(&input.input))
        return fmt::format("the hall's clock, {:.4f} of the day, a day in {:.0f} s",
                           clock->timeOfDay,
                           clock->lengthSeconds);
    if (const auto* hands = std::get_if<WallHands>(&input.input))
        return fmt::format("hands before the wall: {}", hands->size());
    if (const auto* moved = std::get_if<wire::RecordedSubmarine>(&input.input))
        return fmt::format("submarine at {:.2f} {:.2f} {:.2f} m",
                           moved->position.x,
                           moved->position.y,
                           moved->position.z);
    return wordsForCue(input);
}

// Prints the origin of a recording, its world and its first inputs.
void inspectRecording(const std::string& path) {
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
    if (recording.moment && recording.moment->lateInputs > 0)
        std::cout << fmt::format("             {} took effect before the disk had them\n",
                                 recording.moment->lateInputs);
    for (std::size_t i = 0; i < std::min(recording.inputs.size(), kMostInputsShown); ++i)
        std::cout << fmt::format(
            "  tick {:>8}  {}\n", recording.inputs[i].tick.value, wordsFor(recording.inputs[i]));
    if (recording.inputs.size() > kMostInputsShown) std::cout << "  ...\n";
    std::cout << fmt::format("checkpoints  {}\n", recording.checkpoints.size());
    printDoubts(path, recording);
}

// Options of `inspect`. A report is only for a repertoire.
struct InspectOptions {
    std::string file;
    std::string report;  // folder for a page; empty: none
};

// Tests for Python first, since drawing is the last step.
void inspectRepertoire(const InspectOptions& options) {
    cli::requireFolder("--report", options.report);
    if (!options.report.empty()) cli::requirePython({"matplotlib"});
    const std::vector<std::byte> bytes = capture::readRepertoireFile(options.file);
    std::cout << report::inspectRepertoire(bytes, options.file);
    if (options.report.empty()) return;
    const motion::Repertoire repertoire = motion::decodeRepertoire(bytes, options.file);
    const std::string data = report::writeReport(repertoire, options.report).string();
    std::cout << '\n';
    cli::runPython({"matplotlib"}, "capture/report/draw_report.py", {data}, options.report);
}

// Tells the kind of file by its suffix or its first bytes. All other kinds are texts, which
// aquarama-compose reads.
void inspect(const InspectOptions& options) {
    const std::string& file = options.file;
    if (file.ends_with(".aqrep") || supervisor::looksLikeRepertoire(file))
        return inspectRepertoire(options);
    if (!options.report.empty())
        throw CLI::ValidationError("--report", "is for a repertoire, which " + file + " is not");
    if (file.ends_with(".aqrec") || supervisor::looksLikeRecording(file))
        return inspectRecording(file);
    supervisor::become({supervisor::siblingProgram("compose"), {"inspect", file}, "aquarama"});
}

}  // namespace

// Returns the exit status: 1 where the worlds differ. Throws Error where there is no hash to
// compare.
int checkReplay(const std::string& path, Tick from) {
    const wire::Recording recording = wire::readRecording(path);
    printDoubts(path, recording);
    simulation::LivingWorld world(simulation::worldOptionsOf(recording.assets));
    simulation::Playback playback(recording, world);
    playback.goTo(from);
    const std::uint64_t first = world.tick().value;
    while (!playback.over()) playback.advance();
    std::cout << fmt::format(
        "{}: {}, {}, {} compared\n",
        path,
        counted(world.tick().value - first, "tick"),
        counted(playback.inputs(), "input"),
        playback.compared() == 1 ? "1 hash" : std::to_string(playback.compared()) + " hashes");
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

void addInspect(CommandLine& line) {
    const auto [command, options] = line.add<InspectOptions>(
        "inspect",
        "show the contents of a rig, a scene, a species, a repertoire or a recording",
        inspect);
    command
        .add_option("FILE",
                    options.file,
                    "a rig, a scene or a species (.txtpb), a repertoire (.aqrep) or the recording "
                    "of a show (.aqrec)")
        ->required();
    command.add_option(
        "--report", options.report, "of a repertoire: folder for a page with pictures and figures");
}

}  // namespace aquarama
