// SPDX-License-Identifier: Apache-2.0
// Pictures that would harm whoever decodes them: the confined decoder refuses them, or dies alone.
#include "tests/drawings/decoder.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <new>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/base/hash.h"
#include "common/body/side_view.h"
#include "common/wire/messages.h"
#include "drawings/bleed.h"
#include "drawings/confine.h"
#include "tests/drawings/sample_photos.h"

namespace aquarama {
namespace {

std::string noise(std::size_t bytes) {
    std::string text;
    for (std::uint32_t i = 0; text.size() < bytes; ++i)
        text += static_cast<char>(hashOf(i) & 0xffU);
    return text;
}

std::string jpegOfGradient() {
    return test::textOf(test::jpegOf(test::gradient(), 90));
}

// Its header says another size.
std::string jpegBomb(int pixelsEachWay) {
    std::string jpeg = jpegOfGradient();
    const std::size_t frame = jpeg.find("\xff\xc0");
    for (const std::size_t at : {frame + 5, frame + 7}) {
        jpeg[at] = static_cast<char>(pixelsEachWay >> 8);
        jpeg[at + 1] = static_cast<char>(pixelsEachWay & 0xff);
    }
    return jpeg;
}

// As large as a picture may be, in a few kilobytes.
std::string pngBomb() {
    constexpr glm::ivec2 kSize{7000, 7000};
    const PngPicture black{
        .sizePixels = kSize,
        .components = 1,
        .codes = std::vector<std::uint16_t>(std::size_t{kSize.x} * std::size_t{kSize.y})};
    return test::textOf(encodePng(black, PngMeaning::Srgb));
}

TEST(Decoder, refusesBombsDamageAndNoise) {
    ask::DrawingReader reader(test::decoderProgram(), test::kDecoderSeconds);
    const auto word = [&](const std::string& picture) {
        return test::wordOf(test::outcomeOf(reader, picture));
    };
    EXPECT_EQ(word(jpegOfGradient()), "no_sheet");
    EXPECT_EQ(word(jpegBomb(65000)), "too_large");
    EXPECT_EQ(word(jpegBomb(7000)), "not_a_picture") << "its data end early";
    EXPECT_EQ(word(pngBomb()), "no_sheet");
    EXPECT_EQ(word(jpegOfGradient().substr(0, 900)), "not_a_picture");
    EXPECT_EQ(word(noise(100'000)), "not_a_picture");
    EXPECT_EQ(word("\xff\xd8\xff" + noise(100'000)), "not_a_picture");
    EXPECT_EQ(word(""), "not_a_picture");
    EXPECT_EQ(word(std::string(ask::kMostPictureBytes, 'x')), "not_a_picture");
    EXPECT_EQ(word(std::string(ask::kMostPictureBytes + 1, 'x')), "not taken");
}

TEST(Decoder, aSkinOfNoiseFitsTheWire) {
    PngPicture skin{.sizePixels = body::kSideTexels, .components = 4, .codes = {}};
    const std::string codes =
        noise(static_cast<std::size_t>(4 * skin.sizePixels.x * skin.sizePixels.y));
    for (std::size_t i = 0; i < codes.size(); ++i)
        skin.codes.push_back(i % 4 == 3 ? 255 : static_cast<unsigned char>(codes[i]));
    EXPECT_LE(encodePng(skin, PngMeaning::Srgb).size(), wire::kMostSkinBytes);
}

TEST(Decoder, coloursGoOnBeyondTheOutline) {
    PngPicture skin{.sizePixels = {64, 32}, .components = 4, .codes = {}};
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            const bool isLeft = x < 8, isRight = x >= 56;
            const std::array<int, 4> texel{
                isLeft ? 200 : 0, isRight ? 100 : 0, 0, isLeft || isRight ? 255 : 0};
            skin.codes.insert(skin.codes.end(), texel.begin(), texel.end());
        }
    const PngPicture before = skin;
    drawings::bleed(skin, 0);
    const auto at = [&](int x, int c) {
        return skin.codes[static_cast<std::size_t>(4 * (16 * 64 + x) + c)];
    };
    EXPECT_GE(at(9, 0), 190) << "as its neighbour";
    EXPECT_GE(at(54, 1), 95);
    EXPECT_GT(at(24, 0), at(40, 0)) << "from one side to the other";
    EXPECT_LT(at(24, 1), at(40, 1));
    for (std::size_t i = 0; i < skin.codes.size(); i += 4) {
        EXPECT_EQ(skin.codes[i + 3], before.codes[i + 3]);
        const bool isKept = before.codes[i + 3] != 0;
        EXPECT_TRUE(!isKept || skin.codes[i] == before.codes[i]);
    }
}

// A white fish with a grey line along its outline, half of which lies within.
TEST(Decoder, theLineAlongTheOutlineIsNoColourOfTheDrawing) {
    PngPicture skin{.sizePixels = {64, 32}, .components = 4, .codes = {}};
    const auto isIn = [](int x, int y, int by) {
        return x >= 8 + by && x < 56 - by && y >= 8 + by && y < 24 - by;
    };
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            const std::uint16_t code = isIn(x, y, 2) ? 250 : 163;
            const std::uint16_t alpha = isIn(x, y, 0) ? 255 : 0;
            skin.codes.insert(skin.codes.end(), {code, code, code, alpha});
        }
    drawings::bleed(skin, 3.4);
    for (std::size_t i = 0; i < skin.codes.size(); i += 4)
        EXPECT_EQ(skin.codes[i], 250) << i / 4 % 64 << ' ' << i / 4 / 64;
}

class Confined : public testing::Test {
  protected:
    void SetUp() override {
        if (drawings::kIsSanitized) GTEST_SKIP() << "a sanitizer asks the kernel for more";
    }
};

// How a process ends that does something when it is confined: its status, or minus the signal that
// has killed it.
int endOf(const std::function<int()>& job) {
    const pid_t child = fork();
    if (child == 0) {
        drawings::confine();
        _exit(job());
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

TEST_F(Confined, readsWritesAndTakesMemoryOnly) {
    EXPECT_EQ(endOf([] {
                  std::vector<char> memory(100'000'000, 'x');
                  return write(STDOUT_FILENO, "", 0) == 0 && memory.back() == 'x' ? 7 : 1;
              }),
              7);
    EXPECT_EQ(endOf([] {
                  try {
                      std::vector<char> memory(std::size_t{2'000'000'000});
                      return static_cast<int>(memory[1]);
                  } catch (const std::bad_alloc&) {
                      return 7;
                  }
              }),
              7);
    EXPECT_EQ(endOf([] { return std::fprintf(stderr, "x"), 7; }), -SIGSYS);
}

TEST_F(Confined, whateverElseItAsksForKillsIt) {
    const int other = open("/dev/zero", O_RDONLY);
    char* const nothing[] = {nullptr};
    const std::vector<std::pair<const char*, std::function<int()>>> attempts{
        {"open", [] { return open("/etc/passwd", O_RDONLY); }},
        {"socket", [] { return socket(AF_INET, SOCK_STREAM, 0); }},
        {"socket of this machine", [] { return socket(AF_UNIX, SOCK_STREAM, 0); }},
        {"exec", [&] { return execve("/bin/true", nothing, nothing); }},
        {"fork", [] { return static_cast<int>(fork()); }},
        {"kill", [] { return kill(getppid(), SIGTERM); }},
        {"another file",
         [&] {
             char byte = 0;
             return static_cast<int>(read(other, &byte, 1));
         }},
        {"unlink", [] { return unlink("/tmp/aquarama-there-is-no-such-file"); }},
        {"code in memory",
         [] {
             return mmap(nullptr,
                         4096,
                         PROT_READ | PROT_WRITE | PROT_EXEC,
                         MAP_PRIVATE | MAP_ANONYMOUS,
                         -1,
                         0) == MAP_FAILED
                        ? 1
                        : 0;
         }},
        {"another confinement", [] { return drawings::confine(), 0; }}};
    for (const auto& [what, attempt] : attempts) EXPECT_EQ(endOf(attempt), -SIGSYS) << what;
    close(other);
}

}  // namespace
}  // namespace aquarama
