// SPDX-License-Identifier: Apache-2.0
#include "common/net/blob.h"

#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace aquarama::net {
namespace {

std::vector<std::byte> someBlob(std::size_t size) {
    std::vector<std::byte> blob(size);
    for (std::size_t i = 0; i < size; ++i) blob[i] = static_cast<std::byte>(i * 131 % 251);
    return blob;
}

class Blob : public testing::Test {
  protected:
    Blob()
        : directory_(std::filesystem::path(testing::TempDir()) /
                     ("aquarama-blobs-" + std::to_string(getpid()))) {}
    ~Blob() override { std::filesystem::remove_all(directory_); }

    std::filesystem::path directory_;
};

TEST_F(Blob, isTheSameAfterChunks) {
    for (const std::size_t size : {0U, 1U, 999U, 1000U, 1001U, 12345U, 9U << 20U}) {
        const auto blob = someBlob(size);
        BlobAssembly assembly(digestOf(blob));
        do {
            const auto chunk = chunkAt(blob, assembly.nextOffset(), 1000);
            ASSERT_TRUE(assembly.take(assembly.nextOffset(), blob.size(), chunk));
        } while (!assembly.whole());
        EXPECT_EQ(assembly.checked(), blob);
    }
}

TEST_F(Blob, takesOnlyTheChunkThatComesNext) {
    const auto blob = someBlob(100);
    BlobAssembly assembly(digestOf(blob));
    EXPECT_FALSE(assembly.take(50, 100, chunkAt(blob, 50, 50)));
    EXPECT_TRUE(assembly.take(0, 100, chunkAt(blob, 0, 50)));
    EXPECT_FALSE(assembly.take(0, 100, chunkAt(blob, 0, 50)));    // twice
    EXPECT_FALSE(assembly.take(50, 101, chunkAt(blob, 50, 50)));  // another size now
    EXPECT_FALSE(assembly.take(50, 100, someBlob(51)));           // past the end
    EXPECT_FALSE(assembly.take(50, 100, {}));                     // no progress
    EXPECT_TRUE(assembly.take(50, 100, chunkAt(blob, 50, 50)));
    EXPECT_EQ(assembly.checked(), blob);
}

TEST_F(Blob, thatIsNotWhatWasAskedForIsRefusedAndFetchedAfresh) {
    auto blob = someBlob(100);
    BlobAssembly assembly(digestOf(blob));
    blob[63] ^= std::byte{1};
    ASSERT_TRUE(assembly.take(0, 100, blob));
    EXPECT_FALSE(assembly.checked());
    EXPECT_EQ(assembly.nextOffset(), 0U);
}

TEST_F(Blob, isFoundAgainInTheCache) {
    const auto blob = someBlob(5000);
    const BlobCache cache(directory_);
    EXPECT_FALSE(cache.find(digestOf(blob)));
    cache.keep(digestOf(blob), blob);
    EXPECT_EQ(BlobCache(directory_).find(digestOf(blob)), blob);
}

TEST_F(Blob, alteredInTheCacheIsNotFound) {
    const auto blob = someBlob(5000);
    const BlobCache cache(directory_);
    cache.keep(digestOf(blob), blob);
    const auto path = directory_ / toHex(digestOf(blob));
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary).seekp(77).put('!');
    EXPECT_FALSE(cache.find(digestOf(blob)));
    cache.keep(digestOf(blob), blob);  // and is mended by the next fetch
    EXPECT_EQ(cache.find(digestOf(blob)), blob);
    std::filesystem::resize_file(path, 100);
    EXPECT_FALSE(cache.find(digestOf(blob)));
}

TEST_F(Blob, leavesNothingElseInTheCache) {
    const BlobCache cache(directory_);
    cache.keep(digestOf("a"), someBlob(10));
    cache.keep(digestOf("a"), someBlob(10));
    const auto files = std::filesystem::directory_iterator(directory_);
    EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST_F(Blob, thatWasNotUsedForLongestMakesRoom) {
    const auto now = std::filesystem::file_time_type::clock::now();
    const BlobCache cache(directory_, 250);
    const std::vector<std::vector<std::byte>> blobs{someBlob(90), someBlob(100), someBlob(110)};
    for (std::size_t i = 0; i < 2; ++i) {
        cache.keep(digestOf(blobs[i]), blobs[i]);
        std::filesystem::last_write_time(directory_ / toHex(digestOf(blobs[i])),
                                         now - std::chrono::hours(10 - i));
    }
    EXPECT_TRUE(cache.find(digestOf(blobs[0])));  // now the second was not used for longest
    cache.keep(digestOf(blobs[2]), blobs[2]);
    EXPECT_TRUE(cache.find(digestOf(blobs[0])));
    EXPECT_FALSE(cache.find(digestOf(blobs[1])));
    EXPECT_TRUE(cache.find(digestOf(blobs[2])));
}

TEST_F(Blob, thatNobodyWantedForMonthsGoesWithTheNextStart) {
    const auto now = std::filesystem::file_time_type::clock::now();
    const auto old = someBlob(100), young = someBlob(200);
    const BlobCache cache(directory_);
    cache.keep(digestOf(old), old);
    cache.keep(digestOf(young), young);
    std::filesystem::last_write_time(directory_ / toHex(digestOf(old)),
                                     now - BlobCache::kMostAge - std::chrono::hours(1));
    const BlobCache next(directory_);
    EXPECT_FALSE(std::filesystem::exists(directory_ / toHex(digestOf(old))));
    EXPECT_TRUE(next.find(digestOf(young)));
}

TEST_F(Blob, goesWithoutACacheThatCannotBeWritten) {
    const BlobCache cache("/proc/no/such/place");
    cache.keep(digestOf("a"), someBlob(10));
    EXPECT_FALSE(cache.find(digestOf("a")));
}

}  // namespace
}  // namespace aquarama::net
