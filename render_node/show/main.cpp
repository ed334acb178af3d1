// SPDX-License-Identifier: Apache-2.0
// aquarama-node: one process for each projector.
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/cli/command_line.h"
#include "common/cli/outputs.h"
#include "common/config/keys.h"
#include "common/config/species.h"
#include "common/machine/connectors.h"
#include "common/net/channels.h"
#include "common/skin/limit_table.h"
#include "render_node/gl/context.h"
#include "render_node/show/run_node.h"
#include "render_node/show/wait_for_key.h"
#include "render_node/surface/skin_colours.h"

namespace {

constexpr const char* kFooter =
    "Keys in its window: w a s d, arrows and page up and down steer the submarine, q or Escape "
    "ends "
    "the show,\np or space pauses it, h lists them all.\n"
    "Software OpenGL draws with as many threads as LP_NUM_THREADS says; where several nodes share "
    "a "
    "machine,\nits cores divided by the nodes is best.";

std::string addressProblem(const std::string& address) {
    try {
        aquarama::net::requireConnectAddress(address);
        return {};
    } catch (const aquarama::Error& problem) {
        return problem.what();
    }
}

// Instead of a channel: the colours of a skin, which aquarama fidelity --clip asks for.
struct PaintOptions {
    std::string species;  // its file; empty: none
    std::string out;
};

// The key file of the node.
struct KeyOptions {
    std::string path;        // empty: none
    bool isAwaited = false;  // it may be handed over
};

void describe(CLI::App& app,
              aquarama::show::NodeOptions& options,
              KeyOptions& key,
              PaintOptions& paint) {
    CLI::Option* name =
        app.add_option("NAME", options.channel, "the channel of the rig that this node shows");
    app.add_option("--master",
                   options.masterAddresses,
                   "the master's control address, tcp://HOST:PORT; once more: that of its standby")
        ->allow_extra_args(false)
        ->check(CLI::Validator(addressProblem, ""));
    app.add_option(
           "--key", key.path, "file of aquarama keys bundle, which names channel and master")
        ->excludes(name);
    app.add_flag("--wait-for-key",
                 key.isAwaited,
                 "where there is no such file yet: show a letter and a code on each monitor, until "
                 "the console or aquarama nodes assign hands it over")
        ->needs("--key");
    CLI::Option* connector = app.add_option(
        "--connector",
        options.connector,
        "the monitor of a channel that fills one, as HDMI-1, instead of the rig's; its letter is "
        "on that one alone");
    app.add_flag("--headless", options.headless, "draw without a display")->excludes(connector);
    app.add_option(
           "--device",
           options.device,
           "with --headless: auto, nvidia, mesa, surfaceless or device:N, instead of the rig's")
        ->needs("--headless");
    app.add_option("--snapshot",
                   options.snapshotFolder,
                   "folder for channel-NAME.png, the last frame that was shown");
    app.add_flag("--deep", options.deep, "16 bits in the snapshot instead of 8 dithered ones")
        ->needs("--snapshot");
    app.add_option("--panorama",
                   options.panoramaScale,
                   "panorama.png of the whole wall in the snapshot, so many times as fine")
        ->needs("--snapshot")
        ->check(aquarama::cli::wholeNumber(1, aquarama::cli::kMostScale));
    CLI::Option* film = app.add_option(
        "--film", options.filmPipe, "socket of aquarama-compose clip, for every frame");
    app.add_option("--film-every", options.filmEvery, "with --film: for every so many frames")
        ->needs(film)
        ->check(aquarama::cli::wholeNumber(1, 10000));
    app.add_option("--trace", options.traceFolder, "folder for NAME.csv, a line of times a frame");
    CLI::Option* skin =
        app.add_option("--skin", paint.species, "write the colours of this species' skin, and end")
            ->excludes(name)
            ->excludes("--key");
    app.add_option("--colours", paint.out, "with --skin: the file")->needs(skin);
    skin->needs("--colours");
    app.footer(kFooter);
}

// Channel, master and keys of a key file; without one the command line has named both.
void readKey(const std::string& path, aquarama::show::NodeOptions& options) {
    using namespace aquarama;
    if (path.empty()) {
        if (options.channel.empty()) throw CLI::RequiredError("NAME or --key");
        if (options.masterAddresses.empty()) throw CLI::RequiredError("--master or --key");
        return;
    }
    const config::KeyFile key = config::readOwnKey(path);
    if (key.role != config::KeyRole::Node)
        throw Error(path + ": is the key of a " + std::string(config::nameOf(key.role)) +
                    "; a node needs that of its channel (aquarama keys bundle)");
    options.channel = key.name;
    options.masterAddresses.insert(options.masterAddresses.begin(), key.masterAddress);
    options.keys = net::PeerKeys{key.masterKey, {key.publicKey, key.secretKey}};
}

// Mesa maps its cache of shaders into memory: where the disk of it is full, the system ends the
// node (SIGBUS). Before any thread is made.
void spareFullDisk() {
    using namespace aquarama;
    constexpr std::uint64_t kLeastBytes = std::uint64_t{16} << 20U;
    if (freeBytesAt(cacheFolder()) >= kLeastBytes) return;
    for (const char* variable : {"MESA_SHADER_CACHE_DISABLE", "MESA_GLSL_CACHE_DISABLE"})
        setenv(variable, "true", 0);  // NOLINT(concurrency-mt-unsafe)
    logWarning("{}: less than 16 MB are free; make room there (shaders are compiled at each start)",
               cacheFolder().string());
}

// As numbers of 32 bits: red, green, blue, opacity of each corner of the triangles of the finest
// surface. The last corner says to which part a triangle belongs.
int writeColours(const PaintOptions& paint) {
    using namespace aquarama;
    const config::Species species = config::readSpecies(paint.species);
    const body::FishBody body = body::makeBody(species);
    const skin::LimitTable table = skin::makeLimitTable(body, skin::kSurfaceLevels - 1);
    std::vector<skin::SkinPlace> places;
    for (std::size_t i = 0; i < table.indices.size(); ++i) {
        places.push_back(table.vertices[table.indices[i]]);
        places.back().part = table.vertices[table.indices[i - i % 3 + 2]].part;
    }
    const auto context = gl::makeOffscreenContext("auto", {16, 16});
    const std::vector<glm::vec4> colours = surface::skinColours(body::skinOf(species), places);
    writeWhole(paint.out, std::as_bytes(std::span(colours)));
    return 0;
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): outside runProgram() only a lack of memory throws
int main(int count, char** arguments) {
    using namespace aquarama;
    show::NodeOptions options;
    CLI::App app("Shows one channel of a wall, in step with all others.", "aquarama-node");
    KeyOptions key;
    PaintOptions paint;
    describe(app, options, key, paint);
    return cli::runProgram(app, count, arguments, [&] {
        options.connector = machine::connectorName(options.connector);
        if (!paint.species.empty()) {
            spareFullDisk();
            return writeColours(paint);
        }
        if (key.isAwaited && !std::filesystem::exists(key.path) &&
            !show::waitForKey(key.path, options.headless, options.connector))
            return 0;
        readKey(key.path, options);
        app.name(app.get_name() + " " + options.channel);
        cli::requireFolder("--snapshot", options.snapshotFolder);
        cli::requireFolder("--trace", options.traceFolder);
        spdlog::set_default_logger(spdlog::stdout_color_mt("node " + options.channel));
        spareFullDisk();
        options.build = cli::buildText();
        return show::runNode(options) ? cli::kStartAgain : 0;
    });
}
