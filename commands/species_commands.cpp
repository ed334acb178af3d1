// SPDX-License-Identifier: Apache-2.0
// `aquarama gaits`, `search` and `controllers`: measure how species swim.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "capture/gait_trial.h"
#include "capture/repertoire_files.h"
#include "capture/report/report_data.h"
#include "capture/search.h"
#include "capture/start_figures.h"
#include "commands/commands.h"
#include "commands/work_parts.h"
#include "common/base/byte_stream.h"
#include "common/base/digest.h"
#include "common/base/files.h"
#include "common/cli/outputs.h"
#include "common/cli/progress.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

struct GaitsOptions {
    std::vector<std::string> species;  // names or files; none: all
    std::string config;
};

// Prints a line as soon as its species is measured.
void printGaits(const GaitsOptions& options) {
    const fs::path config = configFolder(options.config);
    const auto files = capture::speciesFiles(options.species, config);
    std::cout << capture::gaitTableHead();
    for (const auto& file : files)
        std::cout << capture::gaitTableRows(config::readSpecies(file.string())) << std::flush;
    std::cout << '\n' << capture::turnTableHead();
    for (const auto& file : files)
        std::cout << capture::turnTableRow(config::readSpecies(file.string())) << std::flush;
    std::cout << '\n' << capture::startTableHead();
    for (const auto& file : files)
        std::cout << capture::startTableRows(config::readSpecies(file.string())) << std::flush;
}

// Options of `search`. The journals lie beside `out`. `trials` are of each start.
struct SearchOptions {
    std::string species;
    std::string out;
    std::string config;
    std::size_t trials = 1000;
    std::uint32_t starts = 1;
    std::optional<parts::Part> part;
};

// The bytes of the whole file; empty where it cannot be read.
std::string speciesText(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// The best trial so far, for the progress bar.
std::string told(std::size_t trials, const capture::SearchTrial& best) {
    std::ostringstream note;
    note << std::fixed << std::setprecision(2) << "trial " << trials << ", Strouhal "
         << best.leastStrouhal << "-" << best.mostStrouhal << ", stride " << best.leastStride << "-"
         << best.mostStride << ", miss " << best.miss;
    return note.str();
}

// The text of a species file, and the species in it.
struct SearchedSpecies {
    std::string text;
    config::Species species;
};
SearchedSpecies readSearched(const SearchOptions& options) {
    const fs::path file =
        capture::speciesFiles({options.species}, configFolder(options.config)).front();
    const std::string text = speciesText(file);
    return {text, config::parseSpecies(text, file.string())};
}

// FILE.journal; of a later start FILE.2.journal.
std::string journalOf(const SearchOptions& options, std::uint32_t start) {
    return options.out + (start == 1 ? "" : '.' + std::to_string(start)) + ".journal";
}

// The best trial of one start. Continues where its journal ends.
capture::SearchTrial searchFrom(std::uint32_t start,
                                const SearchedSpecies& searched,
                                const SearchOptions& options) {
    capture::SearchJournal journal(journalOf(options, start), capture::searchName(searched.text));
    const std::string which = options.starts == 1 ? "" : " from start " + std::to_string(start);
    cli::Progress bar("searching " + searched.species.name + which);
    const capture::SearchTrial best = capture::searchGaits(
        capture::beginningOf(start, searched.species),
        options.trials,
        journal,
        [&](std::size_t trials, const capture::SearchTrial& soFar) {
            bar.show(static_cast<double>(trials) / static_cast<double>(options.trials),
                     told(trials, soFar));
        });
    bar.show(1, told(journal.trials().size(), best));
    return best;
}

// Of the best trials of all starts takes the one that misses least, the first of equal ones. Then
// chooses the strength of turns, and writes the species' text with the results.
void writeFound(const std::string& text,
                std::span<const capture::SearchTrial> trials,
                const std::string& out) {
    const capture::SearchTrial& best =
        *std::ranges::min_element(trials, {}, &capture::SearchTrial::miss);
    config::Species swimmer =
        capture::speciesAt(best.point, config::parseSpecies(text, "the species' file"));
    swimmer.turn = capture::withFittingStrengths(swimmer);
    const std::string found = capture::withGaitsOf(swimmer, text);
    writeWhole(out, std::as_bytes(std::span(found)));
    std::cout << out << "\n\n"
              << capture::gaitTableHead()
              << capture::gaitTableRows(config::parseSpecies(found, out));
}

// Files and options from which the trials follow.
Digest inputsOf(const std::string& text, const SearchOptions& options) {
    return digestOf(
        fmt::format("{} {} {}", capture::searchName(text), options.trials, options.starts));
}

// A part holds the best trial of each of its starts, behind the species' text.
std::vector<std::byte> contentOf(const std::string& text,
                                 std::span<const capture::SearchTrial> trials) {
    ByteWriter writer;
    writer.unsignedNumber(static_cast<std::uint32_t>(text.size()));
    writer.characters(text);
    for (const capture::SearchTrial& trial : trials) {
        writer.unsignedNumber(bitsOf(trial.miss));
        writer.numbers(std::span(trial.point));
    }
    return std::move(writer).take();
}

// Adds the trials of a part, which judge themselves by their miss alone; returns the species' text.
std::string readContent(const parts::FinishedPart& part,
                        std::vector<capture::SearchTrial>& trials) {
    ByteReader reader(part.content);
    std::string text = reader.characters(reader.unsignedNumber<std::uint32_t>());
    requireWhole(reader.ok(), part);
    const std::size_t coordinates = capture::pointOf(config::parseSpecies(text, "part")).size();
    while (reader.ok() && reader.remaining() > 0) {
        capture::SearchTrial& trial = trials.emplace_back();
        trial.miss = std::bit_cast<double>(reader.unsignedNumber<std::uint64_t>());
        trial.point.resize(coordinates);
        reader.numbers(std::span(trial.point));
    }
    requireWhole(reader.ok(), part);
    return text;
}

void searchGaitsOf(const SearchOptions& options) {
    cli::requireFile("--out",
                     options.part ? parts::partPath(options.out, *options.part) : options.out);
    const SearchedSpecies searched = readSearched(options);
    const auto [first, last] = parts::unitsOf(options.part.value_or(parts::Part{}), options.starts);
    std::vector<capture::SearchTrial> trials;
    for (std::size_t i = first; i < last; ++i)
        trials.push_back(searchFrom(static_cast<std::uint32_t>(i + 1), searched, options));
    if (options.part)
        writePart(options.out,
                  *options.part,
                  parts::WorkKind::Search,
                  inputsOf(searched.text, options),
                  contentOf(searched.text, trials));
    else
        writeFound(searched.text, trials, options.out);
}

struct ControllersOptions {
    std::string species = "bigeye_scad";
    std::string out;
    std::string config;
};

// Measures each controller and has Python draw the sheet.
void drawControllers(const ControllersOptions& options) {
    cli::requireFolder("--out", options.out);
    cli::requirePython({"matplotlib"});
    const fs::path config = configFolder(options.config);
    const fs::path file = capture::speciesFiles({options.species}, config).front();
    const fs::path data = report::writeControllers(config::readSpecies(file.string()), options.out);
    cli::runPython(
        {"matplotlib"}, "capture/report/draw_controllers.py", {data.string()}, options.out);
}

}  // namespace

