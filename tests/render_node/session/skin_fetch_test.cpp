// SPDX-License-Identifier: Apache-2.0
// A fetch of drawings against a master that is a few lines of the test.
#include "render_node/session/skin_fetch.h"

#include <chrono>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/base/picture.h"
#include "common/body/side_view.h"
#include "tests/render_node/session/listed_skins.h"
#include "tests/support/await.h"

namespace aquarama::session {
namespace {

using std::chrono::milliseconds;

class SkinFetchTest : public testing::Test {
  protected:
    SkinFetchTest() {
        setLogListener([this](Severity severity, const std::string& line) {
            if (severity >= Severity::Warning) warnings_.push_back(line);
        });
    }
    ~SkinFetchTest() override { setLogListener({}); }

    // Answers what is asked for until all is there.
    [[nodiscard]] bool completes() {
        return test::comesTrue([&] {
            fetch_.turn(net::monotonicNow());
            while (const auto request = std::exchange(request_, {})) answer(*request);
            return fetch_.isComplete();
        });
    }
    void answer(const v1::BlobRequest& request) {
        ++requests_;
        const Digest digest = wire::digestIn(request.digest());
        const net::Blob& blob = masters_.at(digest);
        const auto content = net::chunkAt(*blob, request.offset(), wire::kBlobChunkBytes);
        v1::BlobChunk chunk;
        chunk.set_digest(request.digest());
        chunk.set_offset(request.offset());
        chunk.set_total(blob->size());
        chunk.set_content(content.data(), content.size());
        fetch_.take(chunk);
    }
    // The digest of a list of these, which the master has.
    Digest offer(const std::vector<std::pair<std::uint32_t, net::Blob>>& pictures) {
        return test::offerSkins(pictures, masters_);
    }

    std::vector<std::string> warnings_;
    std::map<Digest, net::Blob> masters_;
    int requests_ = 0;
    std::optional<v1::BlobRequest> request_;
    SkinFetch::Skins skins_;
    SkinFetch fetch_{[this](const v1::Envelope& message) { request_ = message.blob_request(); },
                     [] {},
                     [this](SkinFetch::Skins skins) { skins_ = std::move(skins); }};
};

TEST_F(SkinFetchTest, withoutAListNothingIsAskedFor) {
    fetch_.want({});
    fetch_.turn(net::monotonicNow());
    EXPECT_TRUE(fetch_.isComplete());
    EXPECT_FALSE(request_);
}

TEST_F(SkinFetchTest, fetchesTheListAndEachPictureOnce) {
    const Digest list = offer({{7, test::plainSkin(200)}, {9, test::plainSkin(90)}});
    fetch_.want(list);
    EXPECT_FALSE(fetch_.isComplete());
    ASSERT_TRUE(completes());
    ASSERT_EQ(skins_->size(), 2U);
    EXPECT_EQ(skins_->at(7)->levels[3].at(5).r, 200);
    EXPECT_EQ(skins_->at(9)->levels[3].at(5).r, 90);
    const int asked = requests_;
    const SkinFetch::Skins before = skins_;
    fetch_.want(offer({{9, test::plainSkin(90)}, {12, test::plainSkin(30)}}));
    ASSERT_TRUE(completes());
    EXPECT_EQ(requests_, asked + 2);  // the list, and the one that is new
    EXPECT_EQ(skins_->at(9), before->at(9));
    EXPECT_FALSE(skins_->contains(7));
    fetch_.want({});
    EXPECT_TRUE(skins_->empty());
}

// What a node draws must not hang on the others: one line, and the good one is there.
TEST_F(SkinFetchTest, aBadPictureIsOneWarningAndTheOthersAreShown) {
    const auto noise = std::make_shared<const net::ByteVector>(400, std::byte{3});
    const Digest list = offer({{7, noise}, {8, test::plainSkin(50)}});
    fetch_.want(list);
    ASSERT_TRUE(completes());
    EXPECT_FALSE(skins_->contains(7));
    EXPECT_TRUE(skins_->contains(8));
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_THAT(warnings_[0],
                testing::AllOf(testing::HasSubstr("drawing 7, a clownfish"),
                               testing::HasSubstr("its fish keeps the skin of its species")));
    const int asked = requests_;
    fetch_.want(offer({{7, noise}, {8, test::plainSkin(50)}, {9, test::plainSkin(60)}}));
    ASSERT_TRUE(completes());
    EXPECT_EQ(requests_, asked + 2) << "it is not asked for again";
    EXPECT_EQ(warnings_.size(), 1U);
}

TEST_F(SkinFetchTest, otherBytesThanTheNameSaysAreRefused) {
    const net::Blob good = test::plainSkin(50);
    const Digest list = offer({{7, good}});
    masters_[digestOf(std::span{*good})] = test::plainSkin(51);
    fetch_.want(list);
    ASSERT_TRUE(completes());
    EXPECT_TRUE(skins_->empty());
    EXPECT_EQ(warnings_.size(), 1U);
}

// Refused by its announced size, before its bytes are taken.
TEST_F(SkinFetchTest, aPictureThatIsTooLargeIsRefusedAtItsFirstChunk) {
    const auto large =
        std::make_shared<const net::ByteVector>(wire::kMostSkinBytes + 1, std::byte{3});
    fetch_.want(offer({{7, large}}));
    ASSERT_TRUE(completes());
    EXPECT_EQ(requests_, 2);
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_THAT(warnings_[0], testing::HasSubstr("larger than a skin may be"));
}

TEST_F(SkinFetchTest, aListThatCannotBeReadNamesNothing) {
    const auto noise = std::make_shared<const net::ByteVector>(40, std::byte{0xFF});
    const Digest digest = digestOf(std::span{*noise});
    masters_[digest] = noise;
    fetch_.want(digest);
    ASSERT_TRUE(completes());
    EXPECT_TRUE(skins_->empty());
    EXPECT_EQ(warnings_.size(), 1U);
}

TEST_F(SkinFetchTest, asksAgainAfterASecondAndAnotherMasterAtOnce) {
    fetch_.want(offer({{7, test::plainSkin(50)}}));
    const net::Moment asked = net::monotonicNow();
    fetch_.turn(asked);
    ASSERT_TRUE(std::exchange(request_, {}));
    fetch_.turn(asked);
    EXPECT_FALSE(request_);
    fetch_.turn(asked + milliseconds(1100));
    EXPECT_TRUE(std::exchange(request_, {}));
    fetch_.restart();
    fetch_.turn(asked);
    EXPECT_TRUE(request_);
}

}  // namespace
}  // namespace aquarama::session
