// SPDX-License-Identifier: Apache-2.0
// Two kinds of hashes: SHA-256 for the identity of content, and a fast one for the state of a
// world.
#pragma once

#include <array>
#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace aquarama {

// The SHA-256 of a piece of content, which serves as its name: repertoires and other blobs are
// fetched, cached and checked by it.
struct Digest {
    std::array<std::uint8_t, 32> bytes{};
    friend auto operator<=>(const Digest&, const Digest&) = default;
};

// The largest content that is fetched by its digest. A raw 4K wall file has 100 MB.
inline constexpr std::size_t kMostBlobBytes = std::size_t{256} << 20U;

// The SHA-256 of the content.
[[nodiscard]] Digest digestOf(std::span<const std::byte> content);
[[nodiscard]] Digest digestOf(std::string_view content);
[[nodiscard]] std::string toHex(const Digest& digest);  // 64 lower-case digits
// The first 8 bytes of a digest: enough to distinguish contents, but not safe against forgery.
[[nodiscard]] std::uint64_t shortHash(const Digest& digest);

// Folds arrays into one number: equal states have equal hashes. Fast, and the same on every
// machine; not safe against an attacker.

// A float or double by its bits, so 0 and -0 differ; an integer or enum by its value.
template <class Value>
[[nodiscard]] std::uint64_t bitsOf(Value value) {
    if constexpr (std::is_same_v<Value, float>)
        return std::bit_cast<std::uint32_t>(value);
    else if constexpr (std::is_same_v<Value, double>)
        return std::bit_cast<std::uint64_t>(value);
    else
        return static_cast<std::uint64_t>(value);
}

// Adds one value to a hash: one multiply-and-shift of splitmix64.
template <class Value>
[[nodiscard]] std::uint64_t foldedOne(std::uint64_t hash, Value value) {
    hash = (hash ^ bitsOf(value)) * 0xbf58476d1ce4e5b9U;
    return hash ^ hash >> 29U;
}

// Adds an array to a hash; projection chooses what of each element. Eight chains run side by side:
// one alone would wait for each of its multiplications, and a quarter of a million fish are folded
// at every tick.
template <class Value, class Projection = std::identity>
[[nodiscard]] std::uint64_t folded(std::uint64_t hash,
                                   const std::vector<Value>& values,
                                   Projection projection = {}) {
    constexpr std::size_t kChains = 8;
    std::array<std::uint64_t, kChains> chains;
    for (std::size_t c = 0; c < kChains; ++c) chains[c] = foldedOne(hash, c);
    std::size_t i = 0;
    for (; i + kChains <= values.size(); i += kChains)
        for (std::size_t c = 0; c < kChains; ++c)
            chains[c] = foldedOne(chains[c], std::invoke(projection, values[i + c]));
    for (std::size_t c = 0; i + c < values.size(); ++c)
        chains[c] = foldedOne(chains[c], std::invoke(projection, values[i + c]));
    for (const std::uint64_t chain : chains) hash = foldedOne(hash, chain);
    return foldedOne(hash, values.size());
}

// The memory that the elements of some vectors take.
template <class... Vectors>
[[nodiscard]] std::size_t bytesIn(const Vectors&... vectors) {
    return (... + (vectors.size() * sizeof(vectors[0])));
}

}  // namespace aquarama
