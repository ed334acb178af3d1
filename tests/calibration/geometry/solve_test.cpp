// SPDX-License-Identifier: Apache-2.0
// The solve finds a hall of its own model from exact places.
#include "calibration/geometry/solve.h"

#include <cmath>
#include <random>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/config/rig.h"
#include "common/wall/mark.h"
#include "tests/support/source_folder.h"

namespace aquarama::geometry {
namespace {

// A camera behind and beside the sweet spot that sees the whole of a screen.
Device cameraAt(glm::dvec3 position, glm::dvec3 yawPitchRoll, double focal, glm::ivec2 size) {
    Device camera;
    camera.lens[lens::Focal] = focal;
    camera.lens[lens::Aspect] = 1;
    camera.lens[lens::CentreX] = 0.5 * size.x + 7;
    camera.lens[lens::CentreY] = 0.5 * size.y - 5;
    camera.lens[lens::K1] = -0.06;
    camera.lens[lens::K2] = 0.02;
    camera.pose = poseOf(position, wall::turned(yawPitchRoll));
    return camera;
}

// A hall that hangs crooked before a bumpy screen.
std::unique_ptr<SolvedHall> crookedHall(const config::Rig& rig, const wall::Wall& wall) {
    auto hall = std::make_unique<SolvedHall>(rig, wall, glm::ivec2(12, 6));
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (Device& projector : hall->projectors) {
        for (std::size_t i = 0; i < 3; ++i) projector.pose[i] += 0.01 * normal(random);
        for (std::size_t i = 3; i < 6; ++i) projector.pose[i] += 0.02 * normal(random);
        projector.lens[lens::Focal] *= 1 + 0.01 * normal(random);
        projector.lens[lens::CentreY] += 4 * normal(random);
        projector.lens[lens::K1] = 0.02 * normal(random);
        projector.lens[lens::P1] = 0.001 * normal(random);
    }
    for (double& control : hall->screen.displacement().controls()) control = 0.004 * normal(random);
    return hall;
}

scan::CameraView viewOf(const SolvedHall& hall, glm::ivec2 size, double noise) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    scan::CameraView view;
    view.sizePixels = size;
    view.room = darkness(size);
    const auto pixels = static_cast<std::size_t>(size.x * size.y);
    for (std::size_t i = 0; i < hall.projectors.size(); ++i)
        view.channels.push_back(
            {.place = std::vector<glm::vec2>(pixels, glm::vec2(NAN)),
             .sigma = std::vector<glm::vec2>(pixels, glm::vec2(static_cast<float>(noise))),
             .light = std::vector<float>(pixels, 0.5F)});
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const auto index = static_cast<std::size_t>(y * size.x + x);
            const auto place = hall.placeSeen(0, {x + 0.5, y + 0.5});
            if (!place || place->unrolled.x < 0 || place->unrolled.x > 1 || place->unrolled.y < 0 ||
                place->unrolled.y > 1) {
                view.room.rgb[index] = glm::vec3(0.01F);
                continue;
            }
            view.room.rgb[index] = glm::vec3(0.4F);
            for (std::uint32_t i = 0; i < hall.projectors.size(); ++i) {
                const Tie tie{.camera = 0, .channel = i, .seen = {x + 0.5, y + 0.5}};
                const auto pixel = hall.modelled(tie);
                const glm::dvec2 picture(hall.rig.channels[i].sizePixels);
                if (!pixel || pixel->x < 0 || pixel->y < 0 || pixel->x > picture.x ||
                    pixel->y > picture.y)
                    continue;
                view.channels[i].place[index] =
                    glm::vec2(*pixel + noise * glm::dvec2(normal(random), normal(random)));
            }
        }
    return view;
}

