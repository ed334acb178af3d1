// SPDX-License-Identifier: Apache-2.0
#include "capture/film/painted_fish.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "capture/film/triangle.h"
#include "common/base/units.h"
#include "common/body/fins.h"

namespace aquarama::film {

namespace {

// The cage of a pose, without the fins' own motion, in the body frame.
std::vector<glm::vec3> cageOf(const body::FishBody& body, const capture::NodeVectors& pose) {
    body::NodalPoints nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes.at(i) = pose.at(i);
    std::vector<glm::vec3> points(body::kControlPoints);
    body::poseCage(body, nodes, points);
    return points;
}

std::vector<float> headingsOf(const body::FishBody& body, const capture::NodeVectors& pose) {
    body::NodalPoints nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes.at(i) = pose.at(i);
    std::vector<float> headings(body::kControlPoints);
    body::headingsOf(body, nodes, headings);
    return headings;
}

// The radians of the beat from one point of a trace to the next; 0 where the phase jumps and in a
// motion warp, where the tail goes from one pose to another.
float radiansBetween(const body::FinDrive& before, const body::FinDrive& now) {
    constexpr float kLeast = 0.002F, kMost = 0.25F;  // cycles
    const float cycles = glm::fract(now.phase - before.phase);
    const bool isWithin = cycles > kLeast && cycles < kMost && now.weight >= 1;
    return isWithin ? glm::two_pi<float>() * cycles : 0;
}

// The cage with its fins, in the world.
std::vector<glm::vec3> livingCage(const body::FishBody& body,
                                  const report::Trace& trace,
                                  std::size_t tick) {
    const report::TracePoint& now = trace[tick];
    const report::TracePoint& before = trace[tick > 0 ? tick - 1 : 0];
    std::vector<glm::vec3> points = cageOf(body, now.pose);
    const std::vector<glm::vec3> pointsBefore = cageOf(body, before.pose);
    const std::vector<float> headings = headingsOf(body, now.pose);
    const float radians = radiansBetween(before.drive, now.drive);
    body::FinDrive drive = now.drive;
    drive.seconds = std::fmod(static_cast<float>(tick) / static_cast<float>(kTicksPerSecond),
                              body::kFinSeconds);
    const glm::mat3 worldFromBody(now.frame.worldFromBody);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::vec3 right = body::turned({0, 0, 1}, headings[i]);
        const float drift =
            radians > 0 ? glm::dot(points[i] - pointsBefore[i], right) / radians : 0;
        points[i] += body::turned(body::finOffset(body.fins, i, drive, drift), headings[i]);
        points[i] = glm::vec3(now.frame.origin) + worldFromBody * points[i];
    }
    return points;
}

// Wrapped daylight from above, and the water's own from everywhere.
float lightOn(glm::vec3 normal, const FarView& view) {
    const glm::vec3 sun =
        glm::normalize(glm::vec3(0, 1, 0) + 0.7F * view.towards + 0.25F * view.right);
    return 0.75F * std::max(0.0F, 0.72F * glm::dot(normal, sun) + 0.28F) + 0.27F + 0.1F * normal.y;
}

// What a triangle shows at a pixel.
struct Shown {
    glm::vec3 light{};
    float opacity = 1;
};

// Calls put(pixel, shown) for what is nearer than all before it: first the body, then the fins,
// which hide nothing.
template <typename Put>
void shade(glm::ivec2 size,
           const PaintedSkin& skin,
           const PosedSurface& surface,
           const FarView& view,
           const Put& put) {
    assert(skin.colours.size() == skin.table.indices.size());
    const auto pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    std::vector<float> nearest(pixels, std::numeric_limits<float>::lowest());
    const std::vector<std::uint32_t>& indices = skin.table.indices;
    for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
        const bool isBody = t < skin.table.bodyIndices;
        std::array<glm::vec2, 3> corners{};
        glm::mat3 normals;
        glm::vec3 depths;
        std::array<glm::vec4, 3> colours{};
        for (int k = 0; k < 3; ++k) {
            const std::size_t corner = t + static_cast<std::size_t>(k);
            const std::uint32_t i = indices[corner];
            corners.at(static_cast<std::size_t>(k)) = view.onPaper(surface.places[i], size);
            depths[k] = glm::dot(surface.places[i], view.towards);
            normals[k] = surface.normals[i];
            colours.at(static_cast<std::size_t>(k)) = skin.colours[corner];
        }
        fillTriangle(corners, size, [&](int x, int y, glm::vec3 weights) {
            const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                               static_cast<std::size_t>(x);
            const float depth = glm::dot(depths, weights);
            if (depth <= nearest[pixel]) return;
            if (isBody) nearest[pixel] = depth;
            glm::vec3 normal = glm::normalize(normals * weights);
            if (glm::dot(normal, view.towards) < 0) normal = -normal;
            const glm::vec4 colour =
                weights.x * colours[0] + weights.y * colours[1] + weights.z * colours[2];
            put(pixel, Shown{glm::vec3(colour) * lightOn(normal, view), isBody ? 1.0F : colour.w});
        });
    }
}

}  // namespace

