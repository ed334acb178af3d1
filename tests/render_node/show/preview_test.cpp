// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/preview.h"

#include <array>
#include <memory>
#include <random>
#include <thread>

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include "common/base/log.h"
#include "common/wire/messages.h"
#include "render_node/gl/context.h"

namespace aquarama::show {
namespace {

using namespace std::chrono_literals;

ReducedPicture decoded(const std::string& jpeg) {
    const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
    ReducedPicture picture;
    const auto* bytes = reinterpret_cast<const unsigned char*>(jpeg.data());
    int kind = 0;
    tjDecompressHeader2(decoder.get(),
                        const_cast<unsigned char*>(bytes),
                        jpeg.size(),
                        &picture.sizePixels.x,
                        &picture.sizePixels.y,
                        &kind);
    picture.rgba.resize(static_cast<std::size_t>(4 * picture.sizePixels.x * picture.sizePixels.y));
    tjDecompress2(decoder.get(),
                  bytes,
                  jpeg.size(),
                  picture.rgba.data(),
                  picture.sizePixels.x,
                  0,
                  picture.sizePixels.y,
                  TJPF_RGBX,
                  TJFLAG_BOTTOMUP);
    return picture;
}

// Codes of the pixel in column x and row y from below.
std::array<int, 3> pixelOf(const ReducedPicture& picture, int x, int y) {
    const auto at = static_cast<std::size_t>(4 * (y * picture.sizePixels.x + x));
    return {picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]};
}

// A picture whose corners have colours of their own.
ReducedPicture corners(glm::ivec2 size) {
    ReducedPicture picture{
        size, std::vector<std::uint8_t>(static_cast<std::size_t>(4 * size.x * size.y))};
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const auto at = static_cast<std::size_t>(4 * (y * size.x + x));
            picture.rgba[at] = x < size.x / 2 ? 230 : 20;
            picture.rgba[at + 1] = y < size.y / 2 ? 200 : 30;
            picture.rgba[at + 2] = 60;
        }
    return picture;
}

TEST(ReducedPicture, isBlackWhereNoCodeIsAboveTheDither) {
    ReducedPicture picture{{2, 1}, {0, 1, 0, 255, 1, 0, 1, 255}};
    EXPECT_TRUE(isBlack(picture));
    picture.rgba[6] = 2;
    EXPECT_FALSE(isBlack(picture));
}

TEST(Preview, aJpegHasThePictureTheRightWayUp) {
    const ReducedPicture before = corners({64, 48});
    const ReducedPicture after = decoded(encodeJpeg(before));
    ASSERT_EQ(after.sizePixels, before.sizePixels);
    for (const auto& [x, y] : {std::pair{5, 5}, {60, 5}, {5, 40}, {60, 40}})
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(pixelOf(after, x, y).at(c), pixelOf(before, x, y).at(c), 8)
                << x << ' ' << y;
}

TEST(Preview, aPictureOfNoiseBecomesCoarserUntilItFitsAPacket) {
    ReducedPicture noise{{480, 360}, std::vector<std::uint8_t>(4U * 480U * 360U)};
    std::mt19937 random(1);
    for (std::uint8_t& code : noise.rgba) code = static_cast<std::uint8_t>(random());
    EXPECT_LE(encodeJpeg(noise).size(), wire::kMostJpegBytes);
    noise = {{1920, 1080}, std::vector<std::uint8_t>(4U * 1920U * 1080U)};
    for (std::uint8_t& code : noise.rgba) code = static_cast<std::uint8_t>(random());
    EXPECT_THROW(static_cast<void>(encodeJpeg(noise)), Error);
}

TEST(Preview, theReaderBringsWhatTheTargetHadReducedAndWithoutWaiting) {
    const auto context = gl::makeOffscreenContext("auto", {64, 64});
    const auto workspace = context->makeWorkspace();
    workspace->makeCurrent();
    {
        const gl::Target target(GL_RGBA8, {96, 64});
        const std::array<float, 4> colour{0.8F, 0.4F, 0.2F, 1};
        glClearNamedFramebufferfv(target.framebuffer(), GL_COLOR, 0, colour.data());
        PictureReader reader;
        EXPECT_FALSE(reader.take());
        for (const int width : {48, 500, 3}) {
            reader.begin(target, width);
            EXPECT_TRUE(reader.isBusy());
            // What is drawn afterwards is not in it.
            const std::array<float, 4> other{0, 0, 0, 1};
            glClearNamedFramebufferfv(target.framebuffer(), GL_COLOR, 0, other.data());
            glFinish();
            const auto picture = reader.take();
            ASSERT_TRUE(picture);
            EXPECT_FALSE(reader.isBusy());
            EXPECT_EQ(picture->sizePixels,
                      glm::ivec2(std::min(width, 96), std::min(width, 96) * 64 / 96));
            EXPECT_EQ(pixelOf(*picture, 1, 1), (std::array{204, 102, 51}));
            glClearNamedFramebufferfv(target.framebuffer(), GL_COLOR, 0, colour.data());
        }
    }
    workspace->release();
}

