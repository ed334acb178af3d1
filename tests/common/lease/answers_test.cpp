// SPDX-License-Identifier: Apache-2.0
// What is said to etcd, and what is made of its answers, right or wrong.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/lease/etcd_json.h"

namespace aquarama::lease {
namespace {

using testing::HasSubstr;

TEST(Requests, AreThoseOfEtcd) {
    EXPECT_EQ(grantRequest(1), R"({"TTL":"1"})");
    EXPECT_EQ(leaseRequest(7587862094943498752), R"({"ID":"7587862094943498752"})");
    const LeaseKeys keys{"aquarama/desk/master", "last"};
    EXPECT_EQ(holderRequest(keys), R"({"key":"YXF1YXJhbWEvZGVzay9tYXN0ZXI="})");
    const std::string anybody = takeRequest(keys, "a", 5, 0);
    EXPECT_THAT(anybody, HasSubstr(R"("create_revision":"0")"));
    EXPECT_THAT(anybody, HasSubstr(R"("lease":"5","value":"YQ==")"));
    EXPECT_THAT(anybody, testing::Not(HasSubstr("mod_revision")));
    EXPECT_THAT(takeRequest(keys, "ab", 5, 17), HasSubstr(R"("mod_revision":"17")"));
}

TEST(Answers, AreRead) {
    const LeaseAnswer granted =
        grantAnswer(R"({"header":{},"ID":"7587862094943498752","TTL":"1"})");
    EXPECT_EQ(granted.lease, 7587862094943498752);
    EXPECT_EQ(granted.seconds, 1);
    EXPECT_EQ(keepAliveAnswer(R"({"result":{"ID":"12","TTL":"1"}})").seconds, 1);
    EXPECT_EQ(keepAliveAnswer(R"({"result":{"ID":"12"}})").seconds, 0) << "it has expired";
    EXPECT_FALSE(holderAnswer(R"({"header":{"revision":"3"}})"));
    const auto holder = holderAnswer(
        R"({"header":{},"kvs":[{"value":"c3BhcmU=","mod_revision":"9","lease":"12"}],"count":"1"})");
    ASSERT_TRUE(holder);
    EXPECT_EQ(holder->name, "spare");
    EXPECT_EQ(holder->revision, 9U);
    EXPECT_EQ(holder->lease, 12);
    EXPECT_EQ(takeAnswer(R"({"header":{"revision":"21"},"succeeded":true})").revision, 21U);
    const Taken other = takeAnswer(
        R"({"header":{"revision":"21"},"responses":[{"response_range":{"kvs":[{"value":"YQ=="}]}}]})");
    EXPECT_FALSE(other.revision);
    EXPECT_EQ(other.holder->name, "a");
}

TEST(Answers, ThatAreWrongAreErrors) {
    for (const char* wrong : {"",
                              "{",
                              "[]",
                              "null",
                              "<html>",
                              "{}",
                              R"({"result":[]})",
                              R"({"result":{"ID":12,"TTL":"1"}})",
                              R"({"result":{"ID":"12x","TTL":"1"}})",
                              R"({"result":{"ID":"-12","TTL":"1"}})",
                              R"({"result":{"ID":"99999999999999999999","TTL":"1"}})",
                              R"({"result":{"TTL":"1"}})"})
        EXPECT_THROW(static_cast<void>(keepAliveAnswer(wrong)), Error) << wrong;
    EXPECT_THROW(static_cast<void>(grantAnswer(R"({"ID":"12"})")), Error) << "of no time";
    for (const char* wrong : {"{}",
                              R"({"header":[]})",
                              R"({"header":{},"kvs":{"a":1}})",
                              R"({"header":{},"kvs":[1]})",
                              R"({"header":{},"kvs":[{"mod_revision":{}}]})"})
        EXPECT_THROW(static_cast<void>(holderAnswer(wrong)), Error) << wrong;
    for (const char* wrong : {"{}",
                              R"({"header":{},"succeeded":true})",
                              R"({"header":{"revision":"1"}})",
                              R"({"header":{"revision":"1"},"succeeded":"true"})",
                              R"({"header":{"revision":"1"},"responses":[{}]})"})
        EXPECT_THROW(static_cast<void>(takeAnswer(wrong)), Error) << wrong;
}

TEST(Answers, NeverPutControlCharactersIntoALog) {
    const auto holder = holderAnswer(R"({"header":{},"kvs":[{"value":"G1szMW1h"}]})");
    EXPECT_EQ(holder->name, "?[31ma");
    EXPECT_TRUE(holderAnswer(R"({"header":{},"kvs":[{"value":"*"}]})")->name.empty());
    const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
    EXPECT_THROW(static_cast<void>(holderAnswer(deep)), Error);
}

}  // namespace
}  // namespace aquarama::lease
