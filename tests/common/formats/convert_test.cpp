// SPDX-License-Identifier: Apache-2.0
// Whatever is read says the same after it was written as MPCDI: `aquarama convert`, of every file
// that we have of others and of small ones of every format.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/formats/mpcdi.h"
#include "common/formats/wall_file.h"
#include "tests/common/formats/vendor_samples.h"

namespace aquarama::formats {
namespace {

namespace fs = std::filesystem;

const fs::path kData = AQUARAMA_SOURCE_DIR "/../shared/data";
const ReadOptions kReading{.sizePixels = glm::ivec2(480, 270)};  // of those that do not say it

// The largest difference of two warps, in pixels of the picture; of points in space in metres.
double apart(const FileChannel& one, const FileChannel& other, Profile profile) {
    double worst = 0;
    const glm::ivec2 size = one.sizePixels;
    for (int y = 0; y < size.y; y += 3)
        for (int x = 0; x < size.x; x += 3) {
            const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) / glm::dvec2(size);
            const glm::dvec3 a = warpAt(*one.warp, place), b = warpAt(*other.warp, place);
            EXPECT_EQ(std::isnan(a.x), std::isnan(b.x)) << one.name << ' ' << x << ' ' << y;
            if (std::isnan(a.x) || std::isnan(b.x)) continue;
            const glm::dvec3 scale =
                profile == Profile::Screen ? glm::dvec3(1) : glm::dvec3(size, 0);
            worst = std::max(worst, glm::length((a - b) * scale));
        }
    return worst;
}

void expectSameAfterConversion(WallFile file, const std::string& name) {
    for (FileChannel& channel : file.channels)
        if (channel.warp) channel.warp = resampled(*channel.warp, channel.sizePixels);
    for (const int version : {1, 2}) {
        const WallFile again = readMpcdi(encodeMpcdi(file, version), name);
        ASSERT_EQ(again.channels.size(), file.channels.size()) << name;
        EXPECT_EQ(again.profile, file.profile) << name;
        for (std::size_t i = 0; i < file.channels.size(); ++i) {
            const FileChannel& before = file.channels[i];
            const FileChannel& after = again.channels[i];
            ASSERT_EQ(before.warp.has_value(), after.warp.has_value()) << name;
            if (before.warp) {
                const double off = apart(before, after, file.profile);
                EXPECT_LT(off, file.profile == Profile::Screen ? 1e-6 : 0.02) << name;
            }
            EXPECT_EQ(before.blend.has_value(), after.blend.has_value()) << name;
        }
    }
}

TEST(Convert, everyFormatSaysTheSameAsMpcdi) {
    const SampleVioso blended{.blocks = 3, .flags = 0x20, .blackScale = 0.5F};
    const std::vector<SampleBytes> samples{
        vioso({}),
        vioso({.points = true}),
        vioso(blended, {viosoBitmap(24, false, 99), viosoBitmap(128, true, 0x3e4ccccd)}),
        sciss(),
        bytesOf(kScalable),
        bytesOf(kDomeprojection),
        bytesOf(kSimcad),
        bytesOf(kPaulBourke),
        bytesOf(kObj)};
    for (std::size_t i = 0; i < samples.size(); ++i) try {
            expectSameAfterConversion(readWallFile(samples[i], "sample", kReading),
                                      "sample " + std::to_string(i));
        } catch (const Error& error) {
            ADD_FAILURE() << i << ": " << error.what();
        }
}

// All of the data but what is no wall file: clusters of other programs, pictures, lists of cameras.
TEST(Convert, everyFileOfOthersIsReadAndSaysTheSameAsMpcdi) {
    if (!fs::is_directory(kData)) GTEST_SKIP() << "there are no files of others here";
    int read = 0;
    for (const auto& entry : fs::recursive_directory_iterator(kData)) {
        const std::string path = entry.path().string();
        const std::string ending = entry.path().extension().string();
        const bool isWallFile = ending == ".mpcdi" || ending == ".sgc" || ending == ".simcad" ||
                                ending == ".csv" || ending == ".data" || ending == ".pfm";
        if (!isWallFile) continue;
        try {
            expectSameAfterConversion(readWallFile(path, kReading), path);
            ++read;
        } catch (const Error& error) {
            ADD_FAILURE() << error.what();
        }
    }
    EXPECT_GE(read, 20);
}

}  // namespace
}  // namespace aquarama::formats
