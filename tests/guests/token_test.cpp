// SPDX-License-Identifier: Apache-2.0
#include "guests/token.h"

#include <set>

#include <gtest/gtest.h>

namespace aquarama::guests {
namespace {

constexpr double kEpoch = DoorTokens::kEpochSeconds;

TEST(DoorTokens, areValidInTheirEpochAndTheNext) {
    const DoorTokens tokens({1, 2, 3});
    const double begin = 7 * kEpoch;
    const std::string word = tokens.wordAt(begin), digits = tokens.digitsAt(begin);
    EXPECT_EQ(word.size(), 10U);
    EXPECT_EQ(digits.size(), 3U);
    EXPECT_EQ(tokens.wordAt(begin + kEpoch - 0.001), word);
    EXPECT_NE(tokens.wordAt(begin + kEpoch), word);
    for (const double late : {0.0, kEpoch, 2 * kEpoch - 0.001}) {
        EXPECT_TRUE(tokens.acceptsWord(word, begin + late)) << late;
        EXPECT_TRUE(tokens.acceptsDigits(digits, begin + late)) << late;
    }
    EXPECT_FALSE(tokens.acceptsWord(word, begin + 2 * kEpoch));
    EXPECT_FALSE(tokens.acceptsWord(word, begin - 0.001)) << "of the next epoch";
    EXPECT_TRUE(tokens.acceptsWord(tokens.wordAt(0), 0)) << "the first epoch has none before it";
}

TEST(DoorTokens, areOfOneKeyAndWhole) {
    const DoorTokens tokens({1}), others({2});
    const std::string word = tokens.wordAt(0);
    EXPECT_FALSE(others.acceptsWord(word, 0));
    std::string small = word;
    for (char& letter : small) letter = static_cast<char>(std::tolower(letter));
    EXPECT_TRUE(tokens.acceptsWord(small, 0));
    for (std::size_t i = 0; i < word.size(); ++i) {
        std::string forged = word;
        forged[i] = forged[i] == 'A' ? 'B' : 'A';
        EXPECT_FALSE(tokens.acceptsWord(forged, 0)) << forged;
    }
    EXPECT_FALSE(tokens.acceptsWord("", 0));
    EXPECT_FALSE(tokens.acceptsWord(word.substr(1), 0));
    EXPECT_FALSE(tokens.acceptsWord(word + "0", 0));
    EXPECT_FALSE(tokens.acceptsDigits("", 0));
}

TEST(DoorTokens, areSpreadOverAllLetters) {
    const DoorTokens tokens({9});
    std::set<char> letters;
    std::set<std::string> words;
    for (int epoch = 0; epoch < 1000; ++epoch) {
        const std::string word = tokens.wordAt(epoch * kEpoch);
        letters.insert(word.begin(), word.end());
        words.insert(word);
    }
    EXPECT_EQ(letters.size(), 32U);
    EXPECT_EQ(words.size(), 1000U);
}

}  // namespace
}  // namespace aquarama::guests
