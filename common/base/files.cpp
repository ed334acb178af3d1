// SPDX-License-Identifier: Apache-2.0
#include "common/base/files.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/base/log.h"
#include "common/base/output_file.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// An environment variable, empty where it is not set.
fs::path valueOf(const char* name) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets it
    return value != nullptr ? value : "";
}

void put(const fs::path& path,
         std::span<const std::byte> content,
         FileAccess access,
         FileSafety safety) {
    OutputFile file(path, access, safety);
    file.reserve(content.size());
    file.write(content);
    file.finish();
}

// A file of a folder, for trimFolder().
struct KeptFile {
    fs::file_time_type used;
    std::uintmax_t bytes = 0;
    fs::path path;
};

// The files of a folder, least recently used first.
std::vector<KeptFile> keptFilesIn(const fs::path& folder) {
    std::vector<KeptFile> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        KeptFile file{entry.last_write_time(error), entry.file_size(error), entry.path()};
        if (!error) files.push_back(std::move(file));  // else it has just been removed
    }
    std::ranges::sort(files, {}, &KeptFile::used);
    return files;
}

constexpr std::string_view kFolderBeginning = "aquarama.";

// The folder for temporary files, /tmp where TMPDIR is not usable.
fs::path temporaryPlace() {
    std::error_code error;
    const fs::path place = fs::temp_directory_path(error);
    return error ? "/tmp" : place;
}

// Opens a folder and locks it for this process; -1 where it is missing, of another user, or in use.
int lockedFolder(const fs::path& path) {
    const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder < 0) return -1;
    struct stat status {};
    const bool isOurs = fstat(folder, &status) == 0 && status.st_uid == geteuid();
    if (isOurs && flock(folder, LOCK_EX | LOCK_NB) == 0) return folder;
    close(folder);
    return -1;
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

void writeWhole(const fs::path& path, std::span<const std::byte> content) {
    put(path, content, FileAccess::Usual, FileSafety::Durable);
}

void writePrivate(const fs::path& path, std::span<const std::byte> content) {
    put(path, content, FileAccess::Private, FileSafety::Durable);
}

bool keepIfPossible(const fs::path& path,
                    std::span<const std::byte> content,
                    const std::string& loss) {
    try {
        put(path, content, FileAccess::Usual, FileSafety::Quick);
        return true;
    } catch (const Error& problem) {
        warnOnceOf(path.parent_path(), problem.what(), loss);
        return false;
    }
}

void warnOnceOf(const fs::path& folder, const std::string& problem, const std::string& loss) {
    static std::mutex mutex;
    static std::set<fs::path> told;
    {
        const std::lock_guard lock(mutex);
        if (!told.insert(folder).second) return;
    }
    logWarning("{} ({})", problem, loss);
}

void trimFolder(const fs::path& folder, std::uintmax_t mostBytes, std::chrono::hours mostAge) {
    const std::vector<KeptFile> files = keptFilesIn(folder);
    std::uintmax_t sum = 0;
    for (const KeptFile& file : files) sum += file.bytes;
    const auto oldest = fs::file_time_type::clock::now() - mostAge;
    std::error_code error;
    for (const KeptFile& file : files) {
        if (sum <= mostBytes && file.used >= oldest) return;
        sum -= file.bytes;
        fs::remove(file.path, error);
    }
}

void markUsed(const fs::path& path) {
    std::error_code error;
    fs::last_write_time(path, fs::file_time_type::clock::now(), error);
}

// Before a new folder is locked, another process may remove it as left over: then another one is
// made.
TemporaryFolder::TemporaryFolder(const std::string& purpose) {
    while (lock_ < 0) {
        std::string made =
            (temporaryPlace() / (std::string(kFolderBeginning) + purpose + ".XXXXXX")).string();
        if (mkdtemp(made.data()) == nullptr)
            throw Error(made + ": " + whyNotWritten(errno) + " (TMPDIR)");
        path_ = made;
        lock_ = lockedFolder(path_);
        std::error_code error;
        if (lock_ >= 0 && !fs::exists(path_, error)) close(std::exchange(lock_, -1));
    }
}

// Never throws: a folder that cannot be removed stays.
TemporaryFolder::~TemporaryFolder() {
    std::error_code none;
    fs::remove_all(path_, none);
    close(lock_);
}

void removeLeftFolders() {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(temporaryPlace(), none)) {
        if (!entry.path().filename().string().starts_with(kFolderBeginning)) continue;
        const int lock = lockedFolder(entry.path());
        if (lock < 0) continue;
        fs::remove_all(entry.path(), none);
        close(lock);
    }
}

ArrivingFiles::ArrivingFiles(fs::path folder)
    : folder_{std::move(folder)}, aside_{folder_ / ".arriving"} {
    requireWritableFolder(folder_);
}

ArrivingFiles::~ArrivingFiles() {
    std::error_code none;
    fs::remove_all(aside_, none);
}

void ArrivingFiles::settle() const {
    std::vector<fs::path> entries;
    for (const fs::directory_entry& entry : fs::directory_iterator(aside_))
        entries.push_back(entry.path());
    for (const fs::path& entry : entries) {
        std::error_code failure;
        const fs::path target = folder_ / entry.filename();
        fs::rename(entry, target, failure);
        if (failure) throw Error(target.string() + ": " + whyNotWritten(failure.value()));
    }
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
    return (home.empty() ? temporaryPlace() : home / underHome) / "aquarama";
}

fs::path cacheFolder() {
    return userFolder("XDG_CACHE_HOME", ".cache");
}

}  // namespace aquarama