TEST(Solve, findsACrookedHallOfItsOwnModel) {
    const config::Rig rig = config::readRig(test::sourceFolder() + "/config/desk.txtpb");
    const wall::Wall wall(rig);
    const auto truth = crookedHall(rig, wall);
    const glm::ivec2 size(1280, 720);
    truth->cameras = {cameraAt({0.4, 0.2, 2.2}, {0.05, -0.03, 0.01}, 0.485 * size.x, size)};
    const Solved solved = solveHall(rig, wall, {viewOf(*truth, size, 0.1)}, [](const auto&) {});
    ASSERT_TRUE(solved.faults.empty());
    double sum = 0, worst = 0;
    int count = 0;
    for (int y = 10; y < size.y; y += 10)
        for (int x = 10; x < size.x; x += 10) {
            const auto place = truth->placeSeen(0, {x + 0.5, y + 0.5});
            if (!place || place->unrolled.x < 0.01 || place->unrolled.x > 0.99 ||
                place->unrolled.y < 0.01 || place->unrolled.y > 0.99)
                continue;
            const auto found = solved.hall->placeSeen(0, {x + 0.5, y + 0.5});
            ASSERT_TRUE(found);
            const double off = glm::distance(truth->panoramaPixel(place->point),
                                             truth->panoramaPixel(found->point));
            sum += off * off;
            worst = std::max(worst, off);
            ++count;
        }
    ASSERT_GT(count, 300);
    EXPECT_LT(solved.figures.overlap.rms, 0.1);
    EXPECT_LT(std::sqrt(sum / count), 0.5);
}

// Where the first camera sees a point.
glm::dvec2 seenAt(const SolvedHall& hall, glm::dvec3 point) {
    const Device& camera = hall.cameras.front();
    const Two<double> pixel =
        pixelOf(camera.lens.data(), camera.pose.data(), Three<double>{point.x, point.y, point.z});
    return {pixel[0], pixel[1]};
}

// A dark strip of so many millimetres at the middle of the upper edge, as far from there as is
// said, and where it is found.
struct FoundMark {
    double offMillimetres;
    std::size_t count;
};
FoundMark foundMark(double widthMillimetres, double offMillimetres) {
    const config::Rig rig = config::readRig(test::sourceFolder() + "/config/desk.txtpb");
    const wall::Wall wall(rig);
    SolvedHall hall(rig, wall, glm::ivec2(4));
    const glm::ivec2 size(1280, 720);
    hall.cameras = {cameraAt({0.4, 0.2, 2.2}, {0.05, -0.03, 0.01}, 0.485 * size.x, size)};
    const auto places = wall::markPlaces(config::ScreenShape::Cylinder, wall.screen());
    const wall::MarkPlace& place = places.front();
    Light room = darkness(size);
    const auto middle = seenAt(hall, place.at(0, 0));
    constexpr int kParts = 4;  // of a pixel's side
    for (int y = -60 * kParts; y < 60 * kParts; ++y)
        for (int x = -60 * kParts; x < 60 * kParts; ++x) {
            const glm::dvec2 at = middle + (glm::dvec2(x, y) + 0.5) / double{kParts};
            const auto seen = hall.placeSeen(0, at);
            if (!seen || seen->unrolled.y < 0) continue;
            const glm::dvec3 off = seen->point - place.edge;
            const bool isTape = std::abs(glm::dot(off, place.along) - offMillimetres / 1000) <
                                    widthMillimetres / 2000 &&
                                glm::dot(off, place.inwards) < wall::kMarkLengthMetres;
            room.at(static_cast<int>(at.x), static_cast<int>(at.y)) +=
                glm::vec3(isTape ? 0.01F : 0.4F) / 16.0F;
        }
    const Device& camera = hall.cameras.front();
    const auto ties = markTies(room, 0, rig.screen.shape, hall.screen, camera.lens, camera.pose);
    if (ties.empty()) return {0, 0};
    const OutlineTie& tie = ties.front().tie;
    const glm::dvec2 expected = seenAt(hall, hall.screen.at(tie.unrolled).point);
    const double pixels = glm::dot(tie.seen - expected, tie.across);
    return {pixels / ties.front().sigma, ties.size()};  // of a millimetre
}

TEST(Marks, areFoundToAMillimetreWhereTheyAreAsWideAsTape) {
    for (const double off : {0.0, 17.0, -120.0}) {
        const FoundMark found = foundMark(50, off);
        ASSERT_EQ(found.count, 1U) << off;
        EXPECT_NEAR(found.offMillimetres, off, 1) << off;
    }
    EXPECT_EQ(foundMark(0, 0).count, 0U);
    EXPECT_EQ(foundMark(20, 0).count, 0U) << "a cable";
    EXPECT_EQ(foundMark(100, 0).count, 0U) << "a loudspeaker";
}

}  // namespace
}  // namespace aquarama::geometry
