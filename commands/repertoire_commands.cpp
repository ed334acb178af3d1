// SPDX-License-Identifier: Apache-2.0
// `aquarama capture`, `forms` and `export`: make repertoires, measure them, and convert them for
// other programs.
#include <algorithm>
#include <atomic>
#include <cassert>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "capture/repertoire_files.h"
#include "capture/report/forms.h"
#include "capture/report/gltf.h"
#include "capture/report/report_data.h"
#include "capture/report/take.h"
#include "commands/commands.h"
#include "commands/work_parts.h"
#include "common/base/byte_stream.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/cli/command_line.h"
#include "common/cli/outputs.h"
#include "common/cli/progress.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// Options of `capture`. Empty folders: no report is written, and the config folder is searched for.
struct CaptureOptions {
    std::vector<std::string> species;  // names or files; none: all
    std::string out;
    std::string report;
    std::string config;
    std::optional<parts::Part> part;
};

// Reads repertoires from the cache or captures them, with a progress bar; Ctrl-C ends it.
std::vector<capture::RepertoireFile> captured(const std::vector<config::Species>& species) {
    std::atomic<bool> isStopped = false;
    const cli::SignalWatch watch([&] { isStopped = true; });
    cli::Progress bar("capturing");
    return capture::repertoiresFor(species,
                                   capture::repertoireFolders(),
                                   {.progress = [&](double share) { bar.show(share); },
                                    .isStopped = [&] { return isStopped.load(); }});
}

// Writes SPECIES.aqrep and prints its path, which it returns.
fs::path writeRepertoire(const capture::RepertoireFile& file, const std::string& folder) {
    const fs::path path = fs::path(folder) / (file.species + ".aqrep");
    writeWhole(path, file.bytes);
    std::cout << path.string() << '\n';
    return path;
}

// Writes the repertoire and, where a report is requested, its data; returns the path of the data.
fs::path write(const capture::RepertoireFile& file, const CaptureOptions& options) {
    const fs::path path = writeRepertoire(file, options.out);
    if (options.report.empty()) return {};
    const motion::Repertoire repertoire = motion::decodeRepertoire(file.bytes, path.string());
    return report::writeReport(repertoire, options.report);
}

// The repertoires of some species, in their order. For each that has none `fail` is called with the
// reason, for a file that is no species before the others are captured.
std::vector<capture::RepertoireFile> captureFiles(
    std::span<const fs::path> files, const std::function<void(const std::string& why)>& fail) {
    std::vector<config::Species> species;
    for (const fs::path& file : files) {
        try {
            species.push_back(config::readSpecies(file.string()));
        } catch (const Error& error) {
            fail(error.what());
        }
    }
    std::vector<capture::RepertoireFile> repertoires = captured(species);
    for (const capture::RepertoireFile& file : repertoires)
        if (!file.error.empty()) fail(file.error);
    std::erase_if(repertoires,
                  [](const capture::RepertoireFile& file) { return !file.error.empty(); });
    return repertoires;
}

// A part holds whole species: the name and the bytes of each.
std::vector<std::byte> contentOf(std::span<const capture::RepertoireFile> files) {
    ByteWriter writer;
    const auto put = [&](const auto& bytes) {
        writer.unsignedNumber(static_cast<std::uint32_t>(bytes.size()));
        writer.numbers(std::as_bytes(std::span(bytes)));
    };
    for (const capture::RepertoireFile& file : files) {
        put(file.species);
        put(file.bytes);
    }
    return std::move(writer).take();
}

// A name becomes a file of the folder, and must be no path.
std::vector<capture::RepertoireFile> repertoiresIn(const parts::FinishedPart& part) {
    ByteReader reader(part.content);
    std::vector<capture::RepertoireFile> files;
    while (reader.ok() && reader.remaining() > 0) {
        capture::RepertoireFile& file = files.emplace_back();
        file.species = reader.characters(reader.unsignedNumber<std::uint32_t>());
        const auto bytes = reader.unsignedNumber<std::uint32_t>();
        requireWhole(reader.ok() && bytes <= reader.remaining() &&
                         file.species.find('/') == std::string::npos,
                     part);
        file.bytes.resize(bytes);
        reader.numbers(std::span(file.bytes));
    }
    requireWhole(reader.ok(), part);
    return files;
}

