// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/repertoire_cache.h"

#include <fstream>
#include <optional>
#include <sstream>

#include "common/files/files.h"
#include "common/motion/repertoire.h"
#include "common/units/digest.h"
#include "common/units/error.h"
#include "master/capture/compile/capture_repertoire.h"

namespace aquarama::capture {

namespace {

namespace fs = std::filesystem;

// Part of every key: raise it when the simulation or its compilation changes what comes out.
constexpr const char* kCaptureVersion = "aquarama capture 4\n";
constexpr std::uintmax_t kMostBytes = 64U << 20U;  // a repertoire takes 1.2 MB

fs::path cachedPath(const config::Species& species,
                    const std::string& text,
                    const fs::path& folder) {
    const std::string key =
        toHex(digestOf(kCaptureVersion + config::motionText(text, species.name)));
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

// The species, where it must be captured.
std::optional<config::Species> lookUp(const SpeciesText& text,
                                      const fs::path& cacheFolder,
                                      RepertoireFile& file) {
    try {
        config::Species species = config::parseSpecies(text.text, text.source);
        file.species = species.name;
        auto cached = findIntact(cachedPath(species, text.text, cacheFolder));
        if (!cached) return species;
        file.bytes = *std::move(cached);
    } catch (const Error& error) {
        file.error = error.what();
    }
    return std::nullopt;
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

SpeciesText readSpeciesText(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file) throw Error(path.string() + ": cannot be read; check the path and its permissions");
    return {path.string(), text.str()};
}

std::vector<RepertoireFile> repertoiresFor(const std::vector<SpeciesText>& texts,
                                           const fs::path& cacheFolder,
                                           const CaptureRun& run) {
    std::vector<RepertoireFile> files(texts.size());
    std::vector<config::Species> missing;
    std::vector<std::size_t> missingAt;
    for (std::size_t i = 0; i < texts.size(); ++i)
        if (auto species = lookUp(texts[i], cacheFolder, files[i])) {
            missing.push_back(*std::move(species));
            missingAt.push_back(i);
        }
    const std::vector<CaptureOutcome> outcomes = captureRepertoires(missing, run);
    for (std::size_t k = 0; k < missing.size(); ++k) {
        const std::size_t i = missingAt[k];
        keep(outcomes[k], cachedPath(missing[k], texts[i].text, cacheFolder), files[i]);
    }
    return files;
}

}  // namespace aquarama::capture
