// SPDX-License-Identifier: Apache-2.0
// Screens of every shape, lenses that bend, panels: against closed forms and against themselves.
#include <cmath>
#include <numbers>
#include <set>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/base/units.h"
#include "common/wall/mark.h"
#include "rigs.h"

namespace aquarama::wall {
namespace {

config::Screen flatScreen() {
    config::Screen screen;
    screen.shape = config::ScreenShape::Flat;
    screen.widthMetres = 6;
    screen.heightMetres = 2;
    screen.distanceMetres = 3;
    return screen;
}

config::Screen domeScreen() {
    config::Screen screen;
    screen.shape = config::ScreenShape::Dome;
    screen.radiusMetres = 4;
    screen.arcRadians = std::numbers::pi;
    return screen;
}

std::unique_ptr<const ScreenSurface> surfaceOf(const config::Screen& screen) {
    config::Rig rig;
    rig.screen = screen;
    return makeSurface(rig);
}

void expectNear(glm::dvec3 found, glm::dvec3 wanted) {
    EXPECT_LT(glm::distance(found, wanted), 1e-12) << found.x << ' ' << found.y << ' ' << found.z;
}

// For everything that a screen says of a point there is a second way to find out.
void expectConsistent(const ScreenSurface& screen, glm::dvec3 inside) {
    Dice dice;
    int seen = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec2 place(dice.between(0.01, 0.99), dice.between(0.01, 0.99));
        const auto point = screen.at(place);
        if (!point) continue;
        ++seen;
        EXPECT_LT(glm::distance(screen.unrolled(*point), place), 1e-9);
        const auto hit = screen.hit({inside, 0.5 * (*point - inside)}, 0);
        ASSERT_TRUE(hit);
        EXPECT_LT(glm::distance(*hit, *point), 1e-9);
        EXPECT_TRUE(isBefore(screen, inside, *point));
        const glm::dvec3 outside = *point - screen.normalAt(*point);
        EXPECT_FALSE(isBefore(screen, outside, *point));
    }
    EXPECT_GT(seen, 2000);
}

TEST(Screens, agreeWithThemselves) {
    for (const double tilt : {0.0, 0.4, -0.2}) {
        config::Screen cylinder = axisRig().screen;
        config::Screen flat = flatScreen(), dome = domeScreen();
        for (config::Screen* screen : {&cylinder, &flat, &dome}) {
            screen->tiltRadians = tilt;
            expectConsistent(*surfaceOf(*screen), {0.1, 0.2, -0.3});
        }
    }
}

TEST(Screens, aFlatOneLiesAcrossTheView) {
    const auto screen = surfaceOf(flatScreen());
    expectNear(screen->at({0.5, 0.5}).value(), {0, 0, -3});
    expectNear(screen->at({0, 0}).value(), {-3, 1, -3});
    expectNear(screen->hit({{0, 0, 1}, {1, 0.25, -2}}, 0).value(), {2, 0.5, -3});
    EXPECT_FALSE(screen->hit({{0, 0, -4}, {0, 0, 1}}, 0)) << "from behind";
    EXPECT_FALSE(screen->hit({{0, 0, 0}, {3.01, 0, -3}}, 0));
    EXPECT_TRUE(screen->hit({{0, 0, 0}, {3.01, 0, -3}}, 0.02));
}

// The axis points up and tips forward; the fisheye has the front below, the right on the right.
TEST(Screens, aDomesFisheyeGrowsWithTheAngleFromItsAxis) {
    const auto upright = surfaceOf(domeScreen());
    expectNear(upright->at({0.5, 0.5}).value(), {0, 4, 0});
    expectNear(upright->at({0.5, 1}).value(), {0, 0, -4});
    expectNear(upright->at({1, 0.5}).value(), {4, 0, 0});
    expectNear(upright->at({0.5, 0.75}).value(), {0, 4 * std::sqrt(0.5), -4 * std::sqrt(0.5)});
    EXPECT_FALSE(upright->at({0.02, 0.02}));
    config::Screen tipped = domeScreen();
    tipped.tiltRadians = 90 * kDegree;
    expectNear(surfaceOf(tipped)->at({0.5, 0.5}).value(), {0, 0, -4});
    expectNear(surfaceOf(tipped)->at({0.5, 1}).value(), {0, -4, 0});
}

// The middle of a strip's inner half is on the strip and on the screen; beside it is neither.
TEST(Marks, liePointingInwardsFromTheMiddleOfAnEdge) {
    using config::ScreenShape;
    const auto flat = markPlaces(ScreenShape::Flat, *surfaceOf(flatScreen()));
    ASSERT_EQ(flat.size(), 2U);
    expectNear(flat[0].edge, {0, 1, -3});
    expectNear(flat[0].inwards, {0, -1, 0});
    expectNear(flat[1].edge, {0, -1, -3});
    expectNear(flat[1].inwards, {0, 1, 0});
    EXPECT_TRUE(flat[0].covers({0.024, 0.86, -3}, 0, 0));
    EXPECT_FALSE(flat[0].covers({0.026, 0.86, -3}, 0, 0));
    EXPECT_FALSE(flat[0].covers({0, 0.84, -3}, 0, 0));
    EXPECT_FALSE(flat[0].covers({0, 0.86, -3}, 0.03, 0)) << "stuck beside it";
    EXPECT_TRUE(flat[0].covers({0, 0.84, -3}, 0, 0.02));
    EXPECT_TRUE(flat[0].covers({0.03 * flat[0].along.x, 0.86, -3}, 0.03, 0));
    const auto dome = markPlaces(ScreenShape::Dome, *surfaceOf(domeScreen()));
    ASSERT_EQ(dome.size(), 2U);
    expectNear(dome[0].edge, {0, 0, 4});
    expectNear(dome[1].edge, {0, 0, -4});
    EXPECT_GT(dome[1].inwards.y, 0.99);
    EXPECT_TRUE(markPlaces(ScreenShape::Panels, *surfaceOf(flatScreen())).empty());
}

TEST(Screens, aTiltLowersTheFrontOfEveryShape) {
    for (config::Screen screen : {axisRig().screen, flatScreen()}) {
        const glm::dvec3 before = surfaceOf(screen)->at({0.5, 0.5}).value();
        screen.tiltRadians = 0.3;
        const glm::dvec3 after = surfaceOf(screen)->at({0.5, 0.5}).value();
        expectNear(after, {0, before.z * std::sin(0.3), before.z * std::cos(0.3)});
    }
}

// A measured screen: the axis rig's cylinder in strips, so fine that chords lie a tenth of a
// millimetre off.
std::vector<std::byte> stripsOfCylinder(int columns) {
    std::string text = "# a cylinder\n";
    for (int i = 0; i <= columns; ++i) {
        const double azimuth = (static_cast<double>(i) / columns - 0.5) * 1.5;
        for (const double y : {-1.5, 1.5})
            text += fmt::format(
                "v {:.9f} {} {:.9f}\n", 2 * std::sin(azimuth), y, -2 * std::cos(azimuth));
    }
    for (int i = 0; i < columns; ++i)  // quads, from alternating sides
        text += i % 2 == 0
                    ? fmt::format("f {} {} {} {}\n", 2 * i + 1, 2 * i + 3, 2 * i + 4, 2 * i + 2)
                    : fmt::format("f {} {} {} {}\n", 2 * i + 1, 2 * i + 2, 2 * i + 4, 2 * i + 3);
    const auto bytes = std::as_bytes(std::span{text});
    return {bytes.begin(), bytes.end()};
}

config::Rig rigWithMesh(const std::vector<std::byte>& obj) {
    config::Rig rig;
    rig.screen.shape = config::ScreenShape::Measured;
    rig.screen.meshFile = "canvas.obj";
    rig.files["canvas.obj"] = std::make_shared<const std::vector<std::byte>>(obj);
    return rig;
}

TEST(Screens, aMeasuredOneIsItsTriangles) {
    const auto measured = makeSurface(rigWithMesh(stripsOfCylinder(80)));
    const auto exact = surfaceOf(axisRig().screen);
    Dice dice;
    for (int i = 0; i < 2000; ++i) {
        const Ray ray{{dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), dice.between(-0.5, 0.5)},
                      {dice.between(-1, 1), dice.between(-1, 1), -1}};
        const auto point = measured->hit(ray, 0);
        const auto wanted = exact->hit(ray, 0);
        if (point && wanted) {
            EXPECT_LT(glm::distance(*point, *wanted), 2e-4);
        }
        const auto isBy = [](glm::dvec3 at) {  // the edge of one of the two
            return std::abs(std::abs(at.y) - 1.5) < 1e-3 ||
                   std::abs(std::abs(azimuthOf(at)) - 0.75) < 1e-3;
        };
        if (point.has_value() != wanted.has_value()) {
            EXPECT_TRUE(isBy(point ? *point : *wanted));
        }
    }
    // Its sides face the sweet spot, however its faces are wound.
    EXPECT_TRUE(isBefore(*measured, {0, 0, 0}, {0, 0.3, -2}));
    EXPECT_FALSE(isBefore(*measured, {0, 0, -3}, {0, 0.3, -2}));
    EXPECT_FALSE(measured->hit({{0, 0, -3}, {0, 0, 1}}, 0)) << "from behind";
}

