// SPDX-License-Identifier: Apache-2.0
// Derived data: what is a pure function of a few inputs and takes long to make, kept on disk, so
// that a machine makes it once.
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

#include "common/units/digest.h"

namespace aquarama::files {

// Of all sources of common and render_node: hexadecimal, from the build. Part of every key.
[[nodiscard]] std::string_view sourceDigest();

// The inputs of one piece of derived data, by the names of which its file is found.
class DerivedKey {
  public:
    // kind: what it is, such as "reef"; a file name.
    explicit DerivedKey(std::string kind) : kind_{std::move(kind)} { add(sourceDigest()); }
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
    std::string inputs_;  // each behind its length, so that no two lists of inputs read alike
};

// A folder of derived data. Any number of processes and threads may use it. What it cannot read or
// write it does without.
class DerivedCache {
  public:
    using Bytes = std::vector<std::byte>;

    // The folder holds at most about `mostBytes`; what was not used for longest goes first.
    explicit DerivedCache(std::filesystem::path folder,
                          std::uintmax_t mostBytes = std::uintmax_t{512} << 20U);

    // What is kept under the key, or else what `make` returns, which is then kept. While one
    // process makes a piece of data, others that ask for it wait, for a minute at most. Data that
    // was damaged on the disk is made anew.
    [[nodiscard]] Bytes find(const DerivedKey& key, const std::function<Bytes()>& make) const;

  private:
    [[nodiscard]] std::optional<Bytes> read(const DerivedKey& key) const;
    void write(const DerivedKey& key, const Bytes& content) const;
    void makeRoom() const;

    std::filesystem::path folder_;
    std::uintmax_t mostBytes_;
};

// This user's: the folder "derived" of cacheFolder().
[[nodiscard]] DerivedCache derivedCache();

// Arrays of plain values as bytes, one after the other.
class ArrayWriter {
  public:
    template <class T>
    requires std::is_trivially_copyable_v<T> ArrayWriter& add(std::span<const T> values) {
        const std::uint64_t count = values.size();
        append(std::as_bytes(std::span{&count, 1}));
        append(std::as_bytes(values));
        return *this;
    }
    template <class T>
    ArrayWriter& add(const std::vector<T>& values) {
        return add(std::span{values});
    }
    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    void append(std::span<const std::byte> more) {
        bytes_.insert(bytes_.end(), more.begin(), more.end());
    }
    std::vector<std::byte> bytes_;
};

// Reads what an ArrayWriter wrote, in the same order with the same types.
class ArrayReader {
  public:
    explicit ArrayReader(std::span<const std::byte> bytes) : rest_{bytes} {}
    // Throws Error where there are fewer bytes than the array needs.
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
    [[nodiscard]] std::span<const std::byte> take(std::uint64_t count, std::size_t size);
    std::span<const std::byte> rest_;
};

// Tables from this user's cache, or else what `make` returns, which is then kept. Of Tables,
// arrays() ties its arrays (vectors of plain values) in a fixed order.
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

}  // namespace aquarama::files
