// SPDX-License-Identifier: Apache-2.0
#include "common/base/output_file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include "common/base/durable.h"
#include "common/base/log.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

constexpr mode_t kUsualMode = 0666, kPrivateMode = 0600, kOwnerBits = 07700;
constexpr std::string_view kPartEnding = ".part";

// The advice after "cannot be written (...)".
struct Remedy {
    int error;
    const char* text;
};
constexpr std::array kRemedies{
    Remedy{ENOSPC, "make room on that disk, or choose another"},
    Remedy{EDQUOT, "make room within this user's quota, or choose another disk"},
    Remedy{EFBIG, "raise the limit of a file's size (ulimit -f), or choose another disk"},
    Remedy{EROFS, "that disk is read-only: choose another"},
    Remedy{EACCES, "give this user the right to write it, or choose another folder"},
    Remedy{EPERM, "give this user the right to write it, or choose another folder"},
    Remedy{EISDIR, "that is a folder: name a file in it"},
    Remedy{EPIPE, "its reader has ended: keep that running to the end"},
    Remedy{ENXIO, "nobody reads there: start the reader of the pipe first, or name a file"},
    Remedy{EIO, "the disk fails: look into the system's log, or choose another disk"},
    Remedy{ELOOP, "its links lead in a circle: remove them"},
    Remedy{ENAMETOOLONG, "choose a shorter name"},
};

[[noreturn]] void refuseFile(const fs::path& path, int error) {
    throw Error(path.string() + ": " + whyNotWritten(error));
}

// The result of a system call that a signal may have interrupted.
template <class Call>
auto uninterrupted(const Call& call) {
    auto result = call();
    while (result < 0 && errno == EINTR) result = call();
    return result;
}

// Blocks the signals for a pipe without a reader and for the limit of file size. Both are reported
// as errors instead.
class HeldWriteSignals {
  public:
    HeldWriteSignals() {
        sigemptyset(&signals_);
        sigaddset(&signals_, SIGPIPE);
        sigaddset(&signals_, SIGXFSZ);
        pthread_sigmask(SIG_BLOCK, &signals_, &before_);
    }
    // Discards signals that a write has raised, unless the caller had blocked them before.
    ~HeldWriteSignals() {
        const int error = errno;
        constexpr timespec kNow{};
        if (sigismember(&before_, SIGPIPE) == 0)
            while (sigtimedwait(&signals_, nullptr, &kNow) > 0) {
            }
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
        errno = error;
    }
    HeldWriteSignals(const HeldWriteSignals&) = delete;
    HeldWriteSignals& operator=(const HeldWriteSignals&) = delete;

  private:
    sigset_t signals_{}, before_{};
};

// Writes bytes; returns how many were written. Fewer than all: errno is set.
std::size_t writeAll(int file, std::span<const std::byte> bytes) {
    const HeldWriteSignals held;
    std::size_t done = 0;
    while (done < bytes.size()) {
        const auto count =
            uninterrupted([&] { return ::write(file, bytes.data() + done, bytes.size() - done); });
        if (count < 0) return done;
        done += static_cast<std::size_t>(count);
    }
    return done;
}

// Flushes to the disk; false with errno set. Pipes and terminals have no disk and always succeed.
bool synced(int file) {
    return uninterrupted([&] { return fsync(file); }) == 0 || errno == EINVAL || errno == ENOTSUP ||
           errno == EROFS;
}

fs::path folderOf(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : ".";
}

bool isDescriptor(const std::string& name) {
    constexpr std::size_t kMostDigits = 6;
    return !name.empty() && name.size() <= kMostDigits &&
           name.find_first_not_of("0123456789") == std::string::npos;
}

// The descriptor number in /dev/fd/NUMBER or /proc/self/fd/NUMBER; -1 for another path.
int ownDescriptor(const fs::path& path) {
    const std::string name = path.filename().string();
    if (!isDescriptor(name)) return -1;
    std::error_code here, there;
    const bool isOurs =
        fs::canonical(folderOf(path), there) == fs::canonical("/proc/self/fd", here);
    return isOurs && !there ? std::stoi(name) : -1;
}

// Follows the links of a path, to a file that may be missing. Stops at a descriptor of this
// process.
fs::path followed(fs::path path) {
    constexpr int kMostLinks = 40;  // the limit of the system
    for (int i = 0; i < kMostLinks && ownDescriptor(path) < 0; ++i) {
        std::error_code isNoLink;
        const fs::path next = fs::read_symlink(path, isNoLink);
        if (isNoLink) break;
        path = folderOf(path) / next;
    }
    return path;
}

// The file at a path, if any.
struct Place {
    fs::path path;  // links followed
    int descriptor = -1;
    bool isThere = false;
    bool isRegular = true;  // also where it does not exist yet
    struct stat status {};
};

