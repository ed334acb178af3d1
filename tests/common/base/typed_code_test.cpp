// SPDX-License-Identifier: Apache-2.0
#include "common/base/typed_code.h"

#include <cctype>
#include <set>

#include <gtest/gtest.h>

namespace aquarama {
namespace {

TEST(TypedCode, isReadAsPeopleTypeIt) {
    EXPECT_EQ(plainCode(" w54a-9o0i l"), "W54A90011");
    for (int i = 0; i < 100; ++i) {
        const std::string code = freshCode();
        std::string typed = shownCode(code);
        for (char& c : typed) c = static_cast<char>(std::tolower(c));
        EXPECT_EQ(plainCode(typed), code);
    }
}

// Of 2^40, a thousand that are drawn evenly hold no two alike but once in two million times.
TEST(TypedCode, isAnotherOneEachTime) {
    std::set<std::string> codes;
    for (int i = 0; i < 1000; ++i) codes.insert(freshCode());
    EXPECT_EQ(codes.size(), 1000U);
    EXPECT_EQ(codes.begin()->size(), 8U);
}

}  // namespace
}  // namespace aquarama
