// SPDX-License-Identifier: Apache-2.0
// The file of a scan says the same again after it was written and read, and a mistake is refused at
// its place.
#include "common/config/scan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"

namespace aquarama::config {
namespace {

using testing::HasSubstr;

const std::vector<std::string> kScanChannels{"left", "right"};

Scan someScan() {
    Scan scan{.rig = "desk",
              .cameras = {{.response = ScanCamera::Response::Linear, .focalPixels = 1234.5}, {}},
              .pictures = {}};
    using Kind = ScanPattern::Kind;
    for (const Kind kind : {Kind::Level,
                            Kind::GrayColumns,
                            Kind::GrayRows,
                            Kind::PhaseColumns,
                            Kind::PhaseRows,
                            Kind::Room,
                            Kind::Dots})
        scan.pictures.push_back({.file = "picture.png",
                                 .camera = 1,
                                 .exposureSeconds = 0.125,
                                 .frame = 4711,
                                 .pattern = {.kind = kind,
                                             .step = 3,
                                             .finestPixels = 8,
                                             .inverse = true,
                                             .light = {1, 0.5F, 0},
                                             .lit = 2,
                                             .number = 77,
                                             .tagged = false}});
    return scan;
}

TEST(Scan, saysTheSameAfterWritingAndReading) {
    const Scan scan = someScan();
    const Scan again = parseScan(textOf(scan, kScanChannels), "scan.txtpb", kScanChannels);
    EXPECT_EQ(again.rig, scan.rig);
    ASSERT_EQ(again.cameras.size(), 2U);
    EXPECT_EQ(again.cameras[0].response, ScanCamera::Response::Linear);
    EXPECT_EQ(again.cameras[0].focalPixels, 1234.5);
    EXPECT_EQ(again.cameras[1].response, ScanCamera::Response::Srgb);
    ASSERT_EQ(again.pictures.size(), scan.pictures.size());
    for (std::size_t i = 0; i < scan.pictures.size(); ++i) {
        EXPECT_EQ(again.pictures[i].file, "picture.png");
        EXPECT_EQ(again.pictures[i].camera, 1U);
        EXPECT_EQ(again.pictures[i].exposureSeconds, 0.125);
        EXPECT_EQ(again.pictures[i].frame, 4711U);
        EXPECT_EQ(again.pictures[i].pattern, scan.pictures[i].pattern);
    }
}

struct ScanMistake {
    std::string from, to, message;
};
class ScanMistakes : public testing::TestWithParam<ScanMistake> {};

TEST_P(ScanMistakes, areRefusedAtTheirPlace) {
    std::string text = textOf(someScan(), kScanChannels);
    const auto at = text.find(GetParam().from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, GetParam().from.size(), GetParam().to);
    try {
        (void)parseScan(text, "scan.txtpb", kScanChannels);
        FAIL() << "was read";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("scan.txtpb:"));
        EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Each,
    ScanMistakes,
    testing::Values(ScanMistake{"\"right\"", "\"middle\"", "no channel \"middle\""},
                    ScanMistake{"picture.png", "../picture.png", "not the name of a file"},
                    ScanMistake{"picture.png", "a/b.png", "not the name of a file"},
                    ScanMistake{"camera: 1", "camera: 2", "there are 2 cameras"},
                    ScanMistake{"light: 0.5", "", "light has three values"},
                    ScanMistake{"light: 0.5", "light: 1.5", "light is from 0 to 1"},
                    ScanMistake{"version: 1", "version: 2", "version"}));

}  // namespace
}  // namespace aquarama::config
