// SPDX-License-Identifier: Apache-2.0
// A disk cache of derived data: results of long computations that depend on few inputs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "common/base/digest.h"

namespace aquarama {

// The digest of all sources of common and render_node, in hexadecimal, set by the build. Part of
// every key, so a change of the program makes all data anew.
[[nodiscard]] std::string_view sourceDigest();

// The inputs of one piece of derived data. Their digest names its file.
class DerivedKey {
  public:
    // kind: what the data is, such as "reef"; the file name begins with it.
    explicit DerivedKey(std::string kind) : kind_{std::move(kind)} { add(sourceDigest()); }
    // Adds an input. The order of inputs matters.
    DerivedKey& add(std::string_view text);
    DerivedKey& add(std::span<const std::byte> bytes);
    template <class Number>
    requires std::is_arithmetic_v<Number> || std::is_enum_v<Number> DerivedKey& add(Number number) {
        return add(std::as_bytes(std::span{&number, 1}));
    }
    [[nodiscard]] Digest digest() const { return digestOf(inputs_); }
    [[nodiscard]] std::string fileName() const { return kind_ + "-" + toHex(digest()); }

  private:
    std::string kind_;
    // Each input after its length, so that no two lists of inputs give the same text.
    std::string inputs_;
};

// A folder of derived data. Any number of processes and threads may use it at a time. A failed read
// or write is not an error: the data is computed again, with one warning.
class DerivedCache {
  public:
    // The content of one piece of derived data.
    using Bytes = std::vector<std::byte>;

    // The folder holds at most about `mostBytes`; files that were not used for longest are removed
    // first.
    explicit DerivedCache(std::filesystem::path folder,
                          std::uintmax_t mostBytes = std::uintmax_t{512} << 20U);

    // Returns the data stored under the key, or else calls `make` and stores the result. While one
    // process computes, others that need the same key wait, for a minute at most. Damaged data is
    // computed again. Exceptions of `make` are passed on.
    [[nodiscard]] Bytes find(const DerivedKey& key, const std::function<Bytes()>& make) const;

  private:
    // Empty where the file is missing or damaged. Marks the file as used.
    [[nodiscard]] std::optional<Bytes> read(const DerivedKey& key) const;
    // Writes the data, then removes the least recently used files until the folder is within its
    // limit.
    void write(const DerivedKey& key, const Bytes& content) const;

    std::filesystem::path folder_;
    std::uintmax_t mostBytes_;
};

// The cache of this user: the folder "derived" of cacheFolder().
[[nodiscard]] DerivedCache derivedCache();

// Arrays of plain values as bytes, one after the other: a count of 64 bits, then the values as they
// are in memory. Only for files that this machine reads itself.
class ArrayWriter {
  public:
    // Appends one array.
    template <class T>
    requires std::is_trivially_copyable_v<T> ArrayWriter& add(std::span<const T> values) {
        const std::uint64_t count = values.size();
        append(std::as_bytes(std::span{&count, 1}));
        append(std::as_bytes(values));
        return *this;
    }
    // The same for a vector.
    template <class T>
    ArrayWriter& add(const std::vector<T>& values) {
        return add(std::span{values});
    }
    // All that was added; the writer is empty afterwards.
    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    void append(std::span<const std::byte> more) {
        bytes_.insert(bytes_.end(), more.begin(), more.end());
    }
    std::vector<std::byte> bytes_;
};

// Reads what an ArrayWriter wrote, in the same order with the same types. Does not own the bytes.
class ArrayReader {
  public:
    // Begins at the first byte.
    explicit ArrayReader(std::span<const std::byte> bytes) : rest_{bytes} {}
    // The next array. Throws Error where there are fewer bytes than it needs.
    template <class T>
    requires std::is_trivially_copyable_v<T>
    [[nodiscard]] std::vector<T> next() {
        std::uint64_t count = 0;
        std::memcpy(&count, take(1, sizeof(count)).data(), sizeof(count));
        const std::span<const std::byte> bytes = take(count, sizeof(T));
        std::vector<T> values(bytes.size() / sizeof(T));
        if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }

  private:
    // The next count * size bytes.
    [[nodiscard]] std::span<const std::byte> take(std::uint64_t count, std::size_t size);
    std::span<const std::byte> rest_;
};

// Returns tables from this user's cache, or else calls `make` and stores the result.
// Tables::arrays() returns a std::tie of its arrays (vectors of plain values) in a fixed order.
template <class Tables, class Make>
[[nodiscard]] Tables derivedTables(const DerivedKey& key, const Make& make) {
    const std::vector<std::byte> bytes = derivedCache().find(key, [&] {
        Tables made = make();
        ArrayWriter writer;
        std::apply([&](auto&... arrays) { (writer.add(arrays), ...); }, made.arrays());
        return writer.take();
    });
    Tables tables;
    ArrayReader reader(bytes);
    const auto read = [&]<class T>(std::vector<T>& array) { array = reader.next<T>(); };
    std::apply([&](auto&... arrays) { (read(arrays), ...); }, tables.arrays());
    return tables;
}

}  // namespace aquarama
