// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/repertoire_cache.h"

#include <optional>

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
