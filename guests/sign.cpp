// SPDX-License-Identifier: Apache-2.0
#include "guests/sign.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include <qrencode.h>

#include "common/base/dot_font.h"
#include "common/base/log.h"

namespace aquarama::guests {

namespace {

constexpr std::size_t kQuiet = 4;  // modules about a code (ISO/IEC 18004)
constexpr std::size_t kScale = 2;  // dots of the sign for a dot of the font
constexpr std::size_t kGap = 1;    // dots between two characters
constexpr std::size_t kMargin = 2;
constexpr std::size_t kMostDots = 64;  // each way

using Code = std::unique_ptr<QRcode, decltype(&QRcode_free)>;

// The surest code of the fewest modules.
Code codeOf(const std::string& text) {
    Code best(nullptr, &QRcode_free);
    for (const QRecLevel level : {QR_ECLEVEL_L, QR_ECLEVEL_M, QR_ECLEVEL_Q, QR_ECLEVEL_H}) {
        Code code(QRcode_encodeString(text.c_str(), 0, level, QR_MODE_8, 1), &QRcode_free);
        if (code && (!best || code->width == best->width)) best = std::move(code);
    }
    if (!best) throw Error("no code can be made of " + text);
    return best;
}

// Lit and unlit dots, all of them lit at first.
class Dots {
  public:
    Dots(std::size_t columns, std::size_t rows)
        : columns_{columns}, rows_{rows}, lit_(columns * rows, true) {}
    void set(std::size_t column, std::size_t row, bool isLit) {
        lit_[row * columns_ + column] = isLit;
    }
    // A character, its top left dot at this place.
    void write(char character, std::size_t column, std::size_t row, bool isLit) {
        const GlyphBits glyph = glyphOf(character);
        for (std::size_t y = 0; y < kGlyphRows * kScale; ++y)
            for (std::size_t x = 0; x < kGlyphColumns * kScale; ++x)
                if (glyph >> (y / kScale * kGlyphColumns + x / kScale) & 1U)
                    set(column + x, row + y, isLit);
    }
    void darken(std::size_t firstRow) {
        std::fill(
            lit_.begin() + static_cast<std::ptrdiff_t>(firstRow * columns_), lit_.end(), false);
    }
    [[nodiscard]] wire::Sign sign() const {
        wire::Sign sign{.columns = static_cast<std::uint32_t>(columns_),
                        .rows = static_cast<std::uint32_t>(rows_),
                        .dots = std::string((lit_.size() + 7) / 8, '\0')};
        for (std::size_t i = 0; i < lit_.size(); ++i)
            if (lit_[i]) sign.dots[i / 8] = static_cast<char>(sign.dots[i / 8] | 0x80 >> (i % 8));
        return sign;
    }

  private:
    std::size_t columns_, rows_;
    std::vector<bool> lit_;
};

}  // namespace

wire::Sign signOf(const std::string& address, const std::string& characters, bool isInverted) {
    const Code code = codeOf(address);
    const auto modules = static_cast<std::size_t>(code->width);
    const std::size_t columns = modules + 2 * kQuiet;
    const std::size_t textRow = columns + kMargin;
    const std::size_t rows = textRow + kGlyphRows * kScale + kMargin;
    if (rows > kMostDots)
        throw Error("the address " + address +
                    " is too long for a sign; give phones a shorter one");
    Dots dots(columns, rows);
    for (std::size_t y = 0; y < modules; ++y)
        for (std::size_t x = 0; x < modules; ++x)
            dots.set(kQuiet + x, kQuiet + y, (code->data[y * modules + x] & 1U) == 0);
    if (isInverted) dots.darken(columns);
    constexpr std::size_t kStep = kGlyphColumns * kScale + kGap;
    const std::size_t width = characters.size() * kStep - kGap;
    for (std::size_t i = 0; i < characters.size(); ++i)
        dots.write(characters[i], (columns - width) / 2 + i * kStep, textRow, isInverted);
    return dots.sign();
}

}  // namespace aquarama::guests
