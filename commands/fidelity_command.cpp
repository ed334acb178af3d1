// SPDX-License-Identifier: Apache-2.0
// `aquarama fidelity`: how closely replicas follow the fish that they stand for, in tables or in a
// film.
#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "capture/film/film.h"
#include "capture/film/film_script.h"
#include "capture/repertoire_files.h"
#include "capture/report/fidelity.h"
#include "commands/commands.h"
#include "common/base/counted.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/movement_versions.h"
#include "common/base/worker_pool.h"
#include "common/cli/outputs.h"
#include "common/cli/progress.h"
#include "common/net/channels.h"
#include "common/skin/limit_table.h"
#include "master/supervisor/children.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

struct FidelityOptions {
    std::vector<std::string> species;  // names or files; none: all, in a film the scad
    std::string out;                   // empty: a film is made
    std::string clip;                  // its file
    std::string config;
    std::uint64_t seed = 1;         // of the script of commands
    std::optional<double> seconds;  // its length; none: kSeconds, or the whole film
};
constexpr double kSeconds = 60;

// Prints the file's name on stderr: stdout is for the tables.
void writeText(const fs::path& path, const std::string& text) {
    writeWhole(path, std::as_bytes(std::span(text.data(), text.size())));
    std::cerr << path.string() << '\n';
}

// Gives the fish and its replica the same script, for each species; Python draws the results.
void compareAll(const FidelityOptions& options) {
    cli::requireFolder("--out", options.out);
    const double seconds = options.seconds.value_or(kSeconds);
    cli::requirePython({"matplotlib"});
    const fs::path config = configFolder(options.config);
    std::vector<report::Fidelity> fidelities;
    std::vector<report::SpeciesVocabularies> vocabularies;
    for (const fs::path& file : capture::speciesFiles(options.species, config)) {
        const config::Species species = config::readSpecies(file.string());
        cli::Progress bar("comparing " + species.name);
        const motion::Repertoire repertoire =
            capture::captureRepertoire(species, [&](double share) { bar.show(0.5 * share); });
        fidelities.push_back(report::measureFidelity(species, repertoire, options.seed, seconds));
        bar.show(0.6);
        vocabularies.push_back(
            {species.name,
             report::compareVocabularies(species, repertoire, options.seed, seconds)});
        bar.show(1);
    }
    const fs::path out = options.out;
    writeText(out / "fidelity.csv", report::commandsCsv(fidelities));
    writeText(out / "fidelity_summaries.csv", report::summariesCsv(fidelities));
    writeText(out / "fidelity_ticks.csv", report::ticksCsv(fidelities));
    writeText(out / "fidelity_vocabularies.csv", report::vocabulariesCsv(vocabularies));
    cli::runPython({"matplotlib"},
                   "capture/report/draw_fidelity.py",
                   {options.out, std::to_string(options.seed)},
                   options.out);
    // The line by which docs/studies.py knows what moved the fish.
    std::cout << fmt::format("\nmotor {}\n", kMotorVersion);
}

// The film.

// Another of our programs. It says nothing but errors, which come through the pipe of errors.
class OtherProgram {
  public:
    OtherProgram(const std::string& program, const std::vector<std::string>& arguments)
        : name_(program),
          child_(supervisor::start({supervisor::siblingProgram(program), arguments})) {}
    // Looks whether it has ended, and waits at most so long. False where the user ends this
    // program.
    [[nodiscard]] bool look(std::chrono::milliseconds atMost) {
        const supervisor::Heard heard = supervisor::waitForChildren(atMost);
        for (const supervisor::Ending& ending : heard.endings)
            if (ending.child == child_) ending_ = ending;
        return !heard.interrupted;
    }
    [[nodiscard]] bool isRunning() const { return !ending_; }
    // Throws Error, which says what it said, where it has ended badly. Call it no more after that.
    void requireGood(const supervisor::ErrorPipe& errors) const {
        if (!ending_ || ending_->clean()) return;
        std::vector<std::string> said = errors.heard();
        if (said.empty())
            said.push_back("aquarama-" + name_ + ": has ended before its work was done");
        const std::size_t name = said.front().find(": ");  // the program's own, in front
        throw Error(name == std::string::npos ? said.front() : said.front().substr(name + 2));
    }

  private:
    std::string name_;
    pid_t child_;
    std::optional<supervisor::Ending> ending_;
};

// The exit status of a program that an interrupt has ended.
struct Interrupted {};
constexpr int kInterrupted = 130;

// The colours of a species' skin, as its node draws it; of each corner of the table's triangles.
std::vector<glm::vec4> skinColours(const fs::path& species,
                                   const skin::LimitTable& table,
                                   const fs::path& folder,
                                   const supervisor::ErrorPipe& errors) {
    const fs::path file = folder / "colours";
    OtherProgram node("node", {"--skin", species.string(), "--colours", file.string()});
    while (node.isRunning())
        if (!node.look(100ms)) throw Interrupted{};
    node.requireGood(errors);
    std::vector<glm::vec4> colours(table.indices.size());
    const std::vector<std::byte> bytes = readWhole(file, std::as_bytes(std::span(colours)).size());
    if (bytes.size() != std::as_bytes(std::span(colours)).size())
        throw Error("aquarama-node is of another version; install all programs together");
    std::memcpy(colours.data(), bytes.data(), bytes.size());
    return colours;
}

