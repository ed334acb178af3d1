// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/parts/part.h"
#include "common/parts/part_file.h"

namespace aquarama::parts {
namespace {

using testing::HasSubstr;

std::string errorOf(const auto& deed) {
    try {
        deed();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Parts, aPartIsTwoNumbersAndAnythingElseIsRefused) {
    EXPECT_EQ(parsePart("2/5"), (Part{2, 5}));
    EXPECT_EQ(parsePart("10000/10000"), (Part{10000, 10000}));
    for (const char* wrong : {"",
                              "2",
                              "/",
                              "2/",
                              "/5",
                              "0/5",
                              "6/5",
                              "-1/5",
                              "1/10001",
                              "1/5/6",
                              "1 /5",
                              "+1/5",
                              "1/0",
                              "0x1/5",
                              "1/99999999999999999999"})
        EXPECT_THAT(errorOf([&] { (void)parsePart(wrong); }), HasSubstr("K/N")) << wrong;
}

TEST(Parts, theFileOfAPartIsNamedAfterWhatIsMade) {
    EXPECT_EQ(partPath("film.mp4", {2, 5}), "film.mp4.2-of-5.aqpart");
    EXPECT_EQ(partPath("made/repertoires//", {1, 1}), "made/repertoires.1-of-1.aqpart");
}

TEST(Parts, eachUnitIsInOnePartAndPartsAreAlmostAlike) {
    for (const std::size_t units : {0U, 1U, 2U, 7U, 17U, 1000U})
        for (const std::uint32_t of : {1U, 2U, 3U, 20U}) {
            std::size_t next = 0;
            for (std::uint32_t number = 1; number <= of; ++number) {
                const UnitRange range = unitsOf({number, of}, units);
                EXPECT_EQ(range.first, next);
                EXPECT_LE(range.last - range.first, units / of + 1);
                EXPECT_GE(range.last - range.first, units / of);
                next = range.last;
            }
            EXPECT_EQ(next, units);
        }
    EXPECT_EQ(unitsOf({kMostParts, kMostParts}, SIZE_MAX).last, SIZE_MAX);
}

class PartFiles : public testing::Test {
  protected:
    static FinishedPart part(std::uint32_t number, std::uint32_t of = 3) {
        return {.work = {.kind = WorkKind::Study,
                         .build = "aquarama 1 (abc)",
                         .inputs = digestOf("inputs"),
                         .arithmetic = 5,
                         .of = of},
                .number = number,
                .content = {std::byte{1}, std::byte{static_cast<std::uint8_t>(number)}}};
    }
    std::string written(const std::string& name, const FinishedPart& part) const {
        const std::string path = folder_.path() / name;
        writeWhole(path, encodePart(part));
        return path;
    }
    static std::string refusal(const std::vector<std::string>& paths) {
        return errorOf([&] { (void)readWork(paths, "aquarama 1 (abc)"); });
    }

    TemporaryFolder folder_{"parts"};
};

TEST_F(PartFiles, areReadInTheirOrderWhateverTheOrderOfTheirNames) {
    const auto work = readWork(
        {written("c", part(3)), written("a", part(1)), written("b", part(2))}, "aquarama 1 (abc)");
    ASSERT_EQ(work.size(), 3U);
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(work[i].number, i + 1);
        EXPECT_EQ(work[i].content, part(i + 1).content);
        EXPECT_EQ(work[i].work.build, "aquarama 1 (abc)");
        EXPECT_EQ(work[i].work.inputs, digestOf("inputs"));
    }
}

TEST_F(PartFiles, thatMakeNoWholeAreRefusedByName) {
    const std::string one = written("one", part(1));
    const std::string two = written("two", part(2));
    EXPECT_THAT(refusal({one, two}), HasSubstr("part 3 of 3 is missing"));
    EXPECT_THAT(refusal({two}), HasSubstr("part 1 of 3 is missing"));
    EXPECT_THAT(refusal({one, two, one}), HasSubstr("is the same part as"));
    EXPECT_THAT(refusal({one, written("other N", part(2, 2))}),
                HasSubstr("other N: is part 2 of 2 of a study"));
    FinishedPart other = part(3);
    other.work.kind = WorkKind::Capture;
    EXPECT_THAT(refusal({one, two, written("kind", other)}),
                HasSubstr("kind: is part 3 of 3 of a capture"));
    other = part(3);
    other.work.inputs = digestOf("others");
    EXPECT_THAT(refusal({one, two, written("inputs", other)}),
                HasSubstr("inputs: was made of other inputs"));
    other = part(3);
    other.work.arithmetic = 6;
    EXPECT_THAT(refusal({one, two, written("machine", other)}),
                HasSubstr("machine: was computed by a machine"));
    other = part(3);
    other.work.build = "aquarama 2 (abd)";
    EXPECT_THAT(refusal({one, two, written("build", other)}),
                HasSubstr("build: was made by aquarama 2 (abd)"));
    EXPECT_THAT(refusal({one, folder_.path() / "none"}), HasSubstr("none"));
}

TEST_F(PartFiles, thatAreCutOrChangedAnywhereAreRefused) {
    const std::vector<std::byte> whole = encodePart(part(1));
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(errorOf([&] { (void)decodePart(std::span(whole).first(length), "p"); }), "")
            << length;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::vector<std::byte> changed = whole;
        changed[at] ^= std::byte{1};
        EXPECT_THAT(errorOf([&] { (void)decodePart(changed, "p"); }), HasSubstr("p: ")) << at;
    }
    EXPECT_THAT(errorOf([&] { (void)decodePart(std::as_bytes(std::span("text")), "p"); }),
                HasSubstr("p: is no part of a work"));
}

TEST_F(PartFiles, aLargeFileIsKnownByItsPieces) {
    const std::string path = folder_.path() / "large";
    std::vector<std::byte> content((std::size_t{16} << 20U) + 3);
    writeWhole(path, content);
    const Digest before = digestOfFile(path);
    content.back() = std::byte{1};
    writeWhole(path, content);
    EXPECT_NE(digestOfFile(path), before);
    EXPECT_THAT(errorOf([&] { (void)digestOfFile(folder_.path() / "none"); }),
                HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace aquarama::parts