// Whether a file exists. Throws Error where that is unknown, or where no file can exist.
bool isThere(const fs::path& path, struct stat& status) {
    if (!path.has_filename()) refuseFile(path, EISDIR);
    if (stat(path.c_str(), &status) == 0) return true;
    if (errno != ENOENT) refuseFile(path, errno);
    return false;
}

bool isSameFile(const fs::path& path, const struct stat& status) {
    struct stat there {};
    return stat(path.c_str(), &there) == 0 && there.st_ino == status.st_ino &&
           there.st_dev == status.st_dev;
}

// A link such as /proc/PID/fd/4 may not lead to a path: then the path is kept.
Place placeOf(const fs::path& path) {
    Place place{.path = followed(path)};
    place.descriptor = ownDescriptor(place.path);
    place.isThere = isThere(path, place.status);
    if (!place.isThere) return place;
    if (S_ISDIR(place.status.st_mode)) refuseFile(path, EISDIR);
    const bool isSame = isSameFile(place.path, place.status);
    if (!isSame) place.path = path;
    place.isRegular = isSame && S_ISREG(place.status.st_mode) && place.descriptor < 0;
    return place;
}

// Throws Error where this user may not write the existing file.
void requireAccess(const fs::path& named, const Place& place) {
    if (!place.isThere || place.descriptor >= 0) return;
    if (access(place.path.c_str(), W_OK) != 0) refuseFile(named, errno);
    if (S_ISSOCK(place.status.st_mode)) refuseFile(named, ENXIO);
}

void makeFolder(const fs::path& path, const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) refuseFile(path, failure.value());
}

// The prefix "hall.mpcdi." of all parts of hall.mpcdi. A long name is shortened, since the name of
// a part is limited too.
std::string partBeginning(const fs::path& target) {
    constexpr std::size_t kMostLetters = 200;
    return target.filename().string().substr(0, kMostLetters) + ".";
}

// The name of a part. Process and number make it unique, since threads of one process may write the
// same file.
fs::path partOf(const fs::path& target) {
    static std::atomic<unsigned> parts = 0;
    return folderOf(target) / (partBeginning(target) + std::to_string(getpid()) + "." +
                               std::to_string(++parts) + std::string(kPartEnding));
}

bool isPartOf(const std::string& name, const std::string& beginning) {
    return name.size() > beginning.size() + kPartEnding.size() && name.starts_with(beginning) &&
           name.ends_with(kPartEnding) &&
           name.substr(0, name.size() - kPartEnding.size())
                   .find_first_not_of("0123456789.", beginning.size()) == std::string::npos;
}

// Removes parts whose writer has ended: a writer holds a lock on its part.
void removeLeftParts(const fs::path& target) {
    const std::string beginning = partBeginning(target);
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folderOf(target), none)) {
        if (!isPartOf(entry.path().filename().string(), beginning)) continue;
        const int part = open(entry.path().c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
        if (part < 0) continue;
        if (flock(part, LOCK_EX | LOCK_NB) == 0) unlink(entry.path().c_str());
        close(part);
    }
}

