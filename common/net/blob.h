// SPDX-License-Identifier: Apache-2.0
// Blobs named by their SHA-256: cut into chunks, put together again, checked and kept on disk.
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

// Shared: it may be large.
using Blob = std::shared_ptr<const std::vector<std::byte>>;

// The part of a blob that starts at `offset`, at most `chunkBytes` of it; empty past its end.
[[nodiscard]] std::span<const std::byte> chunkAt(std::span<const std::byte> blob,
                                                 std::uint64_t offset,
                                                 std::size_t chunkBytes);

// Takes chunks in order until the blob is whole. Memory grows with what has arrived, not with what
// was announced.
class BlobAssembly {
  public:
    explicit BlobAssembly(const Digest& digest) : digest_(digest) {}

    // False: not the chunk that comes next, or another total than before; it is not taken.
    bool take(std::uint64_t offset, std::uint64_t total, std::span<const std::byte> content);
    [[nodiscard]] const Digest& digest() const { return digest_; }
    [[nodiscard]] std::uint64_t nextOffset() const { return size_; }
    [[nodiscard]] bool whole() const { return total_ && size_ == *total_; }
    // The blob, where it is whole and has the digest that was asked for; starts afresh. Takes a
    // second for a large one.
    [[nodiscard]] std::optional<std::vector<std::byte>> checked();

  private:
    Digest digest_;
    std::optional<std::uint64_t> total_;
    [[nodiscard]] std::vector<std::byte> joined();

    std::uint64_t size_ = 0;
    // Parts, so that a chunk never moves what came before it.
    std::vector<std::vector<std::byte>> parts_;
};

// A directory of blobs. What it cannot write it does without, and warns once: a cache only saves
// time. Blobs that were not used for kMostAge are removed, and those that were not used for longest
// until there are at most `mostBytes`: when it is opened, and with each blob that is kept.
class BlobCache {
  public:
    // Many times what a wall needs: a repertoire takes 5 MB, a wall file some tens.
    static constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 30U;
    static constexpr std::chrono::hours kMostAge{24 * 90};

    explicit BlobCache(std::filesystem::path directory, std::uintmax_t mostBytes = kMostBytes);

    // Empty where there is none, or what is there is not what its name says.
    [[nodiscard]] std::optional<std::vector<std::byte>> find(const Digest& digest) const;
    // Appears under its name whole or not at all, whoever else writes the same.
    void keep(const Digest& digest, std::span<const std::byte> blob) const;

    // On its disk, for this user; 0 where it cannot be told.
    [[nodiscard]] std::uint64_t freeBytes() const;

  private:
    [[nodiscard]] std::filesystem::path pathOf(const Digest& digest) const;
    std::filesystem::path directory_;
    std::uintmax_t mostBytes_;
};

// The folder "blobs" of cacheFolder().
[[nodiscard]] std::filesystem::path defaultBlobDirectory();

}  // namespace aquarama::net