// From the cache, or captured.
motion::Repertoire repertoireOf(const config::Species& species) {
    cli::Progress bar("capturing");
    const capture::RepertoireFile file =
        capture::repertoiresFor({species},
                                capture::repertoireFolders(),
                                {.progress = [&](double share) { bar.show(share); }})
            .front();
    if (!file.error.empty()) throw Error(file.error);
    return motion::decodeRepertoire(file.bytes, species.name);
}

// Draws all pictures and sends them to the encoder, in their order. Throws Error where it has gone.
void shoot(const film::Film& film, const fs::path& pipe, OtherProgram& encoder) {
    const auto sender = net::connectFrames(pipe);
    WorkerPool workers(std::thread::hardware_concurrency());
    const std::size_t batch = 2 * std::max(std::thread::hardware_concurrency(), 1U);
    cli::Progress progress("film: picture", film.pictures());
    std::vector<Picture> drawn(batch);
    for (std::size_t first = 0; first < film.pictures(); first += batch) {
        const std::size_t count = std::min(batch, film.pictures() - first);
        workers.run(count, [&](std::size_t i) { drawn[i] = film.picture(first + i); });
        for (std::size_t i = 0; i < count; ++i) {
            if (!encoder.look(0ms)) throw Interrupted{};
            sender->send({film::kTicksAPicture * (first + i),
                          film::kFilmPixels.x,
                          film::kFilmPixels.y,
                          std::move(drawn[i].rgb)});
        }
        progress.count(first + count);
    }
    progress.end();
}

void makeFilm(const FidelityOptions& options) {
    cli::requireFile("--clip", options.clip);
    if (options.species.size() > 1) throw Error("--clip shows one species; name one");
    const std::vector<std::string> chosen =
        options.species.empty() ? std::vector<std::string>{"bigeye_scad"} : options.species;
    const fs::path file = capture::speciesFiles(chosen, configFolder(options.config)).front();
    const config::Species species = config::readSpecies(file.string());
    for (const char* program : {"node", "compose"}) (void)supervisor::siblingProgram(program);
    supervisor::listenForSignals();
    const supervisor::ErrorPipe errors;
    const TemporaryFolder folder("film");

    film::Film::Shown shown;
    shown.body = body::makeBody(species);
    shown.skin.table = skin::makeLimitTable(shown.body, skin::kSurfaceLevels - 1);
    shown.skin.colours = skinColours(file, shown.skin.table, folder.path(), errors);
    const motion::Repertoire repertoire = repertoireOf(species);
    shown.script = film::filmScript(repertoire, options.seconds.value_or(film::kWholeFilmSeconds));
    report::Traces traces = report::traceBoth(species, repertoire, shown.script);
    const std::string table = report::commandTable(report::compare(shown.script, traces));
    shown.fish = std::move(traces.fish);
    shown.replica = std::move(traces.looseReplica);
    const film::Film film(std::move(shown));

    const fs::path pipe = folder.path() / "pictures";
    OtherProgram encoder("compose",
                         {"encode",
                          options.clip,
                          "--pipe",
                          pipe.string(),
                          "--every",
                          std::to_string(film::kTicksAPicture)});
    try {
        shoot(film, pipe, encoder);
    } catch (const Error&) {  // the encoder has gone: what it said is the cause
        while (encoder.isRunning() && encoder.look(1s)) {
        }
        encoder.requireGood(errors);
        throw;
    }
    while (encoder.isRunning())
        if (!encoder.look(100ms)) throw Interrupted{};
    encoder.requireGood(errors);
    std::cout << table << '\n';
    cli::say(fmt::format("{}: {} and its replica, {}",
                         options.clip,
                         species.name,
                         counted(film.pictures(), "picture")));
}

int runFidelity(const FidelityOptions& options) {
    if (options.clip.empty() && options.out.empty()) throw CLI::RequiredError("--out or --clip");
    if (options.clip.empty()) {
        compareAll(options);
        return 0;
    }
    try {
        makeFilm(options);
        return 0;
    } catch (const Interrupted&) {
        return kInterrupted;
    }
}

// For CLI::Validator: an empty text means that the name is good.
std::string clipProblem(const std::string& path) {
    if (path.ends_with(".mp4") || path.ends_with(".webp")) return {};
    return "\"" + path + "\" is not FILE.mp4 or FILE.webp";
}

}  // namespace

void addFidelity(CommandLine& line) {
    const auto [command, options] = line.add<FidelityOptions>(
        "fidelity",
        "measure, or show in a film, how closely replicas follow the fish that they stand for",
        runFidelity);
    command.add_option(
        "SPECIES,--species",
        options.species,
        "name of a species in the config folder, or a file; all when not given, in a "
        "film bigeye_scad");
    CLI::Option* seed = command.add_option("--seed", options.seed, "which script of commands")
                            ->check(cli::wholeNumber(0, cli::kMostSeed))
                            ->capture_default_str();
    command
        .add_option("--seconds",
                    options.seconds,
                    "how long the script is: 60 when not given, and the whole film")
        ->check(cli::number(1, 3600));
    CLI::Option* out =
        command.add_option("--out", options.out, "folder for the page, its data and the pictures");
    command
        .add_option("--clip",
                    options.clip,
                    "FILE.mp4 or FILE.webp: a film of fish and replica instead, by one script")
        ->check(CLI::Validator(clipProblem, ""))
        ->excludes(out)
        ->excludes(seed);
    describeConfig(command, options.config);
}

}  // namespace aquarama