void mergeSearch(const std::string& out, const WorkInParts& work) {
    cli::requireFile("OUT", out);
    std::string text;
    std::vector<capture::SearchTrial> trials;
    for (const parts::FinishedPart& part : work) text = readContent(part, trials);
    requireWhole(!trials.empty(), work.back());
    writeFound(text, trials, out);
}

void addGaits(CommandLine& line) {
    const auto [command, options] = line.add<GaitsOptions>(
        "gaits", "how species swim, turn and start, as tables in Markdown", printGaits);
    command.add_option("SPECIES", options.species, "names or files; all when none is given");
    describeConfig(command, options.config);
}

void addSearch(CommandLine& line) {
    const auto [command, options] = line.add<SearchOptions>(
        "search", "find gait parameters with which a species swims", searchGaitsOf);
    command.add_option("SPECIES", options.species, "a name in the config folder, or a file")
        ->required();
    command
        .add_option(
            "--out",
            options.out,
            "the species file to write; beside it FILE.journal, with which the same command "
            "goes on where it was interrupted")
        ->required();
    command.add_option("--trials", options.trials, "the most to make from each start")
        ->check(cli::wholeNumber(1, 1'000'000))
        ->capture_default_str();
    command
        .add_option("--starts",
                    options.starts,
                    "searches from so many points, the first at the species as it is")
        ->check(cli::wholeNumber(1, 1000))
        ->capture_default_str();
    describePart(command, options.part);
    describeConfig(command, options.config);
}

void addControllers(CommandLine& line) {
    const auto [command, options] = line.add<ControllersOptions>(
        "controllers",
        "draw the biomechanical fish under each of its motor controllers",
        drawControllers);
    command
        .add_option(
            "--species", options.species, "name of a species in the config folder, or a file")
        ->capture_default_str();
    command.add_option("--out", options.out, "folder for controllers.svg and its data")->required();
    describeConfig(command, options.config);
}

}  // namespace aquarama