// Creates and locks a file; -1 with errno set. Another writer may have removed it before it was
// locked.
int openLocked(const fs::path& part, mode_t mode) {
    while (true) {
        const int file = open(part.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (file < 0) return -1;
        flock(file, LOCK_EX);
        struct stat status {};
        if (fstat(file, &status) != 0 || status.st_nlink > 0) return file;
        close(file);
    }
}

// Whether an existing file is written in place because a part cannot be made. Not on a full disk:
// that would lose the old content.
bool isWrittenInPlace(int error) {
    return error == EACCES || error == EPERM || error == EROFS;
}

// Opens an existing file for writing; -1 with errno set.
int openThere(const Place& place) {
    if (place.descriptor >= 0) return fcntl(place.descriptor, F_DUPFD_CLOEXEC, 0);
    const int file = uninterrupted(
        [&] { return open(place.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK); });
    if (file >= 0) fcntl(file, F_SETFL, 0);  // blocking from now on
    return file;
}

// The same, but waits some seconds for the reader of a pipe: a script may start both at once.
int openOnceRead(const Place& place) {
    using namespace std::chrono_literals;
    constexpr auto kPatience = 10s;
    constexpr auto kBetweenTries = 50ms;
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    int file = openThere(place);
    while (file < 0 && errno == ENXIO && S_ISFIFO(place.status.st_mode) &&
           std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(kBetweenTries);
        file = openThere(place);
    }
    return file;
}

// Reserves blocks from the old end to the new one. File systems without this call are not checked.
bool takesRoom(int file, std::uint64_t bytes) {
    struct stat status {};
    if (fstat(file, &status) != 0 || std::cmp_greater_equal(status.st_size, bytes)) return true;
    const HeldWriteSignals held;
    errno = posix_fallocate(
        file, status.st_size, static_cast<off_t>(bytes) - static_cast<off_t>(status.st_size));
    if (errno != ENOSPC && errno != EDQUOT && errno != EFBIG) return true;
    const int error = errno;
    static_cast<void>(ftruncate(file, status.st_size));
    errno = error;
    return false;
}

// Writes one byte more and removes it again: an empty file would fit on a full disk.
void probeFolder(const fs::path& named, const fs::path& part) {
    const int file = openLocked(part, kPrivateMode);
    if (file < 0) refuseFile(named, errno);
    const bool isWritten = writeAll(file, std::array{std::byte{}}) == 1;
    const int error = errno;
    unlink(part.c_str());
    close(file);
    if (!isWritten) refuseFile(named, error);
}

// Whether a file may be replaced. Not with several hard links, which would keep the old content,
// nor with an access list, which would be lost.
bool hasOnlyThisName(const fs::path& path, const struct stat& status) {
    return status.st_nlink == 1 &&
           getxattr(path.c_str(), "system.posix_acl_access", nullptr, 0) <= 0;
}

// Gives a file the owner of another one; false where this user may not.
bool giveOwner(int file, const struct stat& of) {
    struct stat made {};
    if (fstat(file, &made) != 0) return false;
    const bool isSame = of.st_uid == made.st_uid && of.st_gid == made.st_gid;
    return isSame || fchown(file, of.st_uid, of.st_gid) == 0;
}

// Copies the first bytes of a file to another one, cuts that there and flushes it to the disk;
// false with errno set.
bool copied(int from, int to, std::uint64_t bytes) {
    std::array<std::byte, 1U << 16U> part{};
    for (std::uint64_t at = 0; at < bytes;) {
        const auto count = uninterrupted(
            [&] { return pread(from, part.data(), part.size(), static_cast<off_t>(at)); });
        if (count <= 0) return false;
        const auto read = std::span(part).first(static_cast<std::size_t>(count));
        if (writeAll(to, read) != read.size()) return false;
        at += read.size();
    }
    return ftruncate(to, static_cast<off_t>(bytes)) == 0 && synced(to);
}

// Opens the target. Without O_CREAT where it exists: the system refuses that for other users' files
// in /tmp.
int openToAppend(const Place& place) {
    if (!place.isRegular) return openOnceRead(place);
    const int flags = O_WRONLY | O_APPEND | O_CLOEXEC | (place.isThere ? 0 : O_CREAT);
    return open(place.path.c_str(), flags, kUsualMode);
}

// A file that is not regular has no length.
bool cutTo(int file, std::uint64_t keptBytes) {
    struct stat status {};
    if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return true;
    return std::cmp_greater_equal(keptBytes, status.st_size) ||
           ftruncate(file, static_cast<off_t>(keptBytes)) == 0;
}

}  // namespace

std::string whyNotWritten(int error) {
    const auto* const known = std::ranges::find(kRemedies, error, &Remedy::error);
    return "cannot be written (" + std::system_category().message(error) + "); " +
           (known != kRemedies.end() ? known->text : "choose another folder");
}

void requireWritable(const fs::path& file) {
    const Place place = placeOf(file);
    requireAccess(file, place);
    if (!place.isRegular) return;
    makeFolder(file, folderOf(place.path));
    const bool mayProbe = access(folderOf(place.path).c_str(), W_OK | X_OK) == 0;
    if (mayProbe || !place.isThere) probeFolder(file, partOf(place.path));
}

void requireWritableFolder(const fs::path& folder) {
    makeFolder(folder, folder);
    probeFolder(folder, partOf(folder / "aquarama"));
}

OutputFile::OutputFile(fs::path path, FileAccess access, FileSafety safety)
    : path_{std::move(path)}, safety_{safety} {
    const Place place = placeOf(path_);
    target_ = place.path;
    isThere_ = place.isThere;
    isRegular_ = place.isRegular;
    requireAccess(path_, place);
    if (isRegular_) makeFolder(path_, folderOf(target_));
    if (isRegular_ && openPart(access)) return;
    file_ = openOnceRead(place);
    if (file_ < 0) refuse(errno);
}

OutputFile::~OutputFile() {
    if (file_ >= 0) close(file_);
    if (!part_.empty()) unlink(part_.c_str());
}

// Creates the part; false where the file must be written in place.
bool OutputFile::openPart(FileAccess access) {
    removeLeftParts(target_);
    const fs::path part = partOf(target_);
    const bool isPrivate = isThere_ || access == FileAccess::Private;
    file_ = openLocked(part, isPrivate ? kPrivateMode : kUsualMode);
    if (file_ < 0) {
        if (isThere_ && isWrittenInPlace(errno)) return false;
        refuse(errno);
    }
    part_ = part;
    isRenamed_ = keepIdentity(access);
    return true;
}

