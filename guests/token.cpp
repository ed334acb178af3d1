// SPDX-License-Identifier: Apache-2.0
#include "guests/token.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

namespace aquarama::guests {

namespace {

// Crockford's base 32, without I, L, O and U: five bits a letter.
constexpr std::string_view kLetters = "0123456789ABCDEFGHJKMNPQRSTVWXYZ";
constexpr std::size_t kWordLetters = 10;
constexpr std::uint64_t kDigitCodes = 1000;

std::uint64_t epochAt(double now) {
    return static_cast<std::uint64_t>(now / DoorTokens::kEpochSeconds);
}

std::string wordOf(std::uint64_t mac) {
    std::string word;
    for (std::size_t i = 0; i < kWordLetters; ++i) word += kLetters[mac >> (5 * i) & 31U];
    return word;
}

// Of bits that the word does not show.
std::string digitsOf(std::uint64_t mac) {
    return fmt::format("{:03}", (mac >> (5 * kWordLetters)) % kDigitCodes);
}

// In a time that does not tell where they differ.
bool isSame(std::string_view one, std::string_view other) {
    return one.size() == other.size() && CRYPTO_memcmp(one.data(), other.data(), one.size()) == 0;
}

}  // namespace

std::uint64_t DoorTokens::mac(std::uint64_t epoch) const {
    std::array<unsigned char, sizeof(epoch)> message{};
    for (std::size_t i = 0; i < message.size(); ++i)
        message[i] = static_cast<unsigned char>(epoch >> (8 * i));
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    HMAC(EVP_sha256(),
         key_.data(),
         static_cast<int>(key_.size()),
         message.data(),
         message.size(),
         digest.data(),
         &size);
    std::uint64_t first = 0;
    for (std::size_t i = 0; i < sizeof(first); ++i) first = first << 8U | digest[i];
    return first;
}

std::string DoorTokens::wordAt(double now) const {
    return wordOf(mac(epochAt(now)));
}

std::string DoorTokens::digitsAt(double now) const {
    return digitsOf(mac(epochAt(now)));
}

bool DoorTokens::acceptsWord(std::string_view word, double now) const {
    std::string capitals(word);
    std::ranges::transform(
        capitals, capitals.begin(), [](unsigned char c) { return std::toupper(c); });
    const std::uint64_t epoch = epochAt(now);
    const bool isThis = isSame(capitals, wordOf(mac(epoch)));
    const bool isLast = epoch > 0 && isSame(capitals, wordOf(mac(epoch - 1)));
    return isThis || isLast;
}

bool DoorTokens::acceptsDigits(std::string_view digits, double now) const {
    const std::uint64_t epoch = epochAt(now);
    const bool isThis = isSame(digits, digitsOf(mac(epoch)));
    const bool isLast = epoch > 0 && isSame(digits, digitsOf(mac(epoch - 1)));
    return isThis || isLast;
}

}  // namespace aquarama::guests
