// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/report.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "master/capture/report/fish_view.h"
#include "tests/support/scad.h"

namespace aquarama {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

TEST(Report, everyPictureOfThePageIsThereAndWhole) {
    const fs::path folder = fs::path(testing::TempDir()) / "aquarama_report";
    const std::string page = contentOf(writeReport(scadRepertoire(), makeBody(scad()), folder));
    int pictures = 0;
    for (std::size_t at = 0; (at = page.find("src=\"", at)) != std::string::npos; ++pictures) {
        at += 5;
        const std::string svg = contentOf(folder / page.substr(at, page.find('"', at) - at));
        EXPECT_TRUE(svg.starts_with("<svg"));
        EXPECT_TRUE(svg.ends_with("</svg>\n"));
        EXPECT_EQ(svg.find("nan"), std::string::npos);
    }
    EXPECT_EQ(pictures, kActions + 3);
    fs::remove_all(folder);
}

TEST(FishView, aLeftTurnBendsTheTailToTheLeftOfThePaper) {
    const FishBody body = makeBody(scad());
    const auto phases = replay(segmentOf(Action::TurnLeftSharp), 1);
    const FishView start = viewFromAbove(body, phases.front());
    const auto reach = [](const FishView& view) {
        return std::ranges::max(view.outline, {}, &glm::dvec2::x).x -
               std::ranges::min(view.outline, {}, &glm::dvec2::x).x;
    };
    EXPECT_NEAR(reach(start), 0.92, 0.05) << "to the fork of the tail";
    // Up on the paper is to the left of a fish that heads to the right.
    EXPECT_LT(viewFromAbove(body, phases.back()).outline.front().y, -0.5);
}

}  // namespace
}  // namespace aquarama