TEST(Screens, aMeasuredOneWithoutFacesIsRefusedByName) {
    const std::string text = "v 0 0 0\nv 1 0 0\n";
    const auto bytes = std::as_bytes(std::span{text});
    const config::Rig rig = rigWithMesh({bytes.begin(), bytes.end()});
    try {
        (void)makeSurface(rig);
        FAIL() << "it was taken";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("canvas.obj"));
    }
}

// r is thrown at r (1 + k1 r^2 + k2 r^4).
TEST(Lens, bendsATangentAsItsFormulaSays) {
    config::Projector projector;
    projector.focalPixels = {500, 400};
    projector.principalPixels = {320, 100};
    projector.distortion = {-0.05, 0.01};
    const Lens lens(projector, {640, 400});
    const glm::dvec2 tangent(0.3, -0.2);
    const double square = 0.09 + 0.04;
    const double stretch = 1 - 0.05 * square + 0.01 * square * square;
    const auto pixel = lens.pixelOf(glm::dvec3(tangent, -1) * 7.0);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x, 320 + 500 * 0.3 * stretch, 1e-9);
    EXPECT_NEAR(pixel->y, 100 + 400 * 0.2 * stretch, 1e-9);
}

// Beyond the picture this lens folds: two tangents are thrown at one place, and the nearer is
// meant.
TEST(Lens, takesTheTangentBeforeAFold) {
    config::Projector projector;
    projector.focalPixels = {100, 100};
    projector.distortion = {0.5, -0.3};
    const Lens lens(projector, {120, 10});
    const Ray ray = lens.ray({120, 0});  // thrown at 1.2: 1 + 0.5 - 0.3
    EXPECT_NEAR(ray.direction.x, 1, 1e-12);
}

