// SPDX-License-Identifier: Apache-2.0
// Clips as a player sees them: every picture, when it is shown, and with which colours.
#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "calibration/compose/clip.h"
#include "calibration/compose/film.h"
#include "common/base/log.h"
#include "common/config/rig.h"
#include "common/net/channels.h"
#include "tests/support/read_clip.h"

namespace aquarama::compose {
namespace {

namespace fs = std::filesystem;
using test::meanCodesBetween;
using test::readClip;

class ClipTest : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }

    fs::path folder_ = fs::path(testing::TempDir()) / ("aquarama-clip-" + std::to_string(getpid()));
};

// Smooth, in all colours, and with each step of time another.
Picture pictureAt(glm::ivec2 size, int step) {
    Picture picture{size, 8, {}};
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (const double phase : {0.0, 2.1, 4.2}) {
                const double wave = std::sin(0.02 * x + 0.03 * y + 0.3 * step + phase);
                picture.rgb.push_back(static_cast<std::uint16_t>(128 + 100 * wave));
            }
    return picture;
}

void writeSteps(Clip& clip, glm::ivec2 size, int count, int ticksBetween) {
    for (int i = 0; i < count; ++i)
        clip.add(pictureAt(size, i), static_cast<std::uint64_t>(600 + i * ticksBetween));
    clip.finish();
}

TEST_F(ClipTest, everyEncoderKeepsNumberSizeTimeAndColours) {
    constexpr glm::ivec2 kSize(160, 90);
    for (const char* encoder : videoEncoders()) {
        const std::string file = path(std::string(encoder) + ".mp4");
        const std::array only{encoder};
        writeSteps(*makeVideo({file, kSize, 1}, only), kSize, 12, 1);
        const auto seen = test::readClip(file);
        ASSERT_EQ(seen.pictures.size(), 12U) << encoder;
        EXPECT_EQ(seen.sizePixels, kSize);
        EXPECT_NEAR(seen.durationSeconds, 12 / 60.0, 1e-3) << encoder;
        for (std::size_t i = 0; i < 12; ++i) {
            EXPECT_NEAR(seen.seconds[i], static_cast<double>(i) / 60, 1e-3);
            EXPECT_LT(
                test::meanCodesBetween(seen.pictures[i], pictureAt(kSize, static_cast<int>(i))), 3)
                << encoder << ", picture " << i;
        }
    }
}

TEST_F(ClipTest, theFirstEncoderThatThereIsIsTaken) {
    const std::array unknownFirst{"no_such_encoder", "mpeg4"};
    writeSteps(*makeVideo({path("a.mp4"), {32, 32}, 1}, unknownFirst), {32, 32}, 3, 1);
    EXPECT_EQ(test::readClip(path("a.mp4")).codec, "mpeg4");
    writeSteps(*makeClip({path("b.mp4"), {32, 32}, 1}), {32, 32}, 3, 1);
    EXPECT_EQ(test::readClip(path("b.mp4")).codec, "h264");
}

TEST_F(ClipTest, withoutAnyEncoderItSaysWhatItTried) {
    const std::array none{"no_such_encoder", "nor_this"};
    try {
        (void)makeVideo({path("a.mp4"), {32, 32}, 1}, none);
        FAIL() << "made a clip of nothing";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("no_such_encoder, nor_this"));
    }
    EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(ClipTest, anOddSizeKeepsEveryPixelAndRepeatsItsBorder) {
    constexpr glm::ivec2 kSize(81, 45);
    writeSteps(*makeClip({path("odd.mp4"), kSize, 1}), kSize, 4, 1);
    const auto seen = test::readClip(path("odd.mp4"));
    EXPECT_EQ(seen.sizePixels, glm::ivec2(82, 46));
    EXPECT_LT(test::meanCodesBetween(seen.pictures.at(3), pictureAt(kSize, 3)), 3);
}

TEST_F(ClipTest, everyThirdFrameIsShownForThreeTicks) {
    writeSteps(*makeClip({path("slow.mp4"), {64, 48}, 3}), {64, 48}, 10, 3);
    const auto seen = test::readClip(path("slow.mp4"));
    ASSERT_EQ(seen.pictures.size(), 10U);
    EXPECT_NEAR(seen.seconds[9], 27 / 60.0, 1e-3);
    EXPECT_NEAR(seen.durationSeconds, 30 / 60.0, 1e-3);
}

