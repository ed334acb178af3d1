// SPDX-License-Identifier: Apache-2.0
// An adaptive binary range coder (Martin 1979, as in LZMA): each bit takes as much room as its
// model finds it surprising. Encoder and decoder have the same functions, so that one description
// of a format serves both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace aquarama::school {

// How likely a bit is 0, in 1/65536, learned from the bits before it.
using BitModel = std::uint16_t;
inline constexpr BitModel kEven = 1U << 15U;  // 0 and 1 are equally likely

// The share of its error by which a model learns: 1/32.
inline constexpr unsigned kLearningBits = 5;
// Of a model, as far as the coder uses them.
inline constexpr unsigned kModelBits = 12;
// Below it the coder shifts a byte out or in.
inline constexpr std::uint32_t kLeastRange = 1U << 24U;

// The part of the range that stands for a 0; the model then learns the bit.
[[nodiscard]] inline std::uint32_t boundOf(std::uint32_t range, BitModel model) {
    return (range >> kModelBits) * (model >> (16U - kModelBits));
}
inline void learn(BitModel& model, bool bit) {
    model = static_cast<BitModel>(bit ? model - (model >> kLearningBits)
                                      : model + ((0x10000U - model) >> kLearningBits));
}

// Writes bits. All functions return what they were given.
class RangeEncoder {
  public:
    // A bit, as its model expects it; the model learns it.
    bool bit(BitModel& model, bool value) {
        const std::uint32_t bound = boundOf(range_, model);
        if (value) {
            low_ += bound;
            range_ -= bound;
        } else {
            range_ = bound;
        }
        learn(model, value);
        while (range_ < kLeastRange) {
            range_ <<= 8U;
            shift();
        }
        return value;
    }
    // The lowest bits of a number, the highest first, without a model.
    std::uint32_t plain(unsigned bits, std::uint32_t value) {
        for (unsigned at = bits; at-- > 0;) {
            range_ >>= 1U;
            if ((value >> at & 1U) != 0) low_ += range_;
            if (range_ < kLeastRange) {
                range_ <<= 8U;
                shift();
            }
        }
        return value;
    }
    // The bytes of all that was written; the encoder then begins anew. Bytes that are zero at the
    // end are left out: a decoder takes what is not there for zero.
    [[nodiscard]] std::vector<std::byte> finish() {
        // The number within the range that ends in most zeros.
        for (const std::uint32_t tail : {0xFFFFFFU, 0xFFFFU, 0xFFU}) {
            const std::uint64_t rounded = (low_ + tail) & ~std::uint64_t{tail};
            if (rounded >= low_ + range_) continue;
            low_ = rounded;
            break;
        }
        for (int byte = 0; byte < 5; ++byte) shift();
        while (!bytes_.empty() && bytes_.back() == std::byte{0}) bytes_.pop_back();
        std::vector<std::byte> bytes = std::move(bytes_);
        *this = {};
        return bytes;
    }

  private:
    // The top byte leaves, once it is known that no carry comes to it any more.
    void shift() {
        constexpr std::uint64_t kCarry = std::uint64_t{1} << 32U;
        if (low_ < 0xFF000000U || low_ >= kCarry) {
            const auto carry = static_cast<unsigned>(low_ >> 32U);
            if (!isFirst_) bytes_.push_back(static_cast<std::byte>(held_ + carry));
            isFirst_ = false;
            for (; waiting_ > 0; --waiting_)
                bytes_.push_back(static_cast<std::byte>(0xFFU + carry));
            held_ = static_cast<std::uint8_t>(low_ >> 24U);
        } else {
            ++waiting_;
        }
        low_ = (low_ & 0xFFFFFFU) << 8U;
    }

    std::vector<std::byte> bytes_;
    std::uint64_t low_ = 0;
    std::uint32_t range_ = 0xFFFFFFFF;
    std::uint8_t held_ = 0;
    bool isFirst_ = true;        // the first byte would always be 0
    std::uint64_t waiting_ = 0;  // bytes of 0xFF after the held one, which a carry would change
};

// Reads what a RangeEncoder wrote; what it is given counts for nothing. Of any other bytes it reads
// some bits or other. Does not own the bytes.
class RangeDecoder {
  public:
    explicit RangeDecoder(std::span<const std::byte> bytes) : rest_(bytes) {
        for (int byte = 0; byte < 4; ++byte) code_ = code_ << 8U | next();
    }
    // As of RangeEncoder.
    bool bit(BitModel& model, bool /*value*/) {
        const std::uint32_t bound = boundOf(range_, model);
        const bool value = code_ >= bound;
        if (value) {
            code_ -= bound;
            range_ -= bound;
        } else {
            range_ = bound;
        }
        learn(model, value);
        while (range_ < kLeastRange) {
            range_ <<= 8U;
            code_ = code_ << 8U | next();
        }
        return value;
    }
    // As of RangeEncoder.
    std::uint32_t plain(unsigned bits, std::uint32_t /*value*/) {
        std::uint32_t value = 0;
        for (unsigned at = 0; at < bits; ++at) {
            range_ >>= 1U;
            const bool isOne = code_ >= range_;
            if (isOne) code_ -= range_;
            value = value << 1U | static_cast<std::uint32_t>(isOne);
            if (range_ < kLeastRange) {
                range_ <<= 8U;
                code_ = code_ << 8U | next();
            }
        }
        return value;
    }

  private:
    std::uint32_t next() {
        if (rest_.empty()) return 0;
        const auto byte = std::to_integer<std::uint32_t>(rest_.front());
        rest_ = rest_.subspan(1);
        return byte;
    }

    std::span<const std::byte> rest_;
    std::uint32_t code_ = 0;
    std::uint32_t range_ = 0xFFFFFFFF;
};

}  // namespace aquarama::school
