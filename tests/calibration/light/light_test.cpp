// SPDX-License-Identifier: Apache-2.0
// Parts of what evens light and colour, against closed forms and published values.
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "calibration/light/brightness.h"
#include "calibration/light/level_samples.h"
#include "calibration/light/photometry.h"
#include "calibration/light/seams.h"

namespace aquarama::light {
namespace {

TEST(RisingCurve, isExactOnStraightLinesAndGoesOnBeforeThem) {
    const std::vector<double> curve =
        risingCurve({{1, 2}, {2, 4}, {5, 10}}, {0, 0.5, 1, 1.7, 4, 5});
    const std::vector<double> wanted{0, 1, 2, 3.4, 8, 10};
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(curve[i], wanted[i], 1e-12);
}

TEST(RisingCurve, risesBetweenStepsAndMeetsItsPoints) {
    const std::vector<glm::dvec2> points{{0, 0}, {1, 0.01}, {1.2, 0.9}, {3, 1}};
    std::vector<double> at;
    for (int i = 0; i <= 300; ++i) at.push_back(0.01 * i);
    const std::vector<double> curve = risingCurve(points, at);
    for (std::size_t i = 1; i < curve.size(); ++i) EXPECT_GE(curve[i], curve[i - 1]) << at[i];
    EXPECT_NEAR(curve[100], 0.01, 1e-9);
    EXPECT_NEAR(curve[120], 0.9, 1e-9);
}

// Black as a camera counts it whose noise is cut off below zero: to the left one light, to the
// right another; a corner is bright, as a lamp.
scan::CameraView darkView(glm::ivec2 size, double left, double right, double noise) {
    constexpr int kStep = 3;
    std::mt19937 random(5);
    std::normal_distribution<double> normal(0, noise);
    scan::CameraView view;
    view.sizePixels = size;
    view.black = darkness(size);
    view.sampleStep = kStep;
    Light samples = darkness(size / kStep);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const double light = x < 30 && y < 30 ? 0.5 : x < size.x / 2 ? left : right;
            const auto counted = static_cast<float>(std::max(0.0, light + normal(random)));
            view.black.at(x, y) = glm::vec3(counted);
            if (x / kStep < samples.sizePixels.x && y / kStep < samples.sizePixels.y)
                samples.at(x / kStep, y / kStep) += counted / float{kStep * kStep};
        }
    view.samples.push_back(
        {{.kind = config::ScanPattern::Kind::Level, .light = glm::vec3(0)}, samples});
    return view;
}

// Of the samples between two columns.
double meanOf(const Light& light, int first, int end) {
    double sum = 0;
    for (int y = 20; y < light.sizePixels.y; ++y)
        for (int x = first; x < end; ++x) sum += double(light.at(x, y).g);
    return sum / ((end - first) * (light.sizePixels.y - 20));
}

// Noise that is cut off makes darkness brighter: by 8 and 2 % here.
TEST(Linearised, blackIsWithoutWhatNoiseAdds) {
    constexpr double kLeft = 5e-4, kRight = 9e-4, kNoise = 5e-4;
    const scan::CameraView counted = darkView({600, 300}, kLeft, kRight, kNoise);
    EXPECT_GT(meanOf(counted.samples[0].light, 5, 95), 1.07 * kLeft);
    const scan::CameraView view = linearised(counted);
    EXPECT_NEAR(meanOf(view.samples[0].light, 5, 95), kLeft, 0.02 * kLeft);
    EXPECT_NEAR(meanOf(view.samples[0].light, 105, 195), kRight, 0.02 * kRight);
}

TEST(Linearised, blackWithoutNoiseStaysAsItIs) {
    const scan::CameraView counted = darkView({120, 90}, 1e-3, 4e-3, 0);
    const scan::CameraView view = linearised(counted);
    EXPECT_EQ(view.samples[0].light.rgb, counted.samples[0].light.rgb);
}

// One cell that gives little holds back those about it, as steps on a cone.
TEST(EvenedBelow, isAConeAboutADarkCell) {
    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    ScreenField most{{41, 31}, std::vector<float>(41 * 31, kInfinite)};
    most.values[15 * 41 + 20] = 0.5F;
    const ScreenField evened = evenedBelow(most, {0.03, 0.04});
    EXPECT_NEAR(double(evened.values[15 * 41 + 20]), 0.5, 1e-6);
    EXPECT_NEAR(double(evened.values[15 * 41 + 30]), 0.5 * std::exp(0.3), 1e-4);
    EXPECT_NEAR(double(evened.values[5 * 41 + 20]), 0.5 * std::exp(0.4), 1e-4);
    EXPECT_NEAR(double(evened.values[25 * 41 + 30]), 0.5 * std::exp(0.5), 1e-4);
}

TEST(EvenedBelow, changesNothingThatIsEvenEnough) {
    ScreenField gentle{{30, 20}, {}};
    for (int i = 0; i < 600; ++i)
        gentle.values.push_back(std::exp(0.01F * static_cast<float>(i % 30)));
    const ScreenField evened = evenedBelow(gentle, {0.02, 0.02});
    for (std::size_t i = 0; i < gentle.values.size(); ++i)
        EXPECT_NEAR(evened.values[i], gentle.values[i], 1e-5F);
}

std::vector<ProfilePoint> profileOf(double (*luminance)(double)) {
    std::vector<ProfilePoint> profile;
    for (int i = 0; i < 480; ++i) profile.push_back({luminance(i / 480.0), i > 200 && i < 280});
    return profile;
}

TEST(Seam, ofASmoothProfileIsNothing) {
    EXPECT_LT(seamOf(profileOf([](double x) { return 1 - 0.4 * x + 0.3 * x * x; })), 1e-9);
}

// A parabola through a step of height h leaves half of it at both sides.
TEST(Seam, ofAStepIsHalfOfIt) {
    const double seam = seamOf(profileOf([](double x) { return x < 0.5 ? 1.0 : 1.02; }));
    EXPECT_NEAR(seam, 0.01, 0.001);
}

TEST(Seam, beyondWhatIsSharedDoesNotCount) {
    EXPECT_LT(seamOf(profileOf([](double x) { return x < 0.1 ? 1.0 : 1.5; })), 1e-9);
}

// Linear light of a colour in CIELAB, by the inverse of what the program does.
glm::dvec3 linearOf(double lightness, double a, double b) {
    const auto cube = [](double t) {
        return t > 6.0 / 29 ? t * t * t : (t - 4.0 / 29) * 108 / 841;
    };
    const double fy = (lightness + 16) / 116;
    const glm::dvec3 white(0.9505, 1.0, 1.0890);
    const glm::dvec3 xyz = white * glm::dvec3(cube(fy + a / 500), cube(fy), cube(fy - b / 200));
    const glm::dmat3 fromRgb(
        0.4124, 0.2126, 0.0193, 0.3576, 0.7152, 0.1192, 0.1805, 0.0722, 0.9505);
    return glm::inverse(fromRgb) * xyz;
}

// Sharma, Wu and Dalal (2005), table 1: pairs 1, 17 and 25.
TEST(ColourDifference, agreesWithPublishedPairs) {
    const glm::dvec3 white(1);
    EXPECT_NEAR(colourDifference(linearOf(50, 2.6772, -79.7751), linearOf(50, 0, -82.7485), white),
                2.0425,
                2e-3);
    EXPECT_NEAR(
        colourDifference(linearOf(50, 2.5, 0), linearOf(73, 25, -18), white), 27.1492, 2e-2);
    EXPECT_NEAR(
        colourDifference(
            linearOf(60.2574, -34.0099, 36.2677), linearOf(60.4626, -34.1751, 39.4387), white),
        1.2644,
        2e-3);
}

}  // namespace
}  // namespace aquarama::light
