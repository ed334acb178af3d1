// SPDX-License-Identifier: Apache-2.0
#include "common/ask/order_book.h"

#include <gtest/gtest.h>

namespace aquarama::ask {
namespace {

TEST(OrderBook, answersAKnownOrderAgainAndNoOther) {
    OrderBook book;
    EXPECT_EQ(book.find(7), nullptr);
    book.enter(7, {Outcome::Refused, "there is no such scene"});
    ASSERT_NE(book.find(7), nullptr);
    EXPECT_EQ(*book.find(7), (Answer{Outcome::Refused, "there is no such scene"}));
    EXPECT_EQ(book.find(8), nullptr);
}

TEST(OrderBook, anOrderUnderWayGetsItsEnd) {
    OrderBook book;
    book.enter(7, {Outcome::Waiting, "nodes build it"});
    EXPECT_EQ(book.enter(7, {}), Answer{});
    EXPECT_EQ(*book.find(7), Answer{});
}

TEST(OrderBook, remembersTheLastAndForgetsTheOldest) {
    OrderBook book;
    for (std::uint64_t request = 1; request <= OrderBook::kMostOrders + 2; ++request)
        book.enter(request, {});
    EXPECT_EQ(book.find(2), nullptr);
    EXPECT_NE(book.find(3), nullptr);
    EXPECT_NE(book.find(OrderBook::kMostOrders + 2), nullptr);
}

// It would be carried out a second time.
TEST(OrderBook, anOrderUnderWayIsNotForgottenForOthers) {
    OrderBook book;
    book.enter(1, {Outcome::Waiting, "nodes build it"});
    for (std::uint64_t request = 2; request <= 3 * OrderBook::kMostOrders; ++request)
        book.enter(request, {});
    ASSERT_NE(book.find(1), nullptr);
    EXPECT_EQ(book.find(1)->outcome, Outcome::Waiting);
}

TEST(OrderBook, isBoundedAlsoWhereNothingEnds) {
    OrderBook book;
    for (std::uint64_t request = 1; request <= OrderBook::kMostOrders + 1; ++request)
        book.enter(request, {Outcome::Waiting, ""});
    EXPECT_EQ(book.find(1), nullptr);
    EXPECT_NE(book.find(2), nullptr);
}

}  // namespace
}  // namespace aquarama::ask
