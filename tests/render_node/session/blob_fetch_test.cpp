// SPDX-License-Identifier: Apache-2.0
// A fetch of blobs against a master that is a few lines of the test.
#include "render_node/session/blob_fetch.h"

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "tests/support/stage.h"

namespace aquarama::session {
namespace {

net::Blob blobOf(std::size_t bytes, int value) {
    return std::make_shared<const net::ByteVector>(bytes, static_cast<std::byte>(value));
}

class BlobFetchTest : public testing::Test {
  protected:
    ~BlobFetchTest() override {
        fetch_.stop();
        std::filesystem::remove_all(folder_);
    }
    // Turns until all blobs are there; answers each request with what the master has.
    void fetchAll() {
        while (!fetch_.turn(net::monotonicNow())) {
            if (const auto request = std::exchange(request_, {})) {
                answer(*request);
            } else {
                std::unique_lock lock(mutex_);
                woken_.wait_for(lock, std::chrono::milliseconds(20));
            }
        }
    }
    void answer(const v1::BlobRequest& request) {
        ++requests_;
        const auto& blob = *masters_.at(wire::digestIn(request.digest()));
        const auto content = net::chunkAt(blob, request.offset(), wire::kBlobChunkBytes);
        v1::BlobChunk chunk;
        chunk.set_digest(request.digest());
        chunk.set_offset(request.offset());
        chunk.set_total(blob.size());
        chunk.set_content(content.data(), content.size());
        fetch_.take(chunk);
    }
    // That the master has.
    Digest offer(const net::Blob& blob) {
        const Digest digest = digestOf(std::span{*blob});
        masters_[digest] = blob;
        return digest;
    }

    std::map<Digest, net::Blob> masters_;
    int requests_ = 0;
    std::optional<v1::BlobRequest> request_;
    std::mutex mutex_;
    std::condition_variable woken_;
    std::filesystem::path folder_ = test::freshDirectory();
    BlobFetch fetch_{net::BlobCache(folder_),
                     [this](const v1::Envelope& message) { request_ = message.blob_request(); },
                     [this] { woken_.notify_one(); }};
};

TEST_F(BlobFetchTest, nothingWantedIsDoneOnceForEachBegin) {
    EXPECT_FALSE(fetch_.turn(net::monotonicNow()));
    fetch_.begin({});
    EXPECT_TRUE(fetch_.turn(net::monotonicNow()));
    EXPECT_FALSE(fetch_.turn(net::monotonicNow()));
}

TEST_F(BlobFetchTest, fetchesInChunksAndKeepsOnDisk) {
    const net::Blob large = blobOf(2 * wire::kBlobChunkBytes + 5, 1), small = blobOf(9, 2);
    const std::vector<Digest> wanted{offer(large), offer(small)};
    fetch_.begin(wanted);
    fetchAll();
    EXPECT_EQ(requests_, 4);
    EXPECT_EQ(*fetch_.blobs().at(wanted[0]), *large);
    EXPECT_EQ(net::BlobCache(folder_).find(wanted[1]), *small);
}

TEST_F(BlobFetchTest, takesFromTheCacheWithoutARequest) {
    const net::Blob blob = blobOf(9, 3);
    const Digest digest = digestOf(std::span{*blob});
    net::BlobCache(folder_).keep(digest, *blob);
    fetch_.begin({digest});
    fetchAll();
    EXPECT_EQ(requests_, 0);
    EXPECT_EQ(*fetch_.blobs().at(digest), *blob);
}

TEST_F(BlobFetchTest, keepsOfTheFetchBeforeWhatIsWantedAgain) {
    const Digest first = offer(blobOf(9, 4)), second = offer(blobOf(9, 5));
    fetch_.begin({first, second});
    fetchAll();
    std::filesystem::remove_all(folder_);
    fetch_.begin({second});
    fetchAll();
    EXPECT_EQ(requests_, 2);
    EXPECT_FALSE(fetch_.blobs().contains(first));
}

TEST_F(BlobFetchTest, asksAgainAfterASecond) {
    fetch_.begin({offer(blobOf(9, 6))});
    while (!request_) EXPECT_FALSE(fetch_.turn(net::monotonicNow()));
    request_.reset();
    const net::Moment asked = net::monotonicNow();
    EXPECT_FALSE(fetch_.turn(asked));
    EXPECT_FALSE(request_);
    EXPECT_FALSE(fetch_.turn(asked + std::chrono::milliseconds(1100)));
    EXPECT_TRUE(request_);
}

TEST_F(BlobFetchTest, givesUpWhereTheMasterSendsOtherBytesThreeTimes) {
    const Digest digest = offer(blobOf(9, 7));
    masters_[digest] = blobOf(9, 8);
    fetch_.begin({digest});
    try {
        fetchAll();
        FAIL() << "it took other bytes";
    } catch (const Error& problem) {
        EXPECT_THAT(problem.what(), testing::HasSubstr(toHex(digest)));
    }
    EXPECT_EQ(requests_, 3);
    EXPECT_FALSE(fetch_.turn(net::monotonicNow()));
}

TEST_F(BlobFetchTest, aChunkOfAnotherBlobIsIgnored) {
    const Digest digest = offer(blobOf(9, 9));
    fetch_.begin({digest});
    while (!request_) EXPECT_FALSE(fetch_.turn(net::monotonicNow()));
    v1::BlobRequest other = *request_;
    other.set_digest(wire::bytesOf(offer(blobOf(9, 10))));
    answer(other);
    fetchAll();
    EXPECT_EQ(*fetch_.blobs().at(digest), *masters_.at(digest));
}

}  // namespace
}  // namespace aquarama::session
