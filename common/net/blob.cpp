// SPDX-License-Identifier: Apache-2.0
#include "common/net/blob.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace aquarama {
namespace {

constexpr std::uintmax_t kMaxCachedBytes = std::uintmax_t{64} << 20U;

std::optional<std::vector<std::byte>> readFile(const std::filesystem::path& path) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error || size > kMaxCachedBytes) return std::nullopt;
    std::vector<std::byte> bytes(size);
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (!file) return std::nullopt;
    return bytes;
}

bool writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    file.close();
    return file.good();
}

}  // namespace

std::span<const std::byte> chunkAt(std::span<const std::byte> blob,
                                   std::uint64_t offset,
                                   std::size_t chunkBytes) {
    if (offset >= blob.size()) return {};
    const auto start = static_cast<std::size_t>(offset);
    return blob.subspan(start, std::min(chunkBytes, blob.size() - start));
}

bool BlobAssembly::take(std::uint64_t offset,
                        std::uint64_t total,
                        std::span<const std::byte> content) {
    if (offset != nextOffset() || total_.value_or(total) != total) return false;
    if (content.size() > total - offset || (content.empty() && total > 0)) return false;
    total_ = total;
    bytes_.insert(bytes_.end(), content.begin(), content.end());
    return true;
}

std::optional<std::vector<std::byte>> BlobAssembly::checked() {
    if (!whole()) return std::nullopt;
    total_.reset();
    auto bytes = std::exchange(bytes_, {});
    if (digestOf(bytes) != digest_) return std::nullopt;
    return bytes;
}

std::filesystem::path BlobCache::pathOf(const Digest& digest) const {
    return directory_ / toHex(digest);
}

std::optional<std::vector<std::byte>> BlobCache::find(const Digest& digest) const {
    auto bytes = readFile(pathOf(digest));
    if (!bytes || digestOf(*bytes) != digest) return std::nullopt;
    return bytes;
}

void BlobCache::keep(const Digest& digest, std::span<const std::byte> blob) const {
    std::error_code error;
    std::filesystem::create_directories(directory_, error);
    const std::filesystem::path final = pathOf(digest);
    static std::atomic<unsigned> drafts = 0;  // two nodes of a test live in one process
    std::filesystem::path draft = final;
    draft += "." + std::to_string(getpid()) + "." + std::to_string(++drafts);
    if (writeFile(draft, blob)) std::filesystem::rename(draft, final, error);
    std::filesystem::remove(draft, error);
}

std::filesystem::path defaultBlobDirectory() {
    const auto variable = [](const char* name) -> std::filesystem::path {
        const char* value =
            std::getenv(name);  // NOLINT(concurrency-mt-unsafe): read while starting
        return value != nullptr ? value : "";
    };
    const std::filesystem::path cache = variable("XDG_CACHE_HOME");
    if (cache.is_absolute()) return cache / "aquarama" / "blobs";
    const std::filesystem::path home = variable("HOME");
    const auto base = home.empty() ? std::filesystem::temp_directory_path() : home / ".cache";
    return base / "aquarama" / "blobs";
}

}  // namespace aquarama
