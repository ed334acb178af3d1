// SPDX-License-Identifier: Apache-2.0
#include "tests/support/golden.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "common/base/picture.h"
#include "tests/support/source_folder.h"

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

Picture enlargedDifference(const Picture& a, const Picture& b) {
    constexpr int kTimes = 8;
    Picture picture{a.sizePixels, 8, {}};
    for (const int code : differences(a, b))
        picture.rgb.push_back(static_cast<std::uint16_t>(std::min(kTimes * code, 255)));
    return picture;
}

}  // namespace

CodeDifference codeDifference(const Picture& a, const Picture& b) {
    std::vector<int> codes = differences(a, b);
    const double mean =
        std::accumulate(codes.begin(), codes.end(), 0.0) / static_cast<double>(codes.size());
    const auto rank = static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(codes.size()));
    std::nth_element(codes.begin(), codes.begin() + rank, codes.end());
    return {mean, static_cast<double>(codes[static_cast<std::size_t>(rank)])};
}

std::string goldenPath(const std::string& name) {
    return sourceFolder() + "/tests/golden/" + name + ".png";
}

void expectGolden(const Picture& picture, const std::string& name, const GoldenLimits& limits) {
    const fs::path path = goldenPath(name);
    if (std::getenv("AQUARAMA_UPDATE_GOLDEN") != nullptr) {
        fs::create_directories(path.parent_path());
        return writePng(path.string(), picture);
    }
    ASSERT_TRUE(fs::exists(path)) << path << " is missing: draw it with AQUARAMA_UPDATE_GOLDEN=1";
    const Picture golden = readPng(path.string());
    ASSERT_EQ(golden.sizePixels, picture.sizePixels) << name;
    const CodeDifference apart = codeDifference(picture, golden);
    EXPECT_LE(apart.meanCodes, limits.meanCodes) << name;
    EXPECT_LE(apart.percentile999Codes, limits.percentile999Codes) << name;
    if (apart.within(limits)) return;
    ADD_FAILURE() << "compare " << path << " with " << leave(picture, name, "actual") << " and "
                  << leave(enlargedDifference(picture, golden), name, "difference");
}

}  // namespace aquarama::test