TEST_F(ClipTest, aPlayerFindsTheIndexBeforeThePictures) {
    writeSteps(*makeClip({path("a.mp4"), {64, 48}, 1}), {64, 48}, 10, 1);
    std::ifstream file(path("a.mp4"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
}

TEST_F(ClipTest, whatIsNotFinishedLeavesNoFile) {
    {
        const auto clip = makeClip({path("a.mp4"), {64, 48}, 1});
        clip->add(pictureAt({64, 48}, 0), 0);
    }
    EXPECT_TRUE(fs::is_empty(folder_));
}

// A player reads a pipe as it comes: the index cannot be written at the beginning afterwards.
TEST_F(ClipTest, goesThroughAPipe) {
    constexpr glm::ivec2 kSize(64, 48);
    for (const char* name : {"a.mp4", "a.webp"}) {
        const std::string pipe = path("pipe." + std::string(name).substr(2)), file = path(name);
        ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
        std::jthread reader([&] {
            std::ofstream(file, std::ios::binary) << std::ifstream(pipe, std::ios::binary).rdbuf();
        });
        writeSteps(*makeClip({pipe, kSize, 1}), kSize, 12, 1);
        reader.join();
        EXPECT_TRUE(fs::is_fifo(pipe));
        EXPECT_GT(fs::file_size(file), 500U) << name;
    }
    const auto seen = readClip(path("a.mp4"));
    ASSERT_EQ(seen.pictures.size(), 12U);
    EXPECT_LT(meanCodesBetween(seen.pictures[5], pictureAt(kSize, 5)), 3);
}

TEST_F(ClipTest, aDiskThatIsFullLeavesTheOldClipAndNoPart) {
    std::signal(SIGXFSZ, SIG_IGN);  // NOLINT(cert-err33-c): it was at its default
    for (const char* name : {"a.mp4", "a.webp"}) {
        const std::string file = path(name);
        std::ofstream(file) << "old";
        rlimit before{};
        getrlimit(RLIMIT_FSIZE, &before);
        const rlimit full{.rlim_cur = 1000, .rlim_max = before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &full);
        try {
            writeSteps(*makeClip({file, {160, 90}, 1}), {160, 90}, 12, 1);
            ADD_FAILURE() << "there was room for " << name;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(file + ": cannot be written (File too"));
        }
        setrlimit(RLIMIT_FSIZE, &before);
        EXPECT_EQ(fs::file_size(file), 3U);
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2);
}

TEST_F(ClipTest, aPathThatCannotBeAndAnEndingThatIsUnknownAreNamed) {
    for (const char* name : {"/proc/nowhere/a.mp4", "/proc/nowhere/a.webp"})
        EXPECT_THROW((void)makeClip({name, {32, 32}, 1}), Error) << name;
    try {
        (void)makeClip({path("a.avi"), {32, 32}, 1});
        FAIL() << "took another ending";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("FILE.mp4 or FILE.webp"));
    }
}

// What each channel of a rig sends, and the clip that comes of it.
class FilmTest : public ClipTest {
  protected:
    // Frame numbers that each channel sends before it ends.
    void filmed(const Filming& filming, const std::vector<std::vector<std::uint64_t>>& frames) {
        std::vector<std::thread> nodes;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const fs::path socket = net::frameSocket(folder_, rig_.channels[i].name);
            nodes.emplace_back([socket, sent = frames[i], size = rig_.channels[i].sizePixels] {
                try {
                    const auto sender = net::connectFrames(socket);
                    for (const std::uint64_t frame : sent)
                        sender->send(
                            {frame, size.x, size.y, pictureAt(size, static_cast<int>(frame)).rgb});
                } catch (const Error&) {
                    return;  // the film ended before the node: what a test may be about
                }
            });
        }
        try {
            film(rig_, filming);
        } catch (...) {
            for (std::thread& node : nodes) node.join();
            throw;
        }
        for (std::thread& node : nodes) node.join();
    }
    [[nodiscard]] Filming filmingOf(const std::string& of) const {
        return {.of = of,
                .pipes = folder_,
                .clipPath = path("clip.mp4"),
                .ticksBetween = 1,
                .frames = {},
                .firstPictures = {}};
    }

    config::Rig rig_ = config::readRig(AQUARAMA_SOURCE_DIR "/config/desk.txtpb");
};

TEST_F(FilmTest, aChannelIsShownAsItIs) {
    filmed(filmingOf("left"), {{0, 1, 2}});
    const auto seen = test::readClip(path("clip.mp4"));
    ASSERT_EQ(seen.pictures.size(), 3U);
    EXPECT_LT(test::meanCodesBetween(seen.pictures[2], pictureAt(rig_.channels[0].sizePixels, 2)),
              3);
}

TEST_F(FilmTest, thePanoramaHasTheFramesThatAllChannelsSent) {
    filmed(filmingOf(kPanorama), {{0, 1, 2}, {0, 1, 2}, {0, 1}});
    const auto seen = test::readClip(path("clip.mp4"));
    EXPECT_EQ(seen.pictures.size(), 2U);
    EXPECT_EQ(seen.sizePixels, rig_.panoramaPixels);
}

TEST_F(FilmTest, channelsThatSendOtherFramesAreNamed) {
    EXPECT_THROW(filmed(filmingOf(kPanorama), {{0}, {1}, {0}}), Error);
}

TEST_F(FilmTest, noFrameIsNoClip) {
    EXPECT_THROW(filmed(filmingOf("left"), {{}}), Error);
    EXPECT_FALSE(fs::exists(path("clip.mp4")));
}

}  // namespace
}  // namespace aquarama::compose
