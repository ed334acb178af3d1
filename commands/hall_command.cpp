// SPDX-License-Identifier: Apache-2.0
// `aquarama hall`: a hall leaves a machine as one file, and arrives on another one.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

#include "commands/commands.h"
#include "commands/hall_archive.h"
#include "commands/hall_files.h"
#include "common/base/counted.h"
#include "common/base/files.h"
#include "common/cli/outputs.h"
#include "common/cli/passphrase.h"
#include "common/config/hours.h"

namespace aquarama {

namespace {

// Options of both commands, each of which uses some.
struct HallOptions {
    std::string rig, file, folder;
    std::string passphraseFile;  // "-": standard input; empty: asked at the terminal
    bool drawings = false;
};

// "8 keys, hours, 3 drawings"; empty without secrets.
std::string listOf(const TravellingHall& hall) {
    const auto count = [&](std::string_view prefix, std::string_view ending) {
        return static_cast<std::uint64_t>(
            std::ranges::count_if(hall.secrets, [&](const formats::ArchiveFile& one) {
                return one.first.starts_with(prefix) && one.first.ends_with(ending);
            }));
    };
    std::vector<std::string> parts;
    if (const auto keys = count(kKeysOfHall, ".key")) parts.push_back(counted(keys, "key"));
    if (count(config::kHoursFile, "") > 0) parts.emplace_back("hours");
    if (const auto drawings = count(kDrawingsOfHall, ".png"))
        parts.push_back(counted(drawings, "drawing"));
    return fmt::format("{}", fmt::join(parts, ", "));
}

void exportHall(const HallOptions& options) {
    cli::requireFile("FILE", options.file);
    const TravellingHall hall = readHall(options.rig, options.drawings);
    const auto ask = [&] {
        return cli::readPassphrase(options.passphraseFile, cli::PassphraseUse::New);
    };
    writeWhole(options.file, encodeHall(hall, ask));
    const std::string secrets = listOf(hall);
    cli::say(fmt::format("{}: {} with {}{}",
                         options.file,
                         hall.rig,
                         counted(hall.files.size() - 1, "file"),
                         secrets.empty() ? "; no keys, no hours" : "; sealed: " + secrets));
}

void importHall(const HallOptions& options) {
    const auto ask = [&] {
        return cli::readPassphrase(options.passphraseFile, cli::PassphraseUse::Known);
    };
    const TravellingHall hall =
        decodeHall(readWhole(options.file, kMostHallBytes), options.file, ask);
    const std::string rig = placeHall(hall, options.folder, options.file).string();
    const std::string secrets = listOf(hall);
    cli::say(fmt::format("{}: with {}{}",
                         rig,
                         counted(hall.files.size() - 1, "file"),
                         secrets.empty() ? "; no keys, no hours" : "; " + secrets));
    cli::say("next: aquarama doctor " + rig);
}

void describePassphrase(CLI::App& command, HallOptions& options) {
    command.add_option("--passphrase",
                       options.passphraseFile,
                       "file whose first line is the passphrase, - for standard input; asked at "
                       "the terminal when left out");
}

}  // namespace

void addHall(CommandLine& line) {
    struct Nothing {};
    const auto hall = line.add<Nothing>(
        "hall", "carry a hall from one machine to another as one file", [](const Nothing&) {
            throw CLI::RequiredError("hall: export or import");
        });
    const auto out =
        line.addTo<HallOptions>(hall.app,
                                "export",
                                "write a rig, what it names, its hours and keys into one file",
                                exportHall);
    out.app.add_option("RIG", out.options.rig, "the rig of the hall")->required();
    out.app.add_option("FILE", out.options.file, "the file to be written")->required();
    out.app.add_flag("--drawings", out.options.drawings, "with visitors' drawings");
    describePassphrase(out.app, out.options);
    const auto in = line.addTo<HallOptions>(
        hall.app, "import", "put such a hall into a folder of this machine", importHall);
    in.app.add_option("FILE", in.options.file, "a file that export has written")->required();
    in.app.add_option("FOLDER", in.options.folder, "an empty or a new folder")->required();
    describePassphrase(in.app, in.options);
}

}  // namespace aquarama
