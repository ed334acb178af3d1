// SPDX-License-Identifier: Apache-2.0
// Maps of a calibrated hall against its truth, and the page that shows them.
#include "calibration/result/page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/hall/random_hall.h"
#include "calibration/hall/simulated_camera.h"
#include "calibration/result/maps.h"
#include "calibration/result/wall_of.h"
#include "common/base/statistics.h"
#include "common/formats/mpcdi.h"
#include "tests/support/source_folder.h"

namespace aquarama::result {
namespace {

// A desk in a random hall, calibrated once for all tests.
struct Calibrated {
    config::Rig rig = config::readRigAsHung(test::sourceFolder() + "/config/desk.txtpb");
    wall::Wall wall{rig};
    hall::TrueHall truth{rig, hall::randomHall(rig, 7, hall::cameraScaleFor(rig))};
    std::vector<scan::CameraView> views;
    geometry::Solved solved;
    Figures figures;
    std::string path = testing::TempDir() + "page-" + std::to_string(getpid()) + ".mpcdi";

    Calibrated() {
        rig.name = "desk <7>";
        hall::SimulatedCamera camera(truth, scan::sequenceOf(rig));
        views = {scan::decode(camera, 0, rig)};
        solved = geometry::solveHall(rig, wall, views, [](const std::string&) {});
        figures = {.verdict = judged(views, solved), .solve = solved.figures};
        const formats::WallFile file = wallFileOf(*solved.hall);
        formats::writeMpcdi(path, file, 2);
    }
    ~Calibrated() { std::filesystem::remove(path); }
};
const Calibrated& calibrated() {
    static const Calibrated one;
    return one;
}

std::vector<double> valuesOf(const Field& field) {
    std::vector<double> values;
    std::ranges::copy_if(
        field.values, std::back_inserter(values), [](double value) { return !std::isnan(value); });
    return values;
}

// What a pixel of a solved hall lights is lit by that pixel.
TEST(Maps, theSolvedHallIsTheSameBothWays) {
    const geometry::SolvedHall& hall = *calibrated().solved.hall;
    const auto fall = fallOf(hall);
    int looked = 0;
    for (int y = 20; y < 300; y += 40)
        for (int x = 20; x < 480; x += 40)
            for (std::size_t i = 0; i < hall.projectors.size(); ++i) {
                const auto place = hall.placeOf(i, {x, y});
                if (!place) continue;
                const auto back = fall->pixelOf(i, place->point);
                ASSERT_TRUE(back);
                EXPECT_LT(glm::distance(*back, glm::dvec2(x, y)), 0.01);
                ++looked;
            }
    EXPECT_GT(looked, 100);
}

// The maps' errors are those of the figures: small after the calibration, large before.
TEST(Maps, errorsAreLargeBeforeAndSmallAfter) {
    const Calibrated& it = calibrated();
    const auto fall = fallOf(it.truth);
    const glm::ivec2 panorama = it.rig.panoramaPixels, size(90, 40);
    const ErrorMaps before = errorMaps(*fall, hall::DrawnWall(it.rig), panorama, size);
    const ErrorMaps after =
        errorMaps(*fall, hall::DrawnWall(hall::withWallFile(it.rig, it.path)), panorama, size);
    EXPECT_GT(rootMeanSquare(valuesOf(before.absolute)), 5);
    EXPECT_LT(rootMeanSquare(valuesOf(after.absolute)), 1);
    EXPECT_GT(valuesOf(after.neighbours).size(), 100U);
    EXPECT_LT(largestOf(after.neighbours), 1);
    // Of the solved hall's own, only what the wall file interpolates.
    const ErrorMaps own = errorMaps(*fallOf(*it.solved.hall),
                                    hall::DrawnWall(hall::withWallFile(it.rig, it.path)),
                                    panorama,
                                    size);
    EXPECT_LT(rootMeanSquare(valuesOf(own.absolute)), 0.05);
}

// The grid of a calibrated wall is that of the panorama.
TEST(Maps, theGridIsSeenWhereItBelongs) {
    const Calibrated& it = calibrated();
    const hall::DrawnWall after(hall::withWallFile(it.rig, it.path));
    const hall::Content grid = hall::gridContent(after.wall());
    const glm::ivec2 size(270, 120);
    const Light seen = seenPanorama(*fallOf(*it.solved.hall), after, grid, size);
    double off = 0, light = 0;
    for (int y = 5; y < size.y - 5; ++y)
        for (int x = 5; x < size.x - 5; ++x) {
            const auto point =
                after.wall().screen().at((glm::dvec2(x, y) + 0.5) / glm::dvec2(size));
            ASSERT_TRUE(point);
            off += std::abs(double(seen.at(x, y).g) - double(grid(*point).g));
            light += double(grid(*point).g);
        }
    EXPECT_LT(off, 0.03 * light);
}

// By the same estimate as the figure of the whole, over the whole wall.
TEST(Maps, uncertaintyIsKnownAllOverTheWall) {
    const geometry::Solved& solved = calibrated().solved;
    const Field field{solved.uncertainty.size, solved.uncertainty.pixels};
    const std::vector<double> values = valuesOf(field);
    EXPECT_EQ(values.size(), field.values.size());
    EXPECT_GT(*std::ranges::min_element(values), 0);
    EXPECT_NEAR(rootMeanSquare(values) / solved.figures.absoluteSigma, 1, 0.3);
}

TEST(Maps, projectorsHangAsInTheTrueHall) {
    const Calibrated& it = calibrated();
    for (std::size_t i = 0; i < it.rig.channels.size(); ++i) {
        const Hang hang = hangOf(*it.solved.hall, i);
        const config::HallProjector& truth = it.truth.hall().projectors[i];
        EXPECT_LT(glm::distance(hang.movedMetres, truth.movedMetres), 0.03) << i;
        EXPECT_NEAR(hang.turnedRadians.z, truth.turnedRadians.z, 0.005) << i;
    }
}

// Without the bytes of pictures, in which any letters may stand.
std::string withoutPictures(std::string html) {
    const std::string begin = "data:image/png;base64,";
    for (std::size_t at = html.find(begin); at != std::string::npos; at = html.find(begin, at))
        html.erase(at, html.find('"', at) - at);
    return html;
}

TEST(Page, saysAllThatACrewAsksForAndNeedsNoOtherFile) {
    const Calibrated& it = calibrated();
    const std::string html = withoutPictures(htmlOf({.figures = it.figures,
                                                     .solved = it.solved,
                                                     .views = it.views,
                                                     .truth = &it.truth,
                                                     .wallFile = it.path}));
    for (const char* title : {"Calibration of desk &lt;7&gt;",
                              ">pass<",
                              "Figures",
                              "The camera&#39;s view",
                              "Before and after",
                              "Where neighbours part",
                              "Where the picture lies beside its place",
                              "How well the place is known",
                              "Who lights what",
                              "Brightness through the seams",
                              "The screen beside its shape in the rig",
                              "How the projectors hang"})
        EXPECT_THAT(html, testing::HasSubstr(title));
    for (const char* other : {"http", "src=", "url(", "<script", "nan", "<7>"})
        EXPECT_EQ(html.find(other), std::string::npos) << other;
}

// Of a scan that is refused there are the cause and what the camera saw.
TEST(Page, saysWhyACalibrationIsRefused) {
    const Calibrated& it = calibrated();
    const Figures refused{.verdict = {Judgement::Refuse, "no_overlap", "let neighbours overlap"},
                          .solve = {}};
    const std::string html = htmlOf({.figures = refused, .solved = it.solved, .views = it.views});
    EXPECT_THAT(html, testing::HasSubstr("refuse: no_overlap"));
    EXPECT_THAT(html, testing::HasSubstr("let neighbours overlap. No wall file was written"));
    EXPECT_THAT(html, testing::HasSubstr("camera&#39;s view"));
    EXPECT_THAT(html, testing::Not(testing::HasSubstr("Before and after")));
}

}  // namespace
}  // namespace aquarama::result
