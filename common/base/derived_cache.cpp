// SPDX-License-Identifier: Apache-2.0
#include "common/base/derived_cache.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <zlib.h>

#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// The longest wait for another process that computes the same data, and the interval between two
// tests of its lock.
constexpr auto kLongestWait = 60s;
constexpr auto kLook = 20ms;
constexpr std::string_view kDataEnding = ".data";
constexpr auto kMostAge = std::chrono::hours(24 * 365);

// The lock of the process that computes a piece of data; the system releases it when the process
// dies. Without a lock file, and after the longest wait, the process continues without it: two
// processes then compute the same data, which does no harm.
class MakerLock {
  public:
    explicit MakerLock(const fs::path& path)
        : file_{open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR)} {
        const auto deadline = std::chrono::steady_clock::now() + kLongestWait;
        while (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) != 0 &&
               std::chrono::steady_clock::now() < deadline)
            std::this_thread::sleep_for(kLook);
    }
    ~MakerLock() {
        if (file_ >= 0) close(file_);
    }
    MakerLock(const MakerLock&) = delete;
    MakerLock& operator=(const MakerLock&) = delete;

  private:
    int file_;
};

// The head of a file, before the content. The digest is that of the inputs: content under the wrong
// name counts as damaged. The checksum (CRC-32) of the content finds damage in a seventh of a
// digest's time; it need not withstand an attacker, as only this user writes here.
struct Seal {
    Digest inputs;
    std::uint64_t sum;
    bool operator==(const Seal&) const = default;
};

Seal sealOf(const DerivedKey& key, std::span<const std::byte> content) {
    const auto* bytes = reinterpret_cast<const Bytef*>(content.data());
    return {key.digest(), crc32_z(crc32_z(0, nullptr, 0), bytes, content.size())};
}

}  // namespace

DerivedKey& DerivedKey::add(std::string_view text) {
    return add(std::as_bytes(std::span{text.data(), text.size()}));
}

DerivedKey& DerivedKey::add(std::span<const std::byte> bytes) {
    inputs_ += std::to_string(bytes.size()) + ":";
    inputs_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return *this;
}

DerivedCache::DerivedCache(fs::path folder, std::uintmax_t mostBytes)
    : folder_{std::move(folder)}, mostBytes_{mostBytes} {}

DerivedCache::Bytes DerivedCache::find(const DerivedKey& key,
                                       const std::function<Bytes()>& make) const {
    assert(make != nullptr);
    if (auto kept = read(key)) return *std::move(kept);
    std::error_code none;
    fs::create_directories(folder_, none);
    const fs::path lockFile = folder_ / (key.fileName() + ".lock");
    const MakerLock lock(lockFile);
    // Another process may have made it during the wait.
    if (auto kept = read(key)) return *std::move(kept);
    Bytes made = make();
    write(key, made);
    fs::remove(lockFile, none);
    return made;
}

// The file is a seal and then the content. The time of last write serves as the time of last use.
std::optional<DerivedCache::Bytes> DerivedCache::read(const DerivedKey& key) const {
    const fs::path path = folder_ / (key.fileName() + std::string(kDataEnding));
    std::error_code error;
    if (!fs::exists(path, error)) return std::nullopt;
    try {
        Bytes bytes = readWhole(path, mostBytes_);
        Seal seal{};
        if (bytes.size() < sizeof(seal)) return std::nullopt;
        std::memcpy(&seal, bytes.data(), sizeof(seal));
        if (seal != sealOf(key, std::span{bytes}.subspan(sizeof(seal)))) return std::nullopt;
        bytes.erase(bytes.begin(), bytes.begin() + sizeof(seal));
        markUsed(path);
        return bytes;
    } catch (const Error&) {
        return std::nullopt;
    }
}

void DerivedCache::write(const DerivedKey& key, const Bytes& content) const {
    const Seal seal = sealOf(key, content);
    Bytes bytes(sizeof(seal));
    std::memcpy(bytes.data(), &seal, sizeof(seal));
    bytes.insert(bytes.end(), content.begin(), content.end());
    const fs::path path = folder_ / (key.fileName() + std::string(kDataEnding));
    if (keepIfPossible(path, bytes, "it is made anew at each start"))
        trimFolder(folder_, mostBytes_, kMostAge);
}

DerivedCache derivedCache() {
    return DerivedCache{cacheFolder() / "derived"};
}

std::span<const std::byte> ArrayReader::take(std::uint64_t count, std::size_t size) {
    assert(size > 0);
    if (count > rest_.size() / size) throw Error("derived data ends within an array");
    const auto bytes = static_cast<std::size_t>(count) * size;
    const std::span<const std::byte> taken = rest_.first(bytes);
    rest_ = rest_.subspan(bytes);
    return taken;
}

}  // namespace aquarama
