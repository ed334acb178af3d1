// SPDX-License-Identifier: Apache-2.0
// Blobs that are named by their SHA-256: split into chunks, joined again, checked and cached on
// disk.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/base/digest.h"

namespace aquarama::net {

// The bytes of a blob; shared, as they may be many.
using Blob = std::shared_ptr<const std::vector<std::byte>>;

// The part of a blob that starts at `offset`, at most `chunkBytes` of it; empty past its end.
[[nodiscard]] std::span<const std::byte> chunkAt(std::span<const std::byte> blob,
                                                 std::uint64_t offset,
                                                 std::size_t chunkBytes);

// Takes chunks in order until the blob is complete. Memory grows with the bytes that have arrived,
// not with the announced size.
class BlobAssembly {
  public:
    explicit BlobAssembly(const Digest& digest) : digest_(digest) {}

    // Takes the next chunk. False, and nothing is taken: it is not the next one, or has another
    // total than before.
    bool take(std::uint64_t offset, std::uint64_t total, std::span<const std::byte> content);
    [[nodiscard]] const Digest& digest() const { return digest_; }
    [[nodiscard]] std::uint64_t nextOffset() const { return size_; }
    [[nodiscard]] bool whole() const { return total_ && size_ == *total_; }
    // The blob, where it is complete and has the requested digest. The assembly is empty
    // afterwards. Takes a second for a large blob.
    [[nodiscard]] std::optional<std::vector<std::byte>> checked();

  private:
    Digest digest_;
    std::optional<std::uint64_t> total_;
    [[nodiscard]] std::vector<std::byte> joined();

    std::uint64_t size_ = 0;
    // Parts, so that a new chunk never moves the older ones.
    std::vector<std::vector<std::byte>> parts_;
};

// A directory of blobs. Where it cannot write it warns once and goes on: a cache only saves time.
// When it is opened, and with each new blob, it removes blobs that were not used for kMostAge. If
// the others have more than `mostBytes`, it removes those that were not used for longest.
class BlobCache {
  public:
    // Many times what a wall needs: a repertoire takes 5 MB, a wall file some tens of MB.
    static constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 30U;
    static constexpr std::chrono::hours kMostAge{24 * 90};

    explicit BlobCache(std::filesystem::path directory, std::uintmax_t mostBytes = kMostBytes);

    // The blob of this digest; empty where there is none, or its content has another digest.
    [[nodiscard]] std::optional<std::vector<std::byte>> find(const Digest& digest) const;
    // Stores a blob. Its file appears complete or not at all, also where another process writes the
    // same.
    void keep(const Digest& digest, std::span<const std::byte> blob) const;

    // Free bytes of its disk, for this user; 0 where they are unknown.
    [[nodiscard]] std::uint64_t freeBytes() const;

  private:
    [[nodiscard]] std::filesystem::path pathOf(const Digest& digest) const;
    std::filesystem::path directory_;
    std::uintmax_t mostBytes_;
};

// The folder "blobs" of cacheFolder().
[[nodiscard]] std::filesystem::path defaultBlobDirectory();

}  // namespace aquarama::net
