// SPDX-License-Identifier: Apache-2.0

#include "master/capture/capture_repertoire.h"

#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <mutex>
#include <optional>
#include <utility>

#include <unistd.h>

#include "common/files/files.h"
#include "common/motion/repertoire.h"
#include "common/units/digest.h"
#include "common/units/log.h"
#include "common/units/worker_pool.h"
#include "master/capture/compile_segment.h"
#include "master/capture/speed_response.h"
#include "master/capture/turn.h"

namespace aquarama::capture {

namespace {

constexpr int kCells = 40;
constexpr const char* kEraseRest = "\033[K";  // of the line

}  // namespace

ProgressBar::ProgressBar(std::string what)
    : what_(std::move(what)), isTerminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
    if (shown_ >= 0 && shown_ < 100) std::cerr << '\n';  // it was broken off
}

void ProgressBar::show(double share, const std::string& note) {
    const int percent = static_cast<int>(share * 100 + 1e-6);
    if (!isTerminal_ || (percent == shown_ && note == note_)) return;
    const bool isLast = percent == 100 && shown_ < 100;
    shown_ = percent;
    note_ = note;
    const auto filled = static_cast<std::size_t>(percent * kCells / 100);
    std::cerr << '\r' << what_ << " [" << std::string(filled, '#')
              << std::string(kCells - filled, '.') << "] " << percent << " %  " << note
              << kEraseRest;
    if (isLast) std::cerr << '\n';
    std::cerr.flush();
}

namespace {

constexpr std::size_t kGaits = 3;  // slow, medium, fast
constexpr std::size_t kJobs = 2 * kGaits;

// What one species' jobs leave behind. The first three swim its gaits and do not need one another;
// nor do the last three, but they set out from those gaits.
struct Swum {
    std::array<std::optional<SteadySwimming>, kGaits> forward;
    std::array<RecordedCycle, 2> leftTurn;  // gradual, sharp
    motion::SpeedResponse response;
    std::array<std::string, kJobs> errors;  // of each job
};

void runJob(const config::Species& species, std::size_t job, Swum& swum) {
    const auto& [slow, medium, fast] = swum.forward;
    const config::Swim& swim = species.swim;
    const std::array gaits{&swim.slow, &swim.medium, &swim.fast};
    if (job < kGaits)
        swum.forward.at(job) = swimUntilSteady(species, *gaits.at(job));
    else if (!slow || !medium || !fast)
        return;
    else if (job == 3)
        swum.leftTurn[0] = recordTypicalLeftTurn(species, *medium, species.turn.gradual);
    else if (job == 4)
        swum.leftTurn[1] = recordTypicalLeftTurn(species, *medium, species.turn.sharp);
    else
        swum.response = fitResponse(swimTransitions(species, {&*slow, &*medium, &*fast}));
}

motion::Repertoire compile(const config::Species& species, const Swum& swum) {
    const body::FishBody body = body::makeBody(species);
    motion::Repertoire repertoire;
    repertoire.species = species.name;
    repertoire.recordedLengthMetres = body.typicalLengthMetres;
    repertoire.response = swum.response;
    const auto segment = [&](motion::Action action) -> motion::ActionSegment& {
        return repertoire.segments.at(static_cast<std::size_t>(action));
    };
    segment(motion::Action::ForwardSlow) = compileForward(swum.forward[0]->beat);
    segment(motion::Action::ForwardMedium) = compileForward(swum.forward[1]->beat);
    segment(motion::Action::ForwardFast) = compileForward(swum.forward[2]->beat);
    segment(motion::Action::TurnLeftGradual) = compileLeftTurn(swum.leftTurn[0]);
    segment(motion::Action::TurnLeftSharp) = compileLeftTurn(swum.leftTurn[1]);
    segment(motion::Action::TurnRightGradual) = compileRightTurn(swum.leftTurn[0]);
    segment(motion::Action::TurnRightSharp) = compileRightTurn(swum.leftTurn[1]);
    if (species.recordsControlPoints)
        for (int action = 0; action < motion::kCapturedActions; ++action)
            addControlPoints(body, segment(static_cast<motion::Action>(action)));
    motion::addGlide(repertoire);
    return repertoire;
}

CaptureOutcome outcomeOf(const config::Species& species, const Swum& swum) {
    const auto error = std::ranges::find_if_not(swum.errors, &std::string::empty);
    if (error != swum.errors.end()) return {.repertoire = {}, .error = *error};
    try {
        return {.repertoire = compile(species, swum), .error = {}};
    } catch (const std::exception& thrown) {
        return {.repertoire = {}, .error = thrown.what()};
    }
}

}  // namespace

