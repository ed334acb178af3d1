// SPDX-License-Identifier: Apache-2.0
#include "common/net/blob.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama::net {
namespace {

constexpr std::size_t kPartBytes = std::size_t{4} << 20U;

}  // namespace

std::span<const std::byte> chunkAt(std::span<const std::byte> blob,
                                   std::uint64_t offset,
                                   std::size_t chunkBytes) {
    if (offset >= blob.size()) return {};
    const auto start = static_cast<std::size_t>(offset);
    return blob.subspan(start, std::min(chunkBytes, blob.size() - start));
}

// An empty chunk is valid only for an empty blob. Otherwise a peer could make the node ask for
// ever.
bool BlobAssembly::take(std::uint64_t offset,
                        std::uint64_t total,
                        std::span<const std::byte> content) {
    if (offset != nextOffset() || total_.value_or(total) != total) return false;
    if (content.size() > total - offset || (content.empty() && total > 0)) return false;
    total_ = total;
    if (parts_.empty() || parts_.back().size() + content.size() > kPartBytes)
        parts_.emplace_back().reserve(std::max(kPartBytes, content.size()));
    parts_.back().insert(parts_.back().end(), content.begin(), content.end());
    size_ += content.size();
    return true;
}

// Each part is freed as soon as it is copied, so that memory holds little more than one blob.
std::vector<std::byte> BlobAssembly::joined() {
    std::vector<std::byte> bytes;
    bytes.reserve(std::exchange(size_, 0));
    for (std::vector<std::byte>& part : parts_) {
        bytes.insert(bytes.end(), part.begin(), part.end());
        part = {};
    }
    parts_.clear();
    return bytes;
}

// The bytes are released in either case: a spoilt blob is fetched again.
std::optional<std::vector<std::byte>> BlobAssembly::checked() {
    if (!whole()) return std::nullopt;
    total_.reset();
    auto bytes = joined();
    if (digestOf(bytes) != digest_) return std::nullopt;
    return bytes;
}

BlobCache::BlobCache(std::filesystem::path directory, std::uintmax_t mostBytes)
    : directory_(std::move(directory)), mostBytes_(mostBytes) {
    trimFolder(directory_, mostBytes_, kMostAge);
}

std::filesystem::path BlobCache::pathOf(const Digest& digest) const {
    return directory_ / toHex(digest);
}

std::optional<std::vector<std::byte>> BlobCache::find(const Digest& digest) const {
    std::error_code error;
    if (!std::filesystem::exists(pathOf(digest), error)) return std::nullopt;
    try {
        auto bytes = readWhole(pathOf(digest), kMostBlobBytes);
        if (digestOf(bytes) != digest) return std::nullopt;
        markUsed(pathOf(digest));
        return bytes;
    } catch (const Error&) {  // it is only a cache: the blob is fetched again
    }
    return std::nullopt;
}

void BlobCache::keep(const Digest& digest, std::span<const std::byte> blob) const {
    if (keepIfPossible(pathOf(digest), blob, "it is fetched anew at each start"))
        trimFolder(directory_, mostBytes_, kMostAge);
}

std::uint64_t BlobCache::freeBytes() const {
    return freeBytesAt(directory_);
}

std::filesystem::path defaultBlobDirectory() {
    return cacheFolder() / "blobs";
}

}  // namespace aquarama::net
