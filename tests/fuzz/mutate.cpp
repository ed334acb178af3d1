// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <limits>
#include <string_view>

namespace aquarama {

namespace {

// Of [0, count). Distributions of the standard library differ between machines; this does not.
std::size_t below(std::size_t count, Random& random) {
    return count == 0 ? 0 : random() % count;
}

auto at(FuzzInput& input, std::size_t offset) {
    return input.begin() + static_cast<std::ptrdiff_t>(offset);
}

void flipBit(FuzzInput& input, Random& random) {
    if (!input.empty())
        input[below(input.size(), random)] ^= static_cast<std::uint8_t>(1U << below(8, random));
}

void setByte(FuzzInput& input, Random& random) {
    constexpr std::array<std::uint8_t, 6> kExtremes{0x00, 0x01, 0x7F, 0x80, 0xFE, 0xFF};
    if (!input.empty())
        input[below(input.size(), random)] = kExtremes.at(below(kExtremes.size(), random));
}

void setFloat(FuzzInput& input, Random& random) {
    using Limits = std::numeric_limits<float>;
    constexpr std::array kExtremes{0.0F,
                                   -0.0F,
                                   -1.0F,
                                   Limits::denorm_min(),
                                   Limits::max(),
                                   Limits::infinity(),
                                   -Limits::infinity(),
                                   Limits::quiet_NaN()};
    if (input.size() < 4) return;
    const auto bits = std::bit_cast<std::uint32_t>(kExtremes.at(below(kExtremes.size(), random)));
    const std::size_t offset = below(input.size() - 3, random);
    for (std::size_t i = 0; i < 4; ++i)
        input[offset + i] = static_cast<std::uint8_t>(bits >> 8 * i);
}

void cut(FuzzInput& input, Random& random) {
    input.resize(below(input.size() + 1, random));
}

void insertNoise(FuzzInput& input, Random& random) {
    FuzzInput noise(1 + below(16, random));
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
    input.insert(at(input, below(input.size() + 1, random)), noise.begin(), noise.end());
}

void dropSlice(FuzzInput& input, Random& random) {
    const std::size_t from = below(input.size() + 1, random);
    const std::size_t length = below(std::min<std::size_t>(64, input.size() - from) + 1, random);
    input.erase(at(input, from), at(input, from + length));
}

void repeatSlice(FuzzInput& input, Random& random) {
    const std::size_t from = below(input.size() + 1, random);
    const std::size_t length = below(std::min<std::size_t>(256, input.size() - from) + 1, random);
    const FuzzInput slice(at(input, from), at(input, from + length));
    input.insert(at(input, below(input.size() + 1, random)), slice.begin(), slice.end());
}

void goOnAs(FuzzInput& input, const FuzzInput& other, Random& random) {
    input.resize(below(input.size() + 1, random));
    FuzzInput rest = other;
    input.insert(input.end(), at(rest, below(rest.size() + 1, random)), rest.end());
}

void replaceNumber(FuzzInput& input, Random& random) {
    constexpr std::array<std::string_view, 12> kExtremes{"0",
                                                         "-1",
                                                         "1e308",
                                                         "-1e308",
                                                         "1e-308",
                                                         "nan",
                                                         "inf",
                                                         "-inf",
                                                         "1e39",
                                                         "2147483648",
                                                         "",
                                                         "x"};
    const auto isDigit = [](std::uint8_t c) { return std::isdigit(c) != 0; };
    const auto isOfNumber = [](std::uint8_t c) { return std::isdigit(c) != 0 || c == '.'; };
    const auto first = std::find_if(at(input, below(input.size(), random)), input.end(), isDigit);
    const auto last = std::find_if_not(first, input.end(), isOfNumber);
    if (first == last) return;
    const std::string_view extreme = kExtremes.at(below(kExtremes.size(), random));
    const auto gap = input.erase(first, last);
    input.insert(gap, extreme.begin(), extreme.end());
}

}  // namespace

FuzzInput mutated(const std::vector<FuzzInput>& seeds, Random& random) {
    FuzzInput input = seeds[below(seeds.size(), random)];
    for (std::size_t left = 1 + below(4, random); left > 0; --left) {
        switch (below(12, random)) {
            case 0:
                cut(input, random);
                break;
            case 1:
                insertNoise(input, random);
                break;
            case 2:
                dropSlice(input, random);
                break;
            case 3:
                repeatSlice(input, random);
                break;
            case 4:
                goOnAs(input, seeds[below(seeds.size(), random)], random);
                break;
            case 5:
            case 6:
                setByte(input, random);
                break;
            case 7:
                setFloat(input, random);
                break;
            case 8:
            case 9:
                replaceNumber(input, random);
                break;
            default:
                flipBit(input, random);
                break;
        }
    }
    return input;
}

}  // namespace aquarama
