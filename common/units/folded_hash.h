// SPDX-License-Identifier: Apache-2.0
// Folds arrays into one number: equal states have equal hashes.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace aquarama {

template <class Value>
[[nodiscard]] std::uint64_t bitsOf(Value value) {
    if constexpr (std::is_same_v<Value, float>)
        return std::bit_cast<std::uint32_t>(value);
    else
        return static_cast<std::uint64_t>(value);
}

// The multiply-and-shift of splitmix64.
template <class Value>
[[nodiscard]] std::uint64_t folded(std::uint64_t hash, const std::vector<Value>& values) {
    for (const Value value : values) {
        hash = (hash ^ bitsOf(value)) * 0xbf58476d1ce4e5b9U;
        hash ^= hash >> 29U;
    }
    return hash;
}

template <class... Vectors>
[[nodiscard]] std::size_t bytesIn(const Vectors&... vectors) {
    return (... + (vectors.size() * sizeof(vectors[0])));
}

}  // namespace aquarama
