// SPDX-License-Identifier: Apache-2.0
// The master of a rig: wires the world to the conductor.
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <span>
#include <string>

#include <CLI/CLI.hpp>

#include "common/cli/signals.h"
#include "common/config/cast.h"
#include "common/config/rig.h"
#include "common/net/channels.h"
#include "common/units/digest.h"
#include "common/units/error.h"
#include "common/wall/wall.h"
#include "master/conductor/conductor.h"
#include "master/conductor/status.h"
#include "master/production/living_world.h"
#include "master/production/production.h"

namespace aquarama {

namespace {

struct MasterOptions {
    std::string rigPath;
    std::string scenePath;  // empty: the rig's
    bool lockstep = false;
    std::optional<std::uint64_t> frames;
    std::uint32_t seed = 1;
    std::optional<std::uint32_t> fish;
    std::string pattern = "world";
    std::string traceFolder;
};

ConductorOptions conductorOptions(const MasterOptions& options) {
    ConductorOptions conductor;
    conductor.pace = options.lockstep ? Pace::Lockstep : Pace::Live;
    conductor.pattern = options.pattern == "grid"   ? Pattern::Grid
                        : options.pattern == "grey" ? Pattern::Grey
                                                    : Pattern::World;
    conductor.frames = options.frames;
    conductor.seed = options.seed;
    conductor.traceDirectory = options.traceFolder;
    return conductor;
}

// What the nodes are told of the cast, and the blobs that they may then ask for.
std::vector<SpeciesBlobs> castOf(const Production& production, Blobs& blobs) {
    std::vector<SpeciesBlobs> cast;
    for (const ProducedSpecies& species : production.cast) {
        const auto text = std::as_bytes(std::span{species.text});
        cast.push_back({digestOf(text), digestOf(species.repertoire), species.fish});
        blobs.emplace(cast.back().species, ByteVector{text.begin(), text.end()});
        blobs.emplace(cast.back().repertoire, species.repertoire);
    }
    return cast;
}

void runMaster(const MasterOptions& options) {
    holdSignals();
    const Rig rig = readRig(options.rigPath);
    checkGeometry(rig, options.rigPath);
    auto channels = bindMaster(rig.controlAddress, rig.stateAddress);

    const Production production = readProduction(
        options.scenePath.empty() ? scenePathOf(rig, options.rigPath) : options.scenePath,
        {.seed = options.seed, .fish = options.fish});
    LivingWorld simulation(worldOptionsOf(production));

    Blobs blobs;
    Welcome welcome;
    welcome.rigText = writeRig(rig);
    welcome.sceneText = production.scene;
    welcome.cast = castOf(production, blobs);
    const auto school = simulation.world().traits();
    welcome.school.assign(school.begin(), school.end());

    Conductor conductor(rig,
                        conductorOptions(options),
                        simulation,
                        std::move(welcome),
                        std::move(blobs),
                        std::move(channels));
    const SignalWatch watch([&] { conductor.stop(); });
    conductor.run();
}

int dispatch(int count, char** arguments) {
    CLI::App app{"The master of a rig: moves every fish, and has all nodes present in step",
                 "aquarama-master"};
    MasterOptions options;
    auto* rig = app.add_option("RIG", options.rigPath, "the rig's file");
    app.add_flag("--lockstep", options.lockstep, "frame n shows tick n; no clock is read");
    app.add_option("--frames", options.frames, "end after so many frames");
    app.add_option("--seed", options.seed, "of the world: the same seed gives the same world");
    app.add_option("--scene", options.scenePath, "what is shown, instead of the rig's scene");
    app.add_option(
           "--fish", options.fish, "how many of the first species, instead of the scene's number")
        ->check(CLI::Range(0U, kMostFish));
    app.add_option("--pattern", options.pattern, "what the channels show")
        ->check(CLI::IsMember({"world", "grid", "grey"}));
    app.add_option(
        "--trace", options.traceFolder, "folder for master.csv: a line of times a frame");

    std::string statusRig = "config/desk.txtpb";
    std::string statusAddress;
    CLI::App& status = *app.add_subcommand("status", "what the running wall is doing");
    status.add_option("RIG", statusRig, "whose master is asked")->capture_default_str();
    status.add_option("--master", statusAddress, "its control address, instead of the rig's");
    try {
        app.parse(count, arguments);
        if (!status.parsed() && rig->empty()) throw CLI::RequiredError("RIG");
    } catch (const CLI::ParseError& wrong) {
        return app.exit(wrong) == 0 ? 0 : 2;
    }
    if (status.parsed()) {
        std::cout << runStatus(statusAddress.empty() ? readRig(statusRig).controlAddress
                                                     : statusAddress);
    } else {
        runMaster(options);
    }
    return 0;
}

}  // namespace

}  // namespace aquarama

int main(int count, char** arguments) {
    try {
        return aquarama::dispatch(count, arguments);
    } catch (const std::exception& error) {
        std::cerr << "aquarama-master: " << error.what() << '\n';
        return 1;
    }
}
