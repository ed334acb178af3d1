// SPDX-License-Identifier: Apache-2.0
#include "tests/support/golden.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "common/wall/png_file.h"

namespace aquarama::test {

namespace {

namespace fs = std::filesystem;

std::vector<int> differences(const Picture& a, const Picture& b) {
    std::vector<int> codes(a.rgb.size());
    std::ranges::transform(
        a.rgb, b.rgb, codes.begin(), [](int x, int y) { return std::abs(x - y); });
    return codes;
}

fs::path leave(const Picture& picture, const std::string& name, const char* kind) {
    const fs::path path = fs::path("golden") / (name + "." + kind + ".png");
    fs::create_directories(path.parent_path());
    writePng(path.string(), picture);
    return fs::absolute(path);
}

Picture enlarged(const std::vector<int>& codes, const Picture& like) {
    constexpr int kTimes = 8;
    Picture picture{like.sizePixels, 8, {}};
    for (const int code : codes)
        picture.rgb.push_back(static_cast<std::uint16_t>(std::min(kTimes * code, 255)));
    return picture;
}

}  // namespace

void expectGolden(const Picture& picture, const std::string& name, const GoldenLimits& limits) {
    const fs::path path = fs::path(AQUARAMA_SOURCE_DIR "/tests/golden") / (name + ".png");
    if (std::getenv("AQUARAMA_UPDATE_GOLDEN") != nullptr) {
        fs::create_directories(path.parent_path());
        return writePng(path.string(), picture);
    }
    ASSERT_TRUE(fs::exists(path)) << path << " is missing: draw it with AQUARAMA_UPDATE_GOLDEN=1";
    const Picture golden = readPng(path.string());
    ASSERT_EQ(golden.sizePixels, picture.sizePixels) << name;
    std::vector<int> codes = differences(picture, golden);
    const Picture shown = enlarged(codes, picture);
    const double mean =
        std::accumulate(codes.begin(), codes.end(), 0.0) / static_cast<double>(codes.size());
    const auto rank = static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(codes.size()));
    std::nth_element(codes.begin(), codes.begin() + rank, codes.end());
    const double percentile = codes[static_cast<std::size_t>(rank)];
    EXPECT_LE(mean, limits.meanCodes) << name;
    EXPECT_LE(percentile, limits.percentile999Codes) << name;
    if (mean <= limits.meanCodes && percentile <= limits.percentile999Codes) return;
    ADD_FAILURE() << "compare " << path << " with " << leave(picture, name, "actual") << " and "
                  << leave(shown, name, "difference");
}

}  // namespace aquarama::test