// Of the texts of all species.
Digest inputsOf(std::span<const fs::path> files) {
    constexpr std::uintmax_t kMostText = 1U << 20U;
    ByteWriter digests;
    for (const fs::path& file : files)
        digests.characters(digestOf(readWhole(file, kMostText)).bytes);
    return digestOf(digests.written());
}

// Throws Error where a species fails or the capture is interrupted: such a part is not done.
void capturePart(const CaptureOptions& options, std::span<const fs::path> files) {
    cli::requireFile("--out", parts::partPath(options.out, *options.part));
    const auto [first, last] = parts::unitsOf(*options.part, files.size());
    const auto made = captureFiles(files.subspan(first, last - first),
                                   [](const std::string& why) { throw Error(why); });
    writePart(
        options.out, *options.part, parts::WorkKind::Capture, inputsOf(files), contentOf(made));
}

// Prints species that fail, and writes the others. Returns the exit status.
int captureAll(const CaptureOptions& options) {
    cli::holdSignals();
    const std::vector<fs::path> files =
        capture::speciesFiles(options.species, configFolder(options.config));
    if (options.part) {
        capturePart(options, files);
        return 0;
    }
    cli::requireFolder("--out", options.out);
    cli::requireFolder("--report", options.report);
    if (!options.report.empty()) cli::requirePython({"matplotlib"});
    int status = 0;
    const auto fail = [&](const std::string& why) {
        cli::sayError("aquarama capture", why);
        status = 1;
    };
    std::vector<std::string> reports;
    for (const capture::RepertoireFile& file : captureFiles(files, fail))
        reports.push_back(write(file, options));
    if (!options.report.empty() && !reports.empty())
        cli::runPython({"matplotlib"}, "capture/report/draw_report.py", reports, options.report);
    return status;
}

// Options of `forms`.
struct FormsOptions {
    std::vector<std::string> species;  // names or files; none: all
    std::string out;
    std::string config;
};

// Measures the slow and the fast gait of each species and has Python draw the sheet and print the
// table.
void drawForms(const FormsOptions& options) {
    cli::holdSignals();
    cli::requireFolder("--out", options.out);
    cli::requirePython({"matplotlib"});
    std::vector<config::Species> species;
    for (const fs::path& file :
         capture::speciesFiles(options.species, configFolder(options.config)))
        species.push_back(config::readSpecies(file.string()));
    std::vector<motion::Repertoire> repertoires;
    for (const capture::RepertoireFile& file : captured(species)) {
        if (!file.error.empty()) throw Error(file.error);
        repertoires.push_back(motion::decodeRepertoire(file.bytes, file.species));
    }
    const fs::path path = fs::path(options.out) / "forms.json";
    const std::string data = report::formsData(repertoires);
    writeWhole(path, std::as_bytes(std::span(data)));
    cli::runPython({"matplotlib"}, "capture/report/draw_forms.py", {path.string()}, options.out);
}

// Options of `export`. `cycles`: how often the segment is repeated.
struct ExportOptions {
    std::string file;
    std::string segment;
    int cycles = 1;
    std::string c3d, gltf, csv;  // output files; exactly one is given
    std::string config;
};

// In the order of motion::Action, of which only the captured ones are in a repertoire.
std::vector<std::string> segmentNames() {
    std::vector<std::string> names;
    names.reserve(motion::kCapturedActions);
    for (int i = 0; i < motion::kCapturedActions; ++i)
        names.emplace_back(motion::nameOf(static_cast<motion::Action>(i)));
    return names;
}

// The segment with a name from segmentNames().
motion::Action actionNamed(const std::string& segment) {
    const std::vector<std::string> names = segmentNames();
    const auto found = std::ranges::find(names, segment);
    assert(found != names.end());
    return static_cast<motion::Action>(found - names.begin());
}

// The format by the suffix. Throws Error where it is neither .glb nor .gltf.
report::GltfContainer containerOf(const fs::path& path) {
    if (path.extension() == ".glb") return report::GltfContainer::Binary;
    if (path.extension() == ".gltf") return report::GltfContainer::Text;
    throw Error(path.string() + ": name it .glb (binary) or .gltf (text)");
}

