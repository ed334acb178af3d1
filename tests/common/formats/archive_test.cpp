// SPDX-License-Identifier: Apache-2.0
// Archives come back as they were made; names that lead elsewhere and sizes that are lies are
// refused.
#include "common/formats/archive.h"

#include <algorithm>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/common/formats/sample_walls.h"

namespace aquarama::formats {
namespace {

using test::bytesOf;
using test::complaintOf;
using Content = std::vector<std::byte>;

std::string complaint(const Content& bytes) {
    return complaintOf([&] {
        Archive archive(bytes, "some.zip");
        for (const std::string& name : archive.names()) (void)archive.read(name);
    });
}

// The same archive with another name of the same length.
Content renamed(const std::string& from, const std::string& to) {
    Content bytes = encodeArchive({{from, bytesOf("content")}});
    const Content old = bytesOf(from), now = bytesOf(to);
    for (auto at = bytes.begin();;) {
        at = std::search(at, bytes.end(), old.begin(), old.end());
        if (at == bytes.end()) return bytes;
        std::ranges::copy(now, at);
    }
}

// Writes a number of the central directory, which has an entry of one length of name.
void setInDirectory(Content& bytes, std::size_t offset, std::uint32_t number) {
    const Content mark = bytesOf(std::string("PK\x01\x02"));
    const auto entry = std::search(bytes.begin(), bytes.end(), mark.begin(), mark.end());
    ASSERT_NE(entry, bytes.end());
    std::memcpy(&*entry + offset, &number, sizeof number);
}

TEST(Archive, filesComeBackAndTheSameFilesGiveTheSameBytes) {
    const std::vector<ArchiveFile> files{
        {"mpcdi.xml", bytesOf("<MPCDI/>")}, {"sub/Größe +1.pfm", Content(100000)}, {"empty", {}}};
    const Content bytes = encodeArchive(files);
    EXPECT_EQ(bytes, encodeArchive(files));
    EXPECT_TRUE(isArchive(bytes));
    Archive archive(bytes, "some.zip");
    ASSERT_EQ(archive.names().size(), 3U);
    for (const auto& [name, content] : files) EXPECT_EQ(archive.read(name), content) << name;
}

TEST(Archive, namesAreFoundInAnyCase) {
    const Content bytes = encodeArchive({{"Warp-A.PFM", bytesOf("x")}});
    const Archive archive(bytes, "some.zip");
    EXPECT_EQ(archive.find("./warp-a.pfm"), "Warp-A.PFM");
    EXPECT_EQ(archive.find("warp-b.pfm"), std::nullopt);
}

TEST(Archive, namesThatLeadElsewhereAreRefused) {
    EXPECT_EQ(complaint(renamed("abcdefgh", "a/b/..cd")), "");
    for (const char* name :
         {"../../ab", "a/../../", "/etc/abc", "c:/abcde", "a\\..\\bcd", "a\nbcdefg"})
        EXPECT_THAT(complaint(renamed("abcdefgh", name)),
                    testing::StartsWith("some.zip: the name of its entry \""))
            << name;
    EXPECT_THROW((void)encodeArchive({{"../a", {}}}), Error);
    EXPECT_THROW((void)encodeArchive({{"", {}}}), Error);
}

TEST(Archive, backslashesAndAFolderOfItsOwnAreReadAsSlashes) {
    for (const char* name : {"a\\b\\c.pfm", "./b/c.pfm"}) {
        const Content bytes = renamed("abcdefghi", name);
        Archive archive(bytes, "some.zip");
        const std::string plain = std::string(name).starts_with('.') ? "b/c.pfm" : "a/b/c.pfm";
        ASSERT_EQ(archive.names(), std::vector{plain});
        EXPECT_EQ(archive.read(plain), bytesOf("content"));
    }
    EXPECT_THROW((void)encodeArchive({{"a\\b", {}}}), Error);
}

TEST(Archive, twoEntriesOfOneNameAreRefused) {
    Content bytes = encodeArchive({{"aaaa", bytesOf("1")}, {"AAAB", bytesOf("2")}});
    const Content old = bytesOf("AAAB"), now = bytesOf("AAAA");
    for (auto at = bytes.begin(); at != bytes.end();) {
        at = std::search(at, bytes.end(), old.begin(), old.end());
        if (at != bytes.end()) std::ranges::copy(now, at);
    }
    EXPECT_THAT(complaint(bytes), testing::HasSubstr("\"AAAA\" is there twice"));
}

// Sizes stand at 20 (packed) and 24 (unpacked) of an entry of the central directory.
TEST(Archive, aSmallArchiveThatClaimsGigabytesIsRefused) {
    Content bytes = encodeArchive({{"bomb", Content(1000)}});
    setInDirectory(bytes, 24, 3000000000U);
    EXPECT_THAT(complaint(bytes), testing::HasSubstr("\"bomb\" claims 3000000000 bytes"));
    setInDirectory(bytes, 24, 400000000U);
    EXPECT_THAT(complaint(bytes), testing::HasSubstr("which no zip can hold"));
    setInDirectory(bytes, 24, 1001U);
    EXPECT_THAT(complaint(bytes), testing::HasSubstr("is damaged"));
    setInDirectory(bytes, 24, 999U);
    EXPECT_THAT(complaint(bytes), testing::HasSubstr("is damaged"));
}

TEST(Archive, aFlippedBitOfTheContentIsNoticed) {
    Content bytes = encodeArchive({{"a", bytesOf("some text that is long enough to be packed")}});
    bytes[45] ^= std::byte{4};
    EXPECT_THAT(complaint(bytes), testing::HasSubstr("some.zip"));
}

TEST(Archive, manyEntriesAreRefused) {
    std::vector<ArchiveFile> files;
    for (std::int64_t i = 0; i <= kMostEntries; ++i) files.push_back({std::to_string(i), {}});
    EXPECT_THAT(complaint(encodeArchive(files)), testing::HasSubstr("more than the 8192"));
}

TEST(Archive, anArchiveCutAnywhereIsRefused) {
    const Content bytes = encodeArchive({{"a", bytesOf("one")}, {"b", bytesOf("two")}});
    for (std::size_t size = 1; size < bytes.size(); ++size)
        EXPECT_THAT(complaint({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}),
                    testing::StartsWith("some.zip: "))
            << size;
}

}  // namespace
}  // namespace aquarama::formats