// Rays along a plane between two boxes of the tree.
TEST(Screens, aMeasuredOneHasNoGapAheadOfTheEye) {
    const auto measured = makeSurface(rigWithMesh(stripsOfCylinder(80)));
    for (double y = -1.4; y < 1.4; y += 0.05)
        EXPECT_TRUE(measured->hit({{0, 0, 0}, {0, y, -2}}, 0)) << y;
}

TEST(Lens, leadsEveryPixelBackToItself) {
    Dice dice;
    for (int rig = 0; rig < 50; ++rig) {
        config::Projector projector;
        projector.focalPixels = {dice.between(400, 900), dice.between(400, 900)};
        projector.principalPixels = {dice.between(0, 640), dice.between(-200, 600)};
        projector.distortion = {dice.between(-0.05, 0.1), dice.between(-0.005, 0.02)};
        projector.yawPitchRollRadians = {
            dice.between(-3, 3), dice.between(-1, 1), dice.between(-3, 3)};
        const Lens lens(projector, {640, 400});
        for (int i = 0; i < 100; ++i) {
            const glm::dvec2 pixel(dice.between(0, 640), dice.between(0, 400));
            const Ray ray = lens.ray(pixel);
            const auto back = lens.pixelOf(ray.origin + 3.0 * ray.direction);
            ASSERT_TRUE(back);
            EXPECT_LT(glm::distance(*back, pixel), 1e-8);
        }
    }
}

class ScreenOfRig : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped,
                         ScreenOfRig,
                         testing::Values("flat_3", "dome_5", "wall_2x2", "measured_3"));

TEST_P(ScreenOfRig, theSharesOfEveryPointSumToOneAndFadeToNothingAtABorder) {
    const config::Rig rig = shippedRig(GetParam());
    const Wall wall(rig);
    Dice dice;
    std::set<int> sharing;
    for (int i = 0; i < 20000; ++i) {
        const auto point =
            wall.screen().at({dice.between(0.006, 0.994), dice.between(0.006, 0.994)});
        if (!point) continue;
        double sum = 0;
        int channels = 0;
        for (std::size_t c = 0; c < rig.channels.size(); ++c) {
            const double weight = wall.weight(c, *point);
            const auto pixel = wall.channel(c).pixelOf(*point);
            if (pixel) {
                ++channels;
                const glm::dvec2 size(rig.channels[c].sizePixels);
                const glm::dvec2 inside = glm::min(*pixel, size - *pixel);
                if (std::min(inside.x, inside.y) < 0.05 && weight < 1) {
                    EXPECT_LT(weight, 1e-3);
                }
            }
            sum += weight;
        }
        sharing.insert(channels);
        ASSERT_NEAR(sum, 1, 1e-9);
    }
    EXPECT_TRUE(sharing.contains(2));
    if (GetParam() == "wall_2x2") {
        EXPECT_TRUE(sharing.contains(4)) << "all four meet in the middle";
    }
}