// Gives the part the owner and mode of the existing file; false where that fails.
bool OutputFile::keepIdentity(FileAccess access) const {
    struct stat old {};
    if (!isThere_ || stat(target_.c_str(), &old) != 0) return true;
    const mode_t mode = old.st_mode & ~static_cast<mode_t>(S_IFMT);
    const bool isPrivate = access == FileAccess::Private;
    return hasOnlyThisName(target_, old) && giveOwner(file_, old) &&
           fchmod(file_, isPrivate ? mode & kOwnerBits : mode) == 0;
}

void OutputFile::refuse(int error) const {
    refuseFile(path_, error);
}

void OutputFile::reserve(std::uint64_t bytes) {
    if (part_.empty() && isRegular_ && !takesRoom(file_, bytes)) refuse(errno);
}

void OutputFile::write(std::span<const std::byte> content) {
    if (writeAll(file_, content) != content.size()) refuse(errno);
    written_ += content.size();
}

void OutputFile::writeAt(std::uint64_t offset, std::span<const std::byte> content) {
    assert(canSeek());
    lseek(file_, static_cast<off_t>(offset), SEEK_SET);
    if (writeAll(file_, content) != content.size()) refuse(errno);
    written_ = std::max(written_, offset + content.size());
    lseek(file_, static_cast<off_t>(written_), SEEK_SET);
}

// Cuts a longer file that was written in place.
void OutputFile::cutToLength() {
    if (!part_.empty() || !isRegular_) return;
    if (ftruncate(file_, static_cast<off_t>(written_)) != 0) refuse(errno);
}

// Some disks report only now that they are full.
void OutputFile::finish() {
    cutToLength();
    if (safety_ == FileSafety::Durable && !synced(file_)) refuse(errno);
    if (!part_.empty()) putInPlace();
    if (close(std::exchange(file_, -1)) != 0) refuse(errno);
}

// A mount point, or another user's file in /tmp, cannot be replaced.
void OutputFile::putInPlace() {
    if (isRenamed_ && rename(part_.c_str(), target_.c_str()) == 0) {
        part_.clear();
        // Some file systems do not support it.
        if (safety_ == FileSafety::Durable) static_cast<void>(syncFolder(folderOf(target_)));
        return;
    }
    if (!isThere_) refuse(errno);
    copyIntoPlace();
}

// Copies the part into the target.
void OutputFile::copyIntoPlace() {
    const int target = open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (target < 0) refuse(errno);
    const bool isDone = takesRoom(target, written_) && copied(file_, target, written_);
    const int error = errno;
    close(target);
    if (!isDone) refuse(error);
}

GrowingFile::GrowingFile(fs::path path, std::uint64_t keptBytes) : path_{std::move(path)} {
    const Place place = placeOf(path_);
    if (place.isRegular) makeFolder(path_, folderOf(place.path));
    file_ = openToAppend(place);
    const bool isCut = file_ >= 0 && (!place.isRegular || cutTo(file_, keptBytes));
    if (!isCut) refuseFile(path_, errno);
}

GrowingFile::~GrowingFile() {
    if (file_ >= 0) ::close(file_);
}

GrowingFile& GrowingFile::operator=(GrowingFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(file_, other.file_);
    std::swap(failure_, other.failure_);
    return *this;
}

// An incomplete entry is removed again.
void GrowingFile::append(std::span<const std::byte> entry) {
    if (!isOpen()) return;
    const std::size_t count = writeAll(file_, entry);
    if (count == entry.size()) return;
    const int error = errno;
    struct stat status {};
    if (fstat(file_, &status) == 0 && S_ISREG(status.st_mode))
        static_cast<void>(ftruncate(file_, status.st_size - static_cast<off_t>(count)));
    ::close(std::exchange(file_, -1));
    refuseFile(path_, error);
}

void GrowingFile::append(std::string_view entry) {
    append(std::as_bytes(std::span(entry.data(), entry.size())));
}

// Logged once, since the file is closed then.
void GrowingFile::appendOrLog(std::span<const std::byte> entry) {
    try {
        append(entry);
    } catch (const Error& problem) {
        failure_ = problem.what();
        logError("{}; it ends here, the show goes on", failure_);
    }
}

void GrowingFile::appendOrLog(std::string_view entry) {
    appendOrLog(std::as_bytes(std::span(entry.data(), entry.size())));
}

bool GrowingFile::sync() {
    return isOpen() && synced(file_);
}

void GrowingFile::close() {
    if (!failure_.empty()) throw Error(failure_);
    if (!isOpen()) return;
    const bool isDone = synced(file_);
    const int error = errno;
    const bool isClosed = ::close(std::exchange(file_, -1)) == 0;
    if (!isDone || !isClosed) refuseFile(path_, isDone ? errno : error);
}

}  // namespace aquarama
