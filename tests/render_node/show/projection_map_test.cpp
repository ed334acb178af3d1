// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "render_node/show/projection.h"
#include "tests/common/wall/rigs.h"

namespace aquarama::show {
namespace {

constexpr double kMapMargin = 0.01;

// Direction from the sweet spot through a place in the frustum's picture, wall frame.
glm::dvec3 directionThrough(const wall::ChannelFrustum& frustum, glm::dvec2 place) {
    const glm::dvec4 inCamera(glm::mix(frustum.left, frustum.right, place.x),
                              glm::mix(frustum.bottom, frustum.top, place.y),
                              -1,
                              0);
    return glm::normalize(glm::dvec3(glm::inverse(frustum.cameraFromWall) * inCamera));
}

TEST(ProjectionMap, leadsEachPixelToTheRayThroughThePointThatItLights) {
    for (const char* name : {"desk", "theatre", "touring"}) {
        const config::Rig rig = wall::shippedRig(name);
        for (std::size_t channel = 0; channel < rig.channels.size(); ++channel) {
            const wall::WarpMap warp = wall::Wall(rig).warp(channel);
            const wall::ChannelFrustum frustum = wall::Wall(rig).frustum(channel, kMapMargin);
            const ProjectionMap map = projectionMap(warp, frustum);
            const glm::dvec2 size(scenePictureSize(map));
            const double pixelRadians = (frustum.right - frustum.left) / size.x;
            for (std::size_t i = 0; i < warp.pointAndWeight.size(); i += 997) {
                const glm::dvec4 point(warp.pointAndWeight[i]);
                const glm::dvec4 place(map.placeAndWeight[i]);
                EXPECT_EQ(place.z, point.w);
                if (point.w <= 0) continue;
                const glm::dvec3 ray = directionThrough(frustum, glm::dvec2(place));
                const glm::dvec3 wanted = glm::normalize(glm::dvec3(point));
                EXPECT_LT(glm::distance(ray, wanted), 0.01 * pixelRadians) << name << ' ' << i;
            }
        }
    }
}

// The place in a channel's picture that the pixel between texel centres shows.
glm::dvec2 placeAt(const ProjectionMap& map, glm::dvec2 pixel) {
    const glm::dvec2 texel = pixel - 0.5;
    const glm::ivec2 corner(glm::floor(texel));
    const glm::dvec2 share = texel - glm::floor(texel);
    const auto at = [&](int x, int y) {
        return glm::dvec2(map.placeAndWeight[static_cast<std::size_t>(y) *
                                                 static_cast<std::size_t>(map.sizePixels.x) +
                                             static_cast<std::size_t>(x)]);
    };
    return glm::mix(glm::mix(at(corner.x, corner.y), at(corner.x + 1, corner.y), share.x),
                    glm::mix(at(corner.x, corner.y + 1), at(corner.x + 1, corner.y + 1), share.x),
                    share.y);
}

// A fish at any distance is drawn by every channel into the pixel that lights the one point of the
// wall on the way to the eye: so neighbours agree about it.
TEST(ProjectionMap, everyChannelShowsAPointOfTheWorldAtOnePlaceOfTheWall) {
    wall::Dice dice;
    for (const char* name :
         {"desk", "theatre", "touring", "flat_3", "wall_2x2", "dome_5", "measured_3"}) {
        const config::Rig rig = wall::shippedRig(name);
        const wall::Wall wall(rig);
        std::vector<glm::dvec3> directions;
        while (directions.size() < 1000)
            if (const auto point =
                    wall.screen().at({dice.between(0.01, 0.99), dice.between(0.05, 0.95)}))
                directions.push_back(*point);
        std::vector<std::size_t> channelsOf(directions.size(), 0);
        for (std::size_t channel = 0; channel < rig.channels.size(); ++channel) {
            const wall::ChannelFrustum frustum = wall.frustum(channel, kMapMargin);
            const ProjectionMap map = projectionMap(wall.warp(channel), frustum);
            const glm::dvec2 size(scenePictureSize(map));
            for (std::size_t i = 0; i < directions.size(); ++i) {
                if (wall.weight(channel, directions[i]) < 0.01) continue;
                ++channelsOf[i];
                const glm::dvec3 fish = directions[i] * dice.between(0.5, 8);
                const glm::dvec4 clip = glm::dmat4(wall::clipFromCamera(frustum, 0.05F)) *
                                        frustum.cameraFromWall * glm::dvec4(fish, 1);
                const glm::dvec2 drawn = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * size;
                const auto pixel = wall.channel(channel).pixelOf(directions[i]);
                ASSERT_TRUE(pixel);
                EXPECT_LT(glm::distance(drawn, placeAt(map, *pixel) * size), 0.05) << name;
            }
        }
        EXPECT_GT(std::ranges::count(channelsOf, 2U), 10) << name << ": no overlap was met";
    }
}

TEST(ProjectionMap, staysInsideThePictureWithRoomForTheFilter) {
    const config::Rig rig = wall::shippedRig("desk");
    const ProjectionMap map =
        projectionMap(wall::Wall(rig).warp(0), wall::Wall(rig).frustum(0, kMapMargin));
    const glm::vec2 texel = 1.0F / glm::vec2(scenePictureSize(map));
    for (const glm::vec4& place : map.placeAndWeight) {
        if (place.z <= 0) continue;
        ASSERT_TRUE(glm::all(glm::greaterThan(glm::vec2(place), 2.0F * texel)));
        ASSERT_TRUE(glm::all(glm::lessThan(glm::vec2(place), 1.0F - 2.0F * texel)));
    }
}

// One step between neighbouring projector pixels is one scene pixel in the middle, and more of them
// elsewhere is more detail, never less than three quarters.
TEST(ProjectionMap, scenePictureIsAsFineAsTheProjector) {
    for (const char* name : {"desk", "theatre", "touring"}) {
        const config::Rig rig = wall::shippedRig(name);
        const ProjectionMap map =
            projectionMap(wall::Wall(rig).warp(1), wall::Wall(rig).frustum(1, kMapMargin));
        const glm::dvec2 size(scenePictureSize(map));
        const auto width = static_cast<std::size_t>(map.sizePixels.x);
        const auto stepAt = [&](std::size_t i) {
            const glm::dvec2 here(map.placeAndWeight[i]);
            const glm::dvec2 right(map.placeAndWeight[i + 1]);
            const glm::dvec2 below(map.placeAndWeight[i + width]);
            return glm::dvec2(glm::length((right - here) * size),
                              glm::length((below - here) * size));
        };
        const std::size_t middle = map.placeAndWeight.size() / 2 + width / 2;
        EXPECT_GE(stepAt(middle).x, 0.999) << name;
        EXPECT_GE(stepAt(middle).y, 0.999) << name;
        EXPECT_LT(stepAt(middle).x, 1.02) << name << ": larger than needed";
    }
}

TEST(ProjectionMap, aProjectorWhoseMiddleMissesTheScreenIsRefused) {
    ProjectionMap map{.sizePixels = {4, 4}, .placeAndWeight = std::vector<glm::vec4>(16)};
    EXPECT_THROW((void)scenePictureSize(map), Error);
    map = {.sizePixels = {1, 1}, .placeAndWeight = std::vector<glm::vec4>(1, glm::vec4(1))};
    EXPECT_THROW((void)scenePictureSize(map), Error);
}

}  // namespace
}  // namespace aquarama::show
