// SPDX-License-Identifier: Apache-2.0
// The master of a rig: wires the world to the conductor.
#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "common/cli/signals.h"
#include "common/config/cast.h"
#include "common/config/rig.h"
#include "common/net/blob.h"
#include "common/net/channels.h"
#include "common/units/digest.h"
#include "common/units/error.h"
#include "common/wall/wall.h"
#include "master/conductor/conductor.h"
#include "master/conductor/status.h"
#include "master/staging/staging.h"
#include "master/world/world.h"

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

class LivingWorld final : public Simulation {
  public:
    explicit LivingWorld(World& world) : world_(world) {}
    void advance() override { world_.advance(); }
    [[nodiscard]] Tick tick() const override { return world_.tick(); }
    void records(std::vector<FishRecord>& fish) const override { world_.records(fish); }
    [[nodiscard]] Eye eye() const override {
        return {.positionMetres = world_.surroundings().submarine.position};
    }
    [[nodiscard]] std::uint64_t hash() const override { return world_.hash(); }
    [[nodiscard]] Explanation explain(std::uint32_t fish) const override {
        return {fish, static_cast<std::uint32_t>(world_.traits().size()), world_.tick(), {}};
    }

  private:
    World& world_;
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

void runMaster(const MasterOptions& options) {
    holdSignals();
    const Rig rig = readRig(options.rigPath);
    checkGeometry(rig, options.rigPath);
    auto channels = bindMaster(rig.controlAddress, rig.stateAddress);

    const Staging staging = stageScene(
        options.scenePath.empty() ? scenePathOf(rig, options.rigPath) : options.scenePath,
        options.fish);
    World world(worldOptionsOf(staging, options.seed));
    LivingWorld simulation(world);

    Welcome welcome;
    welcome.rigText = writeRig(rig);
    welcome.sceneText = writeScene(staging.scene);
    welcome.school.assign(world.traits().begin(), world.traits().end());
    Blobs blobs;
    for (const StagedSpecies& member : staging.cast) {
        welcome.cast.push_back(
            {digestOf(member.speciesBlob), digestOf(member.repertoireBlob), member.species.fish});
        blobs.emplace(welcome.cast.back().species, member.speciesBlob);
        blobs.emplace(welcome.cast.back().repertoire, member.repertoireBlob);
    }

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
