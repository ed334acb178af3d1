// SPDX-License-Identifier: Apache-2.0
// aquarama-guests: lets visitors with phones steer the submarine of a running show, feed its fish,
// and send drawings that swim.
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <CLI/CLI.hpp>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include "common/ask/drawing_reader.h"
#include "common/ask/request_client.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/random_bytes.h"
#include "common/cli/command_line.h"
#include "common/config/host.h"
#include "common/config/keys.h"
#include "common/config/rig.h"
#include "common/machine/service_notifier.h"
#include "common/web/server.h"
#include "guests/guests.h"
#include "guests/wall_link.h"

namespace {

using namespace aquarama;

// What the command line says.
struct Options {
    std::string rig, keys, key;
};

void describe(CLI::App& app, Options& options) {
    app.add_option("RIG", options.rig, "whose show visitors take part in")->required();
    app.add_option("--keys", options.keys, "folder of the master's keys, where the rig needs them");
    app.add_option("--key", options.key, "file of the guests' key; else that of the folder");
    app.footer(
        "The rig's guests say at which address phones reach it. The wall never waits for them; it "
        "may be ended and\nstarted again at any time: visitors keep their places.");
}

// Empty where the rig needs none.
std::string keyOf(const Options& options, const config::Rig& rig) {
    if (!config::needsKeys(rig)) return {};
    if (!options.key.empty()) return options.key;
    const auto folder = config::keyFolderOf(options.rig, options.keys);
    return config::keyFileIn(folder, config::nameOf(config::KeyRole::Guests)).string();
}

double secondsNow() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// In a folder that is gone with the power.
std::filesystem::path seatFileOf(const std::string& rig) {
    return userFolder("XDG_RUNTIME_DIR", ".cache") / "guests" / std::filesystem::path(rig).stem();
}

// Of the place where nodes bring pictures: the guests' own pair, as strangers speak to this program
// and it must know no other's. Only the master tells its nodes the public one, so who knows that is
// one of them.
std::optional<net::MasterKeys> pictureKeysOf(const std::string& keyFile) {
    if (keyFile.empty()) return std::nullopt;
    const config::KeyFile own = config::readKeyFile(keyFile);
    return net::MasterKeys{{own.publicKey, own.secretKey}, {}};
}

// Null where nodes bring no pictures.
std::unique_ptr<guests::WallPicture> pictureOf(const Options& options, const config::Rig& rig) {
    if (rig.guests->picturesAddress.empty()) return nullptr;
    return std::make_unique<guests::WallPicture>(rig, pictureKeysOf(keyOf(options, rig)));
}

// Has the server's thread do something soon; set before anything else runs.
using Post = std::function<void(std::function<void()>)>;

// Null where the rig has no drawings.
std::unique_ptr<ask::DrawingReader> readerOf(const config::Rig& rig) {
    return rig.drawings ? std::make_unique<ask::DrawingReader>() : nullptr;
}

// Nothing is drawn without a decoder. All outlive it.
guests::DrawingPlace placeOf(const config::Rig& rig, ask::DrawingReader* reader, Post& post) {
    if (reader == nullptr || !reader->isInstalled()) return {};
    const auto read = [reader, &post](std::string picture, const auto& done) {
        return reader->read(std::move(picture), [&post, done](const ask::DrawingOutcome& outcome) {
            post([done, outcome] { done(outcome); });
        });
    };
    return {.species = rig.drawings->species, .read = read};
}

guests::WallListener listenerOf(guests::GuestService& visitors, Post& post) {
    return {.heard =
                [&](const std::optional<guests::WallState>& wall) {
                    post([&visitors, wall] { visitors.heard(wall); });
                },
            .offered =
                [&](std::uint64_t request, std::uint32_t number) {
                    post([&visitors, request, number] { visitors.offered(request, number); });
                },
            .does =
                [&](std::uint32_t fish, const guests::FishDeed& deed) {
                    post([&visitors, fish, deed] { visitors.does(fish, deed); });
                }};
}

// Until a signal.
void serve(const Options& options, const config::Rig& rig) {
    cli::holdSignals();
    constexpr int kNice = 5;  // the wall goes before
    setpriority(PRIO_PROCESS, 0, kNice);
    machine::ServiceNotifier service;
    guests::WallLink link({.rig = options.rig, .address = {}, .key = keyOf(options, rig)});
    Post post;
    std::unique_ptr<ask::DrawingReader> reader = readerOf(rig);
    const std::unique_ptr<guests::WallPicture> picture = pictureOf(options, rig);
    guests::GuestService visitors({.place = *rig.guests,
                                   .key = randomBytes<std::tuple_size_v<guests::DoorTokens::Key>>(),
                                   .seatFile = seatFileOf(options.rig),
                                   .drawings = placeOf(rig, reader.get(), post),
                                   .picture = picture.get()},
                                  link,
                                  secondsNow);
    constexpr std::size_t kBesidePhones = 100;  // connections that only fetch the page
    web::WebServer server({.address = rig.guests->host,
                           .port = rig.guests->port,
                           .certificateFile = {},
                           .keyFile = {},
                           .mostConnections = guests::GuestService::kMostPhones + kBesidePhones},
                          visitors);
    post = [&](std::function<void()> what) { server.post(std::move(what)); };
    logInfo("visitors at http://{}:{}", config::bracketed(rig.guests->host), rig.guests->port);
    link.begin(listenerOf(visitors, post));
    const cli::SignalWatch watch([&] { server.stop(); });
    service.ready();
    server.run();
    service.stopping();
    link.end();
    reader.reset();
}

void run(const Options& options) {
    const config::Rig rig = config::readRig(options.rig);
    if (!rig.guests)
        throw Error(options.rig +
                    ": lets no visitors take part; write guests { address: "
                    "\"http://192.168.20.1:7490\" } into it, with an address of this machine");
    serve(options, rig);
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): outside runProgram() only a lack of memory throws
int main(int count, char** arguments) {
    Options options;
    CLI::App app("Lets visitors with phones take part in a show.", "aquarama-guests");
    describe(app, options);
    return cli::runProgram(app, count, arguments, [&] {
        spdlog::set_default_logger(spdlog::stdout_color_mt("guests"));
        run(options);
        return 0;
    });
}
