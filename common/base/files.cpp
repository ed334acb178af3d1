// SPDX-License-Identifier: Apache-2.0
#include "common/base/files.h"

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// An environment variable, empty where it is not set.
fs::path valueOf(const char* name) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets it
    return value != nullptr ? value : "";
}

}  // namespace

std::vector<std::byte> readWhole(const fs::path& path, std::uintmax_t mostBytes) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error) throw Error(path.string() + ": cannot be read; check the path");
    if (size > mostBytes)
        throw Error(path.string() + ": has " + std::to_string(size) + " bytes, more than the " +
                    std::to_string(mostBytes) + " that are read; check the path");
    std::vector<std::byte> bytes(size);
    std::ifstream file(path, std::ios::binary);
    if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        throw Error(path.string() + ": reading failed; check its permissions");
    return bytes;
}

namespace {

// Of a file or a folder; whether the disk has it.
bool flush(const fs::path& path) {
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return false;
    const bool isDone = fsync(file) == 0;
    close(file);
    return isDone;
}

void write(const fs::path& path, std::span<const std::byte> content, bool isDurable) {
    // Process and number make the temporary name unique: threads of one process may write the same
    // file.
    static std::atomic<unsigned> parts = 0;
    std::error_code error;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
    fs::path part = path;
    part += "." + std::to_string(getpid()) + "." + std::to_string(++parts) + ".part";
    std::ofstream file(part, std::ios::binary);
    file.write(reinterpret_cast<const char*>(content.data()),
               static_cast<std::streamsize>(content.size()));
    file.close();
    const bool isWritten = file && (!isDurable || flush(part));
    if (isWritten) fs::rename(part, path, error);
    if (isDurable) flush(path.has_parent_path() ? path.parent_path() : ".");
    if (!isWritten || error) {
        fs::remove(part, error);
        throw Error(path.string() +
                    ": cannot be written; choose a folder that can, with space left");
    }
}

}  // namespace

void writeWhole(const fs::path& path, std::span<const std::byte> content) {
    write(path, content, false);
}

void writeDurably(const fs::path& path, std::span<const std::byte> content) {
    write(path, content, true);
}

std::uint64_t freeBytesAt(fs::path path) {
    std::error_code error;
    while (path.has_parent_path() && path != path.parent_path() && !fs::exists(path, error))
        path = path.parent_path();
    const fs::space_info space = fs::space(path, error);
    return error ? 0 : space.available;
}

fs::path userFolder(const char* variable, const char* underHome) {
    const fs::path given = valueOf(variable);
    if (given.is_absolute()) return given / "aquarama";
    const fs::path home = valueOf("HOME");
    return (home.empty() ? fs::temp_directory_path() : home / underHome) / "aquarama";
}

fs::path cacheFolder() {
    return userFolder("XDG_CACHE_HOME", ".cache");
}

}  // namespace aquarama
