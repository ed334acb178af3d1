// SPDX-License-Identifier: Apache-2.0
// What three projectors throw adds up to one wall: the grid's lines are where a direct render has
// them, and grey is flat, overlaps included.
#include <cmath>

#include <gtest/gtest.h>

#include "calibration/theatre/compose.h"
#include "calibration/theatre/measure.h"
#include "calibration/theatre/projected.h"
#include "common/config/rig.h"

namespace aquarama {
namespace {

Rig shippedRig(const std::string& name) {
    return readRig(AQUARAMA_SOURCE_DIR "/config/" + name + ".txtpb");
}

Light composed(const Rig& rig, Pattern pattern, int bits) {
    std::vector<Light> channels;
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        channels.push_back(lightOf(projectedPicture(rig, i, pattern, bits)));
    return composePanorama(rig, channels);
}

double largest(const std::vector<LineOffset>& offsets) {
    double worst = 0;
    for (const LineOffset& line : offsets) worst = std::max(worst, std::abs(line.offsetPixels));
    return worst;
}

class OneWall : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped, OneWall, testing::Values("theatre", "touring", "desk"));

TEST_P(OneWall, everyLineOfTheGridIsWithinHalfAPanoramaPixel) {
    const Rig rig = shippedRig(GetParam());
    for (const int bits : {16, 8}) {
        const auto offsets = lineOffsets(
            rig, composed(rig, Pattern::Grid, bits), directPanorama(rig, Pattern::Grid));
        EXPECT_GT(offsets.size(), 5000U);
        EXPECT_LT(largest(offsets), 0.5) << bits << " bits";
        RecordProperty("worst" + std::to_string(bits), std::to_string(largest(offsets)));
        std::printf("%s %d %g\n", rig.name.c_str(), bits, largest(offsets));
    }
}

TEST_P(OneWall, greyIsFlatInLinearLightToOnePerCent) {
    const Rig rig = shippedRig(GetParam());
    EXPECT_LT(unevenness(composed(rig, Pattern::Grey, 16), 1), 0.01);
    EXPECT_LT(unevenness(composed(rig, Pattern::Grey, 8), 16), 0.01);
    std::printf("%s %g %g\n",
                rig.name.c_str(),
                unevenness(composed(rig, Pattern::Grey, 16), 1),
                unevenness(composed(rig, Pattern::Grey, 8), 16));
}

}  // namespace
}  // namespace aquarama
