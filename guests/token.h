// SPDX-License-Identifier: Apache-2.0
// What only those know who see the wall: a word in the code that they scan, and three digits that
// they read. Both change every two minutes. Times are seconds of the caller's clock.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace aquarama::guests {

// The words and digits of one key.
class DoorTokens {
  public:
    static constexpr double kEpochSeconds = 120;
    // Of the HMAC.
    using Key = std::array<unsigned char, 32>;

    explicit DoorTokens(const Key& key) : key_{key} {}

    // Ten letters of Crockford's base 32: 50 bits.
    [[nodiscard]] std::string wordAt(double now) const;
    // "042".
    [[nodiscard]] std::string digitsAt(double now) const;
    // Whether it is the word or the digits of this epoch or the last. Small letters count as
    // capitals.
    [[nodiscard]] bool acceptsWord(std::string_view word, double now) const;
    [[nodiscard]] bool acceptsDigits(std::string_view digits, double now) const;

  private:
    // HMAC-SHA256 of the epoch: its first 8 bytes.
    [[nodiscard]] std::uint64_t mac(std::uint64_t epoch) const;

    Key key_;
};

}  // namespace aquarama::guests