// The body with its skin, which is not in the repertoire but in the species' file.
body::FishBody bodyOf(const motion::Repertoire& repertoire, const ExportOptions& options) {
    const fs::path config = configFolder(options.config);
    return body::makeBody(
        config::readSpecies(capture::speciesFiles({repertoire.species}, config).front().string()));
}

// Writes the requested file.
void exportSegment(const ExportOptions& options) {
    cli::requireFile("--c3d", options.c3d);
    cli::requireFile("--gltf", options.gltf);
    cli::requireFile("--csv", options.csv);
    const motion::Action action = actionNamed(options.segment);
    const motion::Repertoire repertoire =
        motion::decodeRepertoire(capture::readRepertoireFile(options.file), options.file);
    if (!options.gltf.empty()) {
        const report::GltfContainer container = containerOf(options.gltf);
        const body::FishBody body = bodyOf(repertoire, options);
        writeWhole(options.gltf,
                   report::gltfOf(repertoire, body, action, options.cycles, container));
        return;
    }
    const report::Take take = report::takeAtTicks(repertoire, action, options.cycles);
    if (options.csv.empty()) {
        writeWhole(options.c3d, report::c3dOf(take));
    } else {
        const std::string rows = report::csvOf(take);
        writeWhole(options.csv, std::as_bytes(std::span(rows)));
    }
}

}  // namespace

void mergeCapture(const std::string& out, const WorkInParts& work) {
    cli::requireFolder("OUT", out);
    for (const parts::FinishedPart& part : work)
        for (const capture::RepertoireFile& file : repertoiresIn(part))
            (void)writeRepertoire(file, out);
}

void describeConfig(CLI::App& command, std::string& folder) {
    command.add_option("--config", folder, "folder that holds scenes and species");
}

// An empty name: the folder is searched for.
fs::path configFolder(const std::string& given) {
    return given.empty() ? capture::findConfigFolder() : fs::path(given);
}

void addCapture(CommandLine& line) {
    const auto [command, options] = line.add<CaptureOptions>(
        "capture",
        "simulate the biomechanical fish and compile repertoires: --out DIR",
        captureAll);
    command.add_option("--species",
                       options.species,
                       "name of a species in the config folder, or a file; all when not given");
    command.add_option("--out", options.out, "folder for SPECIES.aqrep")->required();
    CLI::Option* report = command.add_option(
        "--report", options.report, "folder for a page with pictures and figures");
    describePart(command, options.part);
    command.get_option("--part")->excludes(report);
    describeConfig(command, options.config);
}

void addForms(CommandLine& line) {
    const auto [command, options] = line.add<FormsOptions>(
        "forms", "draw and tabulate the forms of swimming of captured species", drawForms);
    command.add_option("--species",
                       options.species,
                       "name of a species in the config folder, or a file; all when not given");
    command.add_option("--out", options.out, "folder for forms.svg and its data")->required();
    describeConfig(command, options.config);
}

void addExport(CommandLine& line) {
    const auto [command, options] = line.add<ExportOptions>(
        "export",
        "a segment as C3D, glTF or CSV: aquarama export FILE --segment NAME --c3d OUT",
        exportSegment);
    command.footer("Metres, Y up; the fish swims from the origin along +x.");
    command.add_option("FILE", options.file, "a repertoire")->required();
    command.add_option("--segment", options.segment, "which")
        ->required()
        ->check(CLI::IsMember(segmentNames()));
    command.add_option("--cycles", options.cycles, "how often it is repeated")
        ->check(cli::wholeNumber(1, report::kMostCycles))
        ->capture_default_str();
    CLI::Option_group& out = *command.add_option_group("format", "one of");
    out.add_option("--c3d", options.c3d, "nodal points as markers, 60 frames a second");
    out.add_option("--csv", options.csv, "nodal points as a table, 60 rows a second");
    out.add_option("--gltf", options.gltf, "the skin, swimming: a .glb or .gltf file");
    out.require_option(1);
    describeConfig(command, options.config);
}

}  // namespace aquarama
