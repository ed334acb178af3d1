// SPDX-License-Identifier: Apache-2.0
#include "capture/repertoire_files.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <initializer_list>
#include <optional>
#include <utility>

#include "common/base/digest.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/motion/repertoire.h"

namespace aquarama::capture {

namespace fs = std::filesystem;

namespace {

constexpr const char* kExtension = ".txtpb";

// Sorted by path, so that the order does not depend on the file system. Throws Error for none.
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

fs::path runningProgram() {
    return fs::read_symlink("/proc/self/exe");
}

// The nearest of these folders above the running program, up to the root.
std::optional<fs::path> aboveProgram(std::initializer_list<const char*> names,
                                     const std::function<bool(const fs::path&)>& isIt) {
    for (fs::path folder = runningProgram().parent_path();; folder = folder.parent_path()) {
        for (const char* name : names)
            if (isIt(folder / name)) return folder / name;
        if (folder == folder.root_path()) return std::nullopt;
    }
}

}  // namespace

fs::path findConfigFolder() {
    const auto found = aboveProgram({"config", "share/aquarama/config"}, [](const fs::path& path) {
        return fs::is_directory(path / "species");
    });
    if (!found)
        throw Error(runningProgram().string() +
                    ": no folder config/species above it; name one with --config");
    return *found;
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

// Part of every key: raise it when a change of the simulation or of the compilation changes the
// repertoires.
constexpr const char* kCaptureVersion = "aquarama capture 18\n";
// Part of the keys of species whose repertoires hold control points: raise it when the cage
// changes.
constexpr const char* kCageVersion = "cage 2\n";
constexpr std::uintmax_t kMostBytes = 64U << 20U;  // a repertoire takes 7 MB at most

// SPECIES-DIGEST.aqrep. The digest covers only the parts of the species file that influence motion:
// a change of colours or habits does not capture again.
fs::path fileNameOf(const config::Species& species) {
    const std::string cage = species.recordsControlPoints ? kCageVersion : "";
    const std::string key = toHex(digestOf(kCaptureVersion + cage + species.motion));
    return species.name + "-" + key + ".aqrep";
}

// The bytes of a file that decodes without error; nothing when it is absent or damaged.
std::optional<std::vector<std::byte>> findIntact(const fs::path& path) {
    std::error_code unreadable;
    if (!fs::exists(path, unreadable)) return std::nullopt;
    try {
        std::vector<std::byte> bytes = readRepertoireFile(path);
        static_cast<void>(motion::decodeRepertoire(bytes, path.string()));
        return bytes;
    } catch (const Error&) {
        // Damaged, or of another version of the format.
        return std::nullopt;
    }
}

std::optional<std::vector<std::byte>> findIn(const RepertoireFolders& folders,
                                             const fs::path& name) {
    if (!folders.shipped.empty())
        if (auto shipped = findIntact(folders.shipped / name)) return shipped;
    return findIntact(folders.own / name);
}

// Puts the bytes of a captured repertoire, or its error, into `file`, and writes them to `path`. A
// cache that cannot be written only costs time.
void keep(const CaptureOutcome& outcome, const fs::path& path, RepertoireFile& file) {
    file.error = outcome.error;
    if (!outcome.repertoire) return;
    file.bytes = motion::encodeRepertoire(*outcome.repertoire);
    keepIfPossible(path, file.bytes, "the fish are captured anew at each start");
}

}  // namespace

std::vector<std::byte> readRepertoireFile(const fs::path& path) {
    return readWhole(path, kMostBytes);
}

RepertoireFolders repertoireFolders() {
    const auto isFolder = [](const fs::path& path) { return fs::is_directory(path); };
    return {.own = cacheFolder() / "repertoires",
            .shipped = aboveProgram({"share/aquarama/repertoires"}, isFolder).value_or("")};
}

std::vector<RepertoireFile> repertoiresFor(const std::vector<config::Species>& all,
                                           const RepertoireFolders& folders,
                                           const CaptureRun& run) {
    std::vector<RepertoireFile> files(all.size());
    // The species that were not captured before, and the index of each in `all`.
    std::vector<config::Species> missing;
    std::vector<std::size_t> missingAt;
    for (std::size_t i = 0; i < all.size(); ++i) {
        files[i].species = all[i].name;
        if (auto captured = findIn(folders, fileNameOf(all[i]))) {
            files[i].bytes = *std::move(captured);
            continue;
        }
        missing.push_back(all[i]);
        missingAt.push_back(i);
    }
    if (!missing.empty()) run.begins(missing.size());
    const std::vector<CaptureOutcome> outcomes = captureRepertoires(missing, run);
    assert(outcomes.size() == missing.size());
    for (std::size_t k = 0; k < missing.size(); ++k)
        keep(outcomes[k], folders.own / fileNameOf(missing[k]), files[missingAt[k]]);
    return files;
}

}  // namespace aquarama::capture