std::vector<CaptureOutcome> captureRepertoires(const std::vector<config::Species>& species,
                                               const CaptureRun& run) {
    std::vector<Swum> swum(species.size());
    std::mutex telling;
    std::size_t done = 0;
    const auto runOne = [&](std::size_t job, std::size_t fish) {
        std::string& error = swum[fish].errors.at(job);
        if (run.isStopped()) {
            error = species[fish].name + ": interrupted";
            return;
        }
        try {
            runJob(species[fish], job, swum[fish]);
        } catch (const std::exception& thrown) {
            error = thrown.what();
        }
        const std::lock_guard lock(telling);
        run.progress(static_cast<double>(++done) / static_cast<double>(kJobs * species.size()));
    };
    WorkerPool pool(run.threads);
    for (const std::size_t first : {std::size_t{0}, kGaits})
        pool.run(kGaits * species.size(),
                 [&](std::size_t i) { runOne(first + i / species.size(), i % species.size()); });

    std::vector<CaptureOutcome> outcomes(species.size());
    pool.run(species.size(), [&](std::size_t i) { outcomes[i] = outcomeOf(species[i], swum[i]); });
    return outcomes;
}

motion::Repertoire captureRepertoire(const config::Species& species, const Progress& progress) {
    CaptureOutcome outcome =
        std::move(captureRepertoires({species}, {.progress = progress}).front());
    if (!outcome.repertoire) throw Error(outcome.error);
    return *std::move(outcome.repertoire);
}

namespace fs = std::filesystem;

namespace {

constexpr const char* kExtension = ".txtpb";

std::vector<fs::path> allSpeciesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    if (fs::is_directory(folder))
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.path().extension() == kExtension) files.push_back(entry.path());
    if (files.empty())
        throw Error(folder.string() + ": holds no species; name the right folder with --config");
    std::ranges::sort(files);
    return files;
}

}  // namespace

fs::path findConfigFolder() {
    const fs::path program = fs::read_symlink("/proc/self/exe");
    for (fs::path folder = program.parent_path();; folder = folder.parent_path()) {
        for (const fs::path& candidate : {folder / "config", folder / "share/aquarama/config"})
            if (fs::is_directory(candidate / "species")) return candidate;
        if (folder == folder.root_path()) break;
    }
    throw Error(program.string() + ": no folder config/species above it; name one with --config");
}

std::vector<fs::path> speciesFiles(const std::vector<std::string>& namesOrFiles,
                                   const fs::path& configFolder) {
    if (namesOrFiles.empty()) return allSpeciesIn(configFolder / "species");
    std::vector<fs::path> files;
    for (const std::string& asked : namesOrFiles) {
        const fs::path named = configFolder / "species" / (asked + kExtension);
        files.push_back(fs::exists(named) ? named : fs::path(asked));
        if (!fs::is_regular_file(files.back()))
            throw Error("species \"" + asked + "\": neither a file nor a name in " +
                        (configFolder / "species").string() + "; choose one that is there");
    }
    return files;
}

namespace {

namespace fs = std::filesystem;

// Part of every key: raise it when the simulation or its compilation changes what comes out.
constexpr const char* kCaptureVersion = "aquarama capture 4\n";
constexpr std::uintmax_t kMostBytes = 64U << 20U;  // a repertoire takes 1.2 MB

fs::path cachedPath(const config::Species& species, const fs::path& folder) {
    const std::string key = toHex(digestOf(kCaptureVersion + species.motion));
    return folder / (species.name + "-" + key + ".aqrep");
}

std::optional<std::vector<std::byte>> findIntact(const fs::path& path) {
    if (!fs::exists(path)) return std::nullopt;
    try {
        std::vector<std::byte> bytes = readRepertoireFile(path);
        static_cast<void>(motion::decodeRepertoire(bytes, path.string()));
        return bytes;
    } catch (const Error&) {
        return std::nullopt;  // damaged, or of another version of the format
    }
}

void keep(const CaptureOutcome& outcome, const fs::path& path, RepertoireFile& file) {
    file.error = outcome.error;
    if (!outcome.repertoire) return;
    try {
        std::vector<std::byte> bytes = motion::encodeRepertoire(*outcome.repertoire);
        files::writeWhole(path, bytes);
        file.bytes = std::move(bytes);
    } catch (const Error& error) {
        file.error = error.what();
    }
}

}  // namespace

std::vector<std::byte> readRepertoireFile(const fs::path& path) {
    return files::readWhole(path, kMostBytes);
}

std::vector<RepertoireFile> repertoiresFor(const std::vector<config::Species>& all,
                                           const fs::path& cacheFolder,
                                           const CaptureRun& run) {
    std::vector<RepertoireFile> files(all.size());
    std::vector<config::Species> missing;
    std::vector<std::size_t> missingAt;
    for (std::size_t i = 0; i < all.size(); ++i) {
        files[i].species = all[i].name;
        if (auto cached = findIntact(cachedPath(all[i], cacheFolder))) {
            files[i].bytes = *std::move(cached);
            continue;
        }
        missing.push_back(all[i]);
        missingAt.push_back(i);
    }
    const std::vector<CaptureOutcome> outcomes = captureRepertoires(missing, run);
    for (std::size_t k = 0; k < missing.size(); ++k)
        keep(outcomes[k], cachedPath(missing[k], cacheFolder), files[missingAt[k]]);
    return files;
}

}  // namespace aquarama::capture
