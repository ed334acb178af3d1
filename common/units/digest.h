// SPDX-License-Identifier: Apache-2.0
// The name of a piece of content: its SHA-256. Repertoires and other blobs are fetched, cached and
// checked by it.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace aquarama {

struct Digest {
    std::array<std::uint8_t, 32> bytes{};
    friend auto operator<=>(const Digest&, const Digest&) = default;
};

[[nodiscard]] Digest digestOf(std::span<const std::byte> content);
[[nodiscard]] Digest digestOf(std::string_view content);
[[nodiscard]] std::string toHex(const Digest& digest);  // 64 lower-case digits

}  // namespace aquarama
