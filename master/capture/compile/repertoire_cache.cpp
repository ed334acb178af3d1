// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/repertoire_cache.h"

#include <fstream>
#include <optional>

#include <unistd.h>

#include "common/motion/repertoire.h"
#include "common/units/digest.h"
#include "common/units/error.h"
#include "master/capture/compile/capture_repertoire.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// Part of every key: raise it when the simulation or its compilation changes what comes out.
constexpr const char* kCaptureVersion = "aquarama capture 1\n";
constexpr std::uintmax_t kMostBytes = 64U << 20U;  // a repertoire takes 1.2 MB

fs::path cachedPath(const Species& species, const std::string& text, const fs::path& folder) {
    const std::string key = toHex(digestOf(kCaptureVersion + text));
    return folder / (species.name + "-" + key + ".aqrep");
}

std::optional<std::vector<std::byte>> findIntact(const fs::path& path) {
    if (!fs::exists(path)) return std::nullopt;
    try {
        std::vector<std::byte> bytes = readWhole(path);
        static_cast<void>(decodeRepertoire(bytes, path.string()));
        return bytes;
    } catch (const Error&) {
        return std::nullopt;  // damaged, or of another version of the format
    }
}

}  // namespace

std::vector<std::byte> readWhole(const fs::path& path) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error || size > kMostBytes)
        throw Error(path.string() + ": cannot be read as a repertoire; check the path");
    std::vector<std::byte> bytes(size);
    std::ifstream file(path, std::ios::binary);
    if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        throw Error(path.string() + ": reading failed; check its permissions");
    return bytes;
}

void writeWhole(const fs::path& path, std::span<const std::byte> content) {
    std::error_code error;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
    fs::path part = path;
    part += "." + std::to_string(getpid()) + ".part";
    std::ofstream file(part, std::ios::binary);
    file.write(reinterpret_cast<const char*>(content.data()),
               static_cast<std::streamsize>(content.size()));
    file.close();
    if (file) fs::rename(part, path, error);
    if (!file || error) {
        fs::remove(part, error);
        throw Error(path.string() +
                    ": cannot be written; choose a folder that can, with space left");
    }
}

std::vector<std::byte> repertoireFor(const std::string& speciesText,
                                     const std::string& source,
                                     const fs::path& cacheFolder,
                                     const Progress& progress) {
    const Species species = parseSpecies(speciesText, source);
    const fs::path path = cachedPath(species, speciesText, cacheFolder);
    if (auto cached = findIntact(path)) return *std::move(cached);
    std::vector<std::byte> bytes = encodeRepertoire(captureRepertoire(species, progress));
    writeWhole(path, bytes);
    return bytes;
}

}  // namespace aquarama
