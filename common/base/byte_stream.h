// SPDX-License-Identifier: Apache-2.0
// Numbers as little-endian bytes, for files of our own.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace aquarama {

static_assert(std::endian::native == std::endian::little);

// Appends little-endian numbers to bytes, which it owns.
class ByteWriter {
  public:
    // Appends a number, the lowest byte first.
    template <class Unsigned>
    void unsignedNumber(Unsigned value) {
        for (std::size_t byte = 0; byte < sizeof(Unsigned); ++byte) {
            bytes_.push_back(
                static_cast<std::byte>(static_cast<std::uint64_t>(value) >> 8U * byte));
        }
    }
    void int16(std::int16_t value) { unsignedNumber(static_cast<std::uint16_t>(value)); }
    void float32(float value) { unsignedNumber(std::bit_cast<std::uint32_t>(value)); }
    // Appends numbers one after the other, as their bytes lie in memory.
    template <class Number>
    void numbers(std::span<const Number> values) {
        const std::span<const std::byte> bytes = std::as_bytes(values);
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    // Appends a byte for each character.
    template <class Container>
    void characters(const Container& text) {
        for (const auto character : text) unsignedNumber(static_cast<std::uint8_t>(character));
    }
    // What was written: moved out, or as a view that is valid until the next call.
    [[nodiscard]] std::vector<std::byte> take() && { return std::move(bytes_); }
    [[nodiscard]] std::span<const std::byte> written() const { return bytes_; }

  private:
    std::vector<std::byte> bytes_;
};

// Reads what a ByteWriter wrote; does not own the bytes. It never reads beyond their end: after the
// first number that is not wholly there, every number is zero and ok() is false.
class ByteReader {
  public:
    // Begins at the first byte.
    explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

    // The next number, the lowest byte first.
    template <class Unsigned>
    [[nodiscard]] Unsigned unsignedNumber() {
        std::uint64_t value = 0;
        const std::span<const std::byte> bytes = take(sizeof(Unsigned));
        for (std::size_t byte = 0; byte < bytes.size(); ++byte) {
            value |= std::to_integer<std::uint64_t>(bytes[byte]) << 8U * byte;
        }
        return static_cast<Unsigned>(value);
    }
    [[nodiscard]] std::int16_t int16() {
        return static_cast<std::int16_t>(unsignedNumber<std::uint16_t>());
    }
    [[nodiscard]] float float32() { return std::bit_cast<float>(unsignedNumber<std::uint32_t>()); }
    // As many numbers as there is room for in `values`, which is left as it is where there are
    // fewer.
    template <class Number>
    void numbers(std::span<Number> values) {
        const std::span<const std::byte> bytes = take(values.size_bytes());
        if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    }
    // Empty where there are fewer.
    [[nodiscard]] std::string characters(std::size_t count) {
        std::string text;
        for (const std::byte byte : take(count)) text += std::to_integer<char>(byte);
        return text;
    }

    // Whether all that was read was there, and how many bytes are left.
    [[nodiscard]] bool ok() const { return ok_; }
    [[nodiscard]] std::size_t remaining() const { return rest_.size(); }

  private:
    std::span<const std::byte> take(std::size_t count) {
        ok_ = ok_ && count <= rest_.size();
        if (!ok_) return {};
        const auto taken = rest_.first(count);
        rest_ = rest_.subspan(count);
        return taken;
    }

    std::span<const std::byte> rest_;
    bool ok_ = true;
};

}  // namespace aquarama
