// SPDX-License-Identifier: Apache-2.0
#include "common/base/typed_code.h"

#include <cctype>
#include <cstddef>

#include "common/base/random_bytes.h"

namespace aquarama {

namespace {

// Without I, L, O and U: five bits a letter.
constexpr std::string_view kCrockford = "0123456789ABCDEFGHJKMNPQRSTVWXYZ";
constexpr std::size_t kLetters = 8;

}  // namespace

std::string freshCode() {
    std::string code;
    for (const unsigned char byte : randomBytes<kLetters>()) code += kCrockford[byte & 31U];
    return code;
}

std::string shownCode(const std::string& code) {
    return code.substr(0, kLetters / 2) + "-" + code.substr(kLetters / 2);
}

// Crockford's alphabet has no O, I and L: typed, they mean 0 and 1.
std::string plainCode(std::string_view typed) {
    std::string code;
    for (const char c : typed) {
        const char capital = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        if (capital == 'O')
            code += '0';
        else if (capital == 'I' || capital == 'L')
            code += '1';
        else if (std::isalnum(static_cast<unsigned char>(capital)) != 0)
            code += capital;
    }
    return code;
}

}  // namespace aquarama
