// SPDX-License-Identifier: Apache-2.0
#include "common/base/seal.h"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"

namespace aquarama {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

constexpr const char* kWords = "a fish in a hall";

Bytes bytesOf(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

std::string refusalOf(const Bytes& seal, const std::string& passphrase = kWords) {
    try {
        static_cast<void>(unsealed(seal, passphrase, "hall"));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Seal, theContentComesBackByTheSamePassphraseOnly) {
    for (const std::string& text : {std::string("secret key"), std::string(100'000, 'x')}) {
        const Bytes content = bytesOf(text);
        const Bytes seal = sealed(content, kWords);
        EXPECT_EQ(unsealed(seal, kWords, "hall"), content);
        EXPECT_TRUE(std::ranges::search(seal, content).empty()) << "it can be read";
    }
    EXPECT_EQ(refusalOf(sealed(bytesOf("secret"), kWords), "a fish in a Hall"),
              "hall: the passphrase is wrong; type the one with which it was sealed");
}

TEST(Seal, theSameContentIsSealedOtherwiseEachTime) {
    EXPECT_NE(sealed(bytesOf("secret"), kWords), sealed(bytesOf("secret"), kWords));
}

// Of mark, salt, check, tag and content.
TEST(Seal, eachChangedByteIsSeen) {
    const Bytes seal = sealed(bytesOf("a secret of 23 bytes..."), kWords);
    for (const std::size_t at : {7UL, 8UL, 39UL, 40UL, 56UL, 78UL}) {
        Bytes changed = seal;
        changed.at(at) ^= std::byte{1};
        EXPECT_THAT(refusalOf(changed),
                    HasSubstr(at < 8    ? "is no seal"
                              : at < 40 ? "passphrase is wrong"
                                        : "was changed"))
            << at;
    }
}

TEST(Seal, whatIsCutIsRefused) {
    const Bytes seal = sealed(bytesOf("secret"), kWords);
    EXPECT_THAT(refusalOf({seal.begin(), seal.end() - 1}), HasSubstr("was changed"));
    EXPECT_THAT(refusalOf({seal.begin(), seal.begin() + 55}), HasSubstr("is no seal"));
    EXPECT_THAT(refusalOf({}), HasSubstr("is no seal"));
}

TEST(Seal, aShortPassphraseIsNotTaken) {
    EXPECT_THROW(static_cast<void>(sealed(bytesOf("secret"), "7 bytes")), Error);
    EXPECT_NO_THROW(static_cast<void>(sealed(bytesOf("secret"), "8 bytes.")));
}

}  // namespace
}  // namespace aquarama