PosedSurface surfaceAt(const body::FishBody& body,
                       const skin::LimitTable& table,
                       const report::Trace& trace,
                       std::size_t tick) {
    assert(tick < trace.size());
    const std::vector<glm::vec3> cage = livingCage(body, trace, tick);
    PosedSurface surface;
    surface.places.reserve(table.vertices.size());
    surface.normals.reserve(table.vertices.size());
    for (std::size_t i = 0; i < table.vertices.size(); ++i) {
        const skin::SkinPoint point = skin::skinPoint(table, i, cage);
        surface.places.push_back(point.position);
        surface.normals.push_back(point.normal);
    }
    return surface;
}

PosedSurface moved(PosedSurface surface,
                   const glm::dvec3& from,
                   const glm::dvec3& to,
                   double turnRadians) {
    const glm::mat3 turn =
        glm::mat3_cast(glm::angleAxis(static_cast<float>(turnRadians), glm::vec3(0, 1, 0)));
    for (glm::vec3& place : surface.places)
        place = glm::vec3(to) + turn * (place - glm::vec3(from));
    for (glm::vec3& normal : surface.normals) normal = turn * normal;
    return surface;
}

glm::vec2 FarView::onPaper(glm::vec3 place, glm::ivec2 sizePixels) const {
    const glm::vec3 from = place - centre;
    return glm::vec2(sizePixels) / 2.0F +
           pixels * glm::vec2(glm::dot(from, right), -glm::dot(from, up));
}

void drawFish(Light& paper,
              const PaintedSkin& skin,
              const PosedSurface& surface,
              const FarView& view) {
    shade(paper.sizePixels, skin, surface, view, [&](std::size_t pixel, const Shown& shown) {
        paper.rgb[pixel] = glm::mix(paper.rgb[pixel], shown.light, shown.opacity);
    });
}

void drawGhost(Light& paper,
               const PaintedSkin& skin,
               const PosedSurface& surface,
               const FarView& view,
               glm::vec3 colour) {
    constexpr float kVeil = 0.42F;
    const glm::ivec2 size = paper.sizePixels;
    std::vector<float> brightness(paper.rgb.size(), -1);  // negative: nothing is there
    shade(size, skin, surface, view, [&](std::size_t pixel, const Shown& shown) {
        brightness[pixel] = std::max(brightness[pixel], 0.0F) * (1 - shown.opacity) +
                            static_cast<float>(luminance(shown.light)) * shown.opacity;
    });
    const auto isThere = [&](int x, int y) {
        if (x < 0 || y < 0 || x >= size.x || y >= size.y) return false;
        return brightness[static_cast<std::size_t>(y * size.x + x)] >= 0;
    };
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            if (!isThere(x, y)) continue;
            const bool isInside =
                isThere(x - 1, y) && isThere(x + 1, y) && isThere(x, y - 1) && isThere(x, y + 1);
            const float shade = 0.6F + 0.8F * brightness[static_cast<std::size_t>(y * size.x + x)];
            glm::vec3& pixel = paper.at(x, y);
            pixel = isInside ? glm::mix(pixel, colour * shade, kVeil) : colour;
        }
}

}  // namespace aquarama::film