TEST_P(ScreenOfRig, pixelsAndPointsAreEachOthersInverse) {
    const config::Rig rig = shippedRig(GetParam());
    const Wall wall(rig);
    Dice dice;
    int lit = 0;
    for (std::size_t c = 0; c < rig.channels.size(); ++c)
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec2 size(rig.channels[c].sizePixels);
            const glm::dvec2 pixel(dice.between(0, size.x), dice.between(0, size.y));
            const auto point = wall.channel(c).pointOf(pixel, 0);
            if (!point) continue;
            ++lit;
            const auto back = wall.channel(c).pixelOf(*point);
            ASSERT_TRUE(back);
            EXPECT_LT(glm::distance(*back, pixel), 1e-7);
        }
    EXPECT_GT(lit, 700 * static_cast<int>(rig.channels.size()));
}

TEST_P(ScreenOfRig, everyFrustumHoldsWhatItsChannelLights) {
    const config::Rig rig = shippedRig(GetParam());
    const Wall wall(rig);
    for (std::size_t c = 0; c < rig.channels.size(); ++c) {
        const ChannelFrustum frustum = wall.frustum(c, 0);
        for (const glm::vec4& entry : wall.warp(c).pointAndWeight) {
            if (entry.w <= 0) continue;
            const glm::dvec4 seen = frustum.cameraFromWall * glm::dvec4(glm::dvec3(entry), 1);
            ASSERT_LT(seen.z, 0);
            ASSERT_GE(seen.x / -seen.z, frustum.left - 1e-6);
            ASSERT_LE(seen.x / -seen.z, frustum.right + 1e-6);
            ASSERT_GE(seen.y / -seen.z, frustum.bottom - 1e-6);
            ASSERT_LE(seen.y / -seen.z, frustum.top + 1e-6);
        }
    }
}

TEST(Panels, aPixelIsItsPlaceOnTheDisplay) {
    const config::Rig rig = shippedRig("cave_4");
    const Wall wall(rig);
    expectNear(wall.channel(0).pointOf({0, 0}, 0).value(), {-1.25, 1, 1.25});  // left, its top left
    expectNear(wall.channel(1).pointOf({500, 400}, 0).value(), {1.25, -1, -1.25});
    expectNear(wall.channel(2).pointOf({0, 0}, 0).value(), {1.25, 1, -1.25});
    expectNear(wall.channel(3).pointOf({250, 0}, 0).value(),
               {0, -1, -1.25});  // of the floor, the front
    EXPECT_FALSE(wall.channel(1).pixelOf({0, 0, -1.3})) << "behind the display";
    EXPECT_EQ(wall.weight(1, {0, 0, -1.25}), 1);
}

// Hidden bezels: the pictures of two displays that stand side by side meet in the middle between
// them. Kept: there is a gap of two bezels.
TEST(Panels, bezelsAreKeptOrHidden) {
    for (const bool hides : {false, true}) {
        config::Rig rig = shippedRig("televisions_3");
        rig.screen.hidesBezels = hides;
        const Wall wall(rig);
        const glm::dvec3 right = wall.channel(0).pointOf({640, 180}, 0).value();
        const glm::dvec3 left = wall.channel(1).pointOf({0, 180}, 0).value();
        const double gap = 2 * 0.01 * std::cos(25 * kDegree);  // turned by 50 against each other
        EXPECT_NEAR(glm::distance(left, right), hides ? 0 : gap, 2e-4) << hides;
    }
}

// The picture of a panel needs no warp: each of its pixels is one of the frustum's picture.
TEST(Panels, aPixelIsAPixelOfTheFrustumsPicture) {
    for (const char* name : {"televisions_3", "cave_4"}) {
        const config::Rig rig = shippedRig(name);
        const Wall wall(rig);
        for (std::size_t c = 0; c < rig.channels.size(); ++c) {
            const ChannelFrustum frustum = wall.frustum(c, 0.0175);
            ASSERT_TRUE(frustum.sizePixels);
            const glm::dvec2 size(*frustum.sizePixels);
            for (const glm::dvec2 pixel : {glm::dvec2(0.5), glm::dvec2(10.5, 300.5)}) {
                const glm::dvec3 point = wall.channel(c).pointOf(pixel, 0).value();
                const glm::dvec4 seen = frustum.cameraFromWall * glm::dvec4(point, 1);
                const double x =
                    (seen.x / -seen.z - frustum.left) / (frustum.right - frustum.left) * size.x;
                const double y =
                    (frustum.top - seen.y / -seen.z) / (frustum.top - frustum.bottom) * size.y;
                EXPECT_NEAR(x - std::floor(x), 0.5, 1e-6) << name;
                EXPECT_NEAR(y - std::floor(y), 0.5, 1e-6) << name;
            }
        }
    }
}

}  // namespace
}  // namespace aquarama::wall