// A console on one end, a node's drawing thread on the other.
class WatcherLinkTest : public testing::Test {
  protected:
    std::optional<v1::Envelope> hear(v1::Envelope::MessageCase kind) {
        for (int i = 0; i < 200; ++i) {
            while (const auto from = console_->receiveControl()) {
                const auto message = wire::decode(from->bytes);
                node_ = from->peer;
                if (message && message->message_case() == kind) return message;
            }
            console_->wait(25ms);
        }
        return std::nullopt;
    }
    void ask(std::uint64_t number) {
        v1::Envelope question;
        question.mutable_picture_request()->set_number(number);
        question.mutable_picture_request()->set_width_px(64);
        console_->sendControl(node_, wire::encode(0, std::move(question)));
    }
    std::optional<int> wanted() {
        for (int i = 0; i < 200; ++i) {
            if (const auto width = link_.wantedWidth()) return width;
            std::this_thread::sleep_for(10ms);
        }
        return std::nullopt;
    }

    std::unique_ptr<net::MasterChannels> console_ =
        net::bindMaster("tcp://127.0.0.1:*", "tcp://127.0.0.1:*");
    WatcherLink link_{"left", console_->controlAddress(), {}};
    net::PeerId node_;
};

TEST_F(WatcherLinkTest, aPictureIsMadeForARequestOnlyAndNamesItAndItsFrame) {
    EXPECT_EQ(hear(v1::Envelope::kWatchHello)->watch_hello().channel(), "left");
    EXPECT_FALSE(link_.wantedWidth()) << "nobody looks";
    ask(7);
    EXPECT_EQ(wanted(), 64);
    EXPECT_FALSE(link_.wantedWidth()) << "one at a time";
    link_.put({42}, corners({64, 48}));
    const auto message = hear(v1::Envelope::kFramePicture);
    ASSERT_TRUE(message);
    EXPECT_EQ(message->frame_picture().number(), 7U);
    EXPECT_EQ(message->frame_picture().frame(), 42U);
    EXPECT_EQ(message->frame_picture().jpeg().substr(0, 2), "\xFF\xD8");
    const auto begun = net::monotonicNow();
    ask(8);
    EXPECT_EQ(wanted(), 64);
    EXPECT_GT(net::monotonicNow() - begun, 100ms) << "five a second at most";
}

// Its look goes with all that was drawn for it.
TEST_F(WatcherLinkTest, aPictureThatIsLostHoldsNoLaterOneBack) {
    ASSERT_TRUE(hear(v1::Envelope::kWatchHello));
    ask(7);
    ASSERT_EQ(wanted(), 64);
    std::this_thread::sleep_for(1s);
    ask(8);
    ASSERT_EQ(wanted(), 64);
    link_.put({43}, corners({64, 48}));
    const auto message = hear(v1::Envelope::kFramePicture);
    ASSERT_TRUE(message);
    EXPECT_EQ(message->frame_picture().number(), 8U);
}

TEST_F(WatcherLinkTest, aQuestionOfAFishIsAnsweredWithTheFrameThatWasLookedAt) {
    ASSERT_TRUE(hear(v1::Envelope::kWatchHello));
    v1::Envelope question;
    question.mutable_fish_request()->set_number(3);
    question.mutable_fish_request()->set_frame(40);
    question.mutable_fish_request()->set_x(0.5F);
    question.mutable_fish_request()->set_y(0.25F);
    console_->sendControl(node_, wire::encode(0, std::move(question)));
    std::optional<FishQuestion> asked;
    for (int i = 0; i < 200 && !asked; ++i) {
        std::this_thread::sleep_for(10ms);
        asked = link_.nextQuestion();
    }
    ASSERT_TRUE(asked);
    EXPECT_EQ(asked->place, glm::vec2(0.5F, 0.25F));
    link_.answer(*asked, {41}, 17);
    const auto reply = hear(v1::Envelope::kFishReply);
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->fish_reply().number(), 3U);
    EXPECT_EQ(reply->fish_reply().frame(), 41U);
    EXPECT_EQ(reply->fish_reply().fish(), 17U);
}

}  // namespace
}  // namespace aquarama::show
