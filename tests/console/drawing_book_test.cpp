// SPDX-License-Identifier: Apache-2.0
#include "console/drawing_book.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/digest.h"

namespace aquarama::console {
namespace {

using Status = v1::DrawingStatus;
using testing::ElementsAre;

// Drawings by number and condition.
v1::DrawingsReply listOf(const std::vector<std::pair<std::uint32_t, Status::Condition>>& all) {
    v1::DrawingsReply reply;
    for (const auto& [number, condition] : all) {
        Status& one = *reply.add_drawings();
        one.set_number(number);
        one.set_species("clownfish");
        one.set_condition(condition);
    }
    return reply;
}

v1::DrawingsReply withPicture(v1::DrawingsReply list, std::uint32_t number, std::string png) {
    list.set_skin_of(number);
    list.set_skin(std::move(png));
    return list;
}

TEST(DrawingBook, picturesAreAskedForOneByOneThoseThatWaitFirstThenTheNewest) {
    DrawingBook book;
    EXPECT_EQ(book.wanted(), 0U);
    const auto list = listOf(
        {{1, Status::SWIMMING}, {2, Status::WAITING}, {3, Status::WAITING}, {4, Status::LEAVING}});
    book.hear(list);
    std::vector<std::uint32_t> asked;
    while (const std::uint32_t number = book.wanted()) {
        asked.push_back(number);
        book.hear(withPicture(list, number, "png " + std::to_string(number)));
    }
    EXPECT_THAT(asked, ElementsAre(2U, 3U, 4U, 1U));
    ASSERT_NE(book.picture(3), nullptr);
    EXPECT_EQ(*book.picture(3)->png, "png 3");
    EXPECT_EQ(book.picture(3)->tag, toHex(digestOf(std::string_view("png 3"))).substr(0, 16));
    EXPECT_EQ(book.counts().waiting, 2U);
    EXPECT_EQ(book.counts().swimming, 1U);
}

TEST(DrawingBook, onePictureThatTheMasterLacksIsNotAskedForAgain) {
    DrawingBook book;
    const auto list = listOf({{1, Status::WAITING}});
    book.hear(list);
    book.hear(withPicture(list, 1, ""));
    EXPECT_EQ(book.wanted(), 0U);
    EXPECT_EQ(book.picture(1), nullptr);
    EXPECT_EQ(book.message().pictures_size(), 0);
}

TEST(DrawingBook, aNumberThatIsGivenAnewHasANewPicture) {
    DrawingBook book;
    const auto list = listOf({{1, Status::WAITING}});
    book.hear(withPicture(list, 1, "of yesterday"));
    book.hear(listOf({}));
    EXPECT_EQ(book.picture(1), nullptr);
    book.hear(list);
    EXPECT_EQ(book.wanted(), 1U);
}

TEST(DrawingBook, aPictureThatComesLateIsOfNobody) {
    DrawingBook book;
    book.hear(withPicture(listOf({{2, Status::WAITING}}), 1, "taken down meanwhile"));
    EXPECT_EQ(book.picture(1), nullptr);
}

TEST(DrawingBook, memoryIsBoundedAndThoseThatWaitHaveTheirPictures) {
    const std::string large(wire::kMostSkinBytes, 'x');
    constexpr std::uint32_t kFit = DrawingBook::kMostBytes / wire::kMostSkinBytes;
    std::vector<std::pair<std::uint32_t, Status::Condition>> all;
    for (std::uint32_t number = 1; number <= kFit + 10; ++number)
        all.emplace_back(number, Status::SWIMMING);
    DrawingBook book;
    book.hear(listOf(all));
    std::uint32_t asked = 0;
    for (; const std::uint32_t number = book.wanted(); ++asked)
        book.hear(withPicture(listOf(all), number, large));
    EXPECT_EQ(asked, kFit);
    EXPECT_EQ(book.picture(10), nullptr) << "the oldest have none";
    all.emplace_back(1000, Status::WAITING);
    book.hear(listOf(all));
    EXPECT_EQ(book.wanted(), 1000U);
    book.hear(withPicture(listOf(all), 1000, large));
    EXPECT_NE(book.picture(1000), nullptr);
    EXPECT_EQ(book.picture(11), nullptr) << "made room";
    EXPECT_EQ(book.wanted(), 0U);
    EXPECT_EQ(static_cast<std::uint32_t>(book.message().pictures_size()), kFit);
}

TEST(DrawingBook, everyChangeIsAnotherVersionAndAnEmptyBookHasNone) {
    DrawingBook book;
    const std::uint64_t first = book.version();
    book.clear();
    EXPECT_EQ(book.version(), first) << "nothing was there";
    book.hear(listOf({{1, Status::WAITING}}));
    EXPECT_GT(book.version(), first);
    book.clear();
    EXPECT_EQ(book.size(), 0U);
    EXPECT_GT(book.version(), first + 1);
}

}  // namespace
}  // namespace aquarama::console
