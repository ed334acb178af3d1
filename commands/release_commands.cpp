// SPDX-License-Identifier: Apache-2.0
// `aquarama release`: makes the key of a show, signs releases and checks them.
#include <cstdint>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

#include "commands/commands.h"
#include "common/base/counted.h"
#include "common/base/dates.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/cli/outputs.h"
#include "common/config/keys.h"
#include "releases/release.h"
#include "releases/signing.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostKeyBytes = 4096;

// Of `key new`, `sign` and `check`.
struct ReleaseFiles {
    std::string path;         // of the key that is made, or the folder of the release
    std::string key;          // its file
    std::uint64_t least = 0;  // serial
};

std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span(text));
}

// Throws Error where one of both files is there: a show that loses its key needs new images.
void makeReleaseKey(const ReleaseFiles& files) {
    const fs::path secret = files.path, open = files.path + ".pub";
    for (const fs::path& path : {secret, open})
        if (fs::exists(path))
            throw Error(path.string() + ": is there already; choose another name");
    const releases::SigningKeys keys = releases::makeSigningKeys();
    writePrivate(secret, bytesOf(keys.secretPem));
    writeWhole(open, bytesOf(keys.publicPem));
    cli::say(secret.string() + ": signs releases; keep it, and let nobody read it");
    cli::say(open.string() + ": machines check releases with it");
}

// The serial is the second of signing. Throws Error where the clock is wrong: no later release
// would count as newer.
void signOneRelease(const ReleaseFiles& files) {
    if (const std::string doubt = clockDoubt(systemSeconds(), static_cast<double>(builtAt()));
        !doubt.empty())
        throw Error(doubt + ": nothing is signed now; " + kSetTheClock);
    config::requirePrivate(files.key);
    const auto secret = readWhole(files.key, kMostKeyBytes);
    const releases::ReleaseContent release =
        releases::signRelease(files.path,
                              static_cast<std::uint64_t>(systemSeconds()),
                              {reinterpret_cast<const char*>(secret.data()), secret.size()},
                              files.key);
    cli::say(fmt::format("release {} is signed: serial {}, {}",
                         release.id.version,
                         release.id.serial,
                         counted(release.files.size(), "file")));
}

void checkOneRelease(const ReleaseFiles& files) {
    const releases::ReleaseContent release =
        releases::checkRelease(files.path, releases::readShowKey(files.key));
    releases::requireSerial(release, files.least);
    cli::say(fmt::format("release {} is as it was signed: serial {}, {}",
                         release.id.version,
                         release.id.serial,
                         counted(release.files.size(), "file")));
}

void addReleaseKey(CommandLine& line, CLI::App& release) {
    struct Nothing {};
    const auto key =
        line.addTo<Nothing>(release, "key", "the key that signs releases", [](const Nothing&) {
            throw CLI::RequiredError("key: new");
        });
    const auto made = line.addTo<ReleaseFiles>(
        key.app, "new", "make one, and FILE.pub, by which releases are checked", makeReleaseKey);
    made.app.add_option("FILE", made.options.path, "where it is written")->required();
}

// Adds FOLDER and --key to commands about one release.
template <class Run>
AddedCommand<ReleaseFiles> addOneRelease(CommandLine& line,
                                         CLI::App& parent,
                                         const std::string& name,
                                         const std::string& what,
                                         const std::string& key,
                                         Run run) {
    const auto added = line.addTo<ReleaseFiles>(parent, name, what, run);
    added.app.add_option("FOLDER", added.options.path, "the release; its name is the version")
        ->required();
    added.app.add_option("--key", added.options.key, key)->required();
    return added;
}

}  // namespace

void addRelease(CommandLine& line) {
    struct Nothing {};
    const auto release = line.add<Nothing>(
        "release", "sign releases, and bring them to all machines together", [](const Nothing&) {
            throw CLI::RequiredError(
                "release: key, sign, check, serve, follow, stage, go, back or status");
        });
    addReleaseKey(line, release.app);
    addOneRelease(
        line, release.app, "sign", "sign a release", "the show's secret key", signOneRelease);
    const auto check = addOneRelease(line,
                                     release.app,
                                     "check",
                                     "see that a release is as it was signed",
                                     "the show's public key",
                                     checkOneRelease);
    check.app.add_option("--at-least", check.options.least, "refuse one with a lower serial");
    addDepotCommands(line, release.app);
}

}  // namespace aquarama
