// SPDX-License-Identifier: Apache-2.0
// Clips that several machines make of the pieces of a film, joined.
#include "calibration/compose/join.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/compose/clip.h"
#include "common/base/digest.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/parts/part.h"
#include "tests/support/read_clip.h"

namespace aquarama::compose {
namespace {

using testing::HasSubstr;

constexpr int kEvery = 2;

class JoinTest : public testing::Test {
  protected:
    [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() / name; }

    // Pictures of a film, from one number up to another: a patch that moves over noise.
    std::string filmed(const std::string& name,
                       int first,
                       int last,
                       const char* encoder = "libx264",
                       glm::ivec2 size = {48, 32}) const {
        const std::array only{encoder};
        const auto clip = makeVideo({path(name), size, kEvery}, only);
        for (int i = first; i < last; ++i) {
            Picture picture{size, 8, {}};
            for (int place = 0; place < 3 * size.x * size.y; ++place)
                picture.rgb.push_back(
                    static_cast<std::uint16_t>((place * 7 + i * (place % 11)) % 251));
            clip->add(picture, static_cast<std::uint64_t>(i * kEvery));
        }
        clip->finish();
        return path(name);
    }
    [[nodiscard]] static std::string digestOf(const std::string& file) {
        return toHex(aquarama::digestOf(readWhole(file, std::uintmax_t{1} << 24U)));
    }
    [[nodiscard]] std::string refusal(const std::vector<std::string>& clips) const {
        try {
            join({path("joined.mp4"), clips, kEvery});
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    TemporaryFolder folder_{"join"};
};

constexpr int kPiece = static_cast<int>(parts::kPicturesOfPiece);

// A film of two pieces and a bit, and the clips of its pieces.
TEST_F(JoinTest, clipsOfPiecesBecomeTheFileThatOneMachineMakes) {
    constexpr int kPictures = 2 * kPiece + 7;
    for (const char* encoder : videoEncoders()) {
        const std::string whole = filmed("whole.mp4", 0, kPictures, encoder);
        const std::vector<std::string> clips{filmed("1.mp4", 0, kPiece, encoder),
                                             filmed("2.mp4", kPiece, 2 * kPiece, encoder),
                                             filmed("3.mp4", 2 * kPiece, kPictures, encoder)};
        join({path("joined.mp4"), clips, kEvery});
        const auto expected = test::readClip(whole);
        const auto seen = test::readClip(path("joined.mp4"));
        EXPECT_EQ(seen.seconds, expected.seconds) << encoder;
        ASSERT_EQ(seen.pictures.size(), expected.pictures.size()) << encoder;
        for (std::size_t i = 0; i < seen.pictures.size(); ++i)
            EXPECT_EQ(seen.pictures[i].rgb, expected.pictures[i].rgb) << encoder << ' ' << i;
        if (encoder == std::string("mpeg4")) continue;  // its pictures tell their time
        EXPECT_EQ(digestOf(path("joined.mp4")), digestOf(whole)) << encoder;
    }
}

TEST_F(JoinTest, aPlayerSeesEachPictureAtItsTimeAcrossPieces) {
    constexpr int kPictures = kPiece + 1;  // the last piece has one picture
    const auto seen = test::readClip(filmed("whole.mp4", 0, kPictures));
    ASSERT_EQ(seen.pictures.size(), static_cast<std::size_t>(kPictures));
    for (int i = 0; i < kPictures; ++i)
        EXPECT_NEAR(seen.seconds[static_cast<std::size_t>(i)], i / 30.0, 1e-4);
    EXPECT_NEAR(seen.durationSeconds, kPictures / 30.0, 1e-3);
}

TEST_F(JoinTest, whatIsNotAsTheFirstClipIsNamed) {
    const std::string one = filmed("one.mp4", 0, 3);
    EXPECT_THAT(refusal({one, filmed("wide.mp4", 3, 6, "libx264", {64, 32})}),
                HasSubstr("wide.mp4: has another size or encoder"));
    EXPECT_THAT(refusal({one, filmed("other.mp4", 3, 6, "mpeg4")}),
                HasSubstr("other.mp4: has another size or encoder"));
    EXPECT_THAT(refusal({one, path("none.mp4")}), HasSubstr("none.mp4: cannot be read"));
    std::ofstream(path("text.mp4")) << "text";
    EXPECT_THAT(refusal({path("text.mp4")}), HasSubstr("text.mp4: cannot be read"));
    EXPECT_FALSE(std::filesystem::exists(path("joined.mp4")));
}

}  // namespace
}  // namespace aquarama::compose
