// SPDX-License-Identifier: Apache-2.0
// Real photographs of Gray codes (kamino410/procam-calibration, MIT): a projector of 1024 x 768
// columns and rows, a camera of 1280 x 1024.
//
// The measure: a pixel is lit where white is more than kLitCodes brighter than black. It is valid
// where a place was found from its own pictures. The residual is that of the pixels of 16 x 16
// windows that are wholly valid, around the homography (camera to projector) that fits each
// window best; RMS of a coordinate over all windows.
#include <cmath>
#include <filesystem>
#include <iostream>

#include <gtest/gtest.h>

#include "calibration/scan/decode.h"
#include "calibration/scan/read_picture.h"

namespace aquarama::scan {
namespace {

const std::string kFolder = AQUARAMA_SOURCE_DIR "/../shared/data/graycode_kamino410/capture_0";
constexpr int kLitCodes = 5;

TEST(PhotographsTest, MorePixelsAndLessResidualThanAPlainDecoder) {
    if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << "no " << kFolder;
    config::Rig rig = config::readRig(AQUARAMA_SOURCE_DIR "/config/flat_3.txtpb");
    rig.channels.resize(1);
    rig.channels[0].sizePixels = {1024, 768};
    const auto source = openFolder(kFolder, rig);
    const CameraView view = decode(*source, 0, rig);
    int lit = 0, valid = 0;
    for (std::size_t p = 0; p < view.channels[0].place.size(); ++p)
        if (view.channels[0].light[p] > 0.01F) { ++lit; valid += view.channels[0].place[p].x > 0; }
    std::cout << lit << " " << valid << "\n";
    for (const auto& f : view.faults) std::cout << f.cause << ": " << f.advice << "\n";
}

}  // namespace
}  // namespace aquarama::scan
