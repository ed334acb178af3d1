// SPDX-License-Identifier: Apache-2.0
#include "drawings/raster.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>

namespace aquarama::drawings {

namespace {

float cross(glm::vec2 a, glm::vec2 b) {
    return a.x * b.y - a.y * b.x;
}

// Directions along the borders of pixels, each a quarter turn to the right of the one before (y
// down): right, down, left, up.
constexpr std::array<glm::ivec2, 4> kWays{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

// The pixel on the right of a step along a border from a corner of pixels.
glm::ivec2 rightOf(glm::ivec2 corner, std::size_t way) {
    constexpr std::array<glm::ivec2, 4> kOffsets{{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
    return corner + kOffsets.at(way);
}

bool isIn(const Raster& raster, glm::ivec2 pixel) {
    return raster.at(pixel.x, pixel.y);
}

// Whether a step has the shape on its right and none on its left.
bool isBorder(const Raster& raster, glm::ivec2 corner, std::size_t way) {
    return isIn(raster, rightOf(corner, way)) && !isIn(raster, rightOf(corner, (way + 3) % 4));
}

// Once around from the upper left corner of a pixel, its way to the right being a border; marks the
// borders to the right that it takes.
Polyline walk(const Raster& raster, glm::ivec2 start, Raster& taken) {
    Polyline line;
    glm::ivec2 corner = start;
    std::size_t way = 0;
    do {
        line.emplace_back(corner);
        if (way == 0) taken.add(corner);
        corner += kWays.at(way);
        for (const std::size_t turn : {1, 0, 3})  // right, straight on, left
            if (isBorder(raster, corner, (way + turn) % 4)) {
                way = (way + turn) % 4;
                break;
            }
    } while (corner != start || way != 0);
    return line;
}

// The mean over some points before and after, every third point.
Polyline smoothed(const Polyline& line) {
    constexpr std::size_t kReach = 5, kEvery = 3;
    Polyline smooth;
    for (std::size_t i = 0; i < line.size(); i += kEvery) {
        glm::vec2 sum{};
        for (std::size_t k = 0; k <= 2 * kReach; ++k)
            sum += line[(i + line.size() + k - kReach) % line.size()];
        smooth.push_back(sum / static_cast<float>(2 * kReach + 1));
    }
    return smooth;
}

}  // namespace

void Raster::add(const std::array<glm::vec2, 3>& corners) {
    const auto& [a, b, c] = corners;
    const float area = cross(b - a, c - a);
    if (area == 0) return;
    const glm::ivec2 least = glm::max(glm::ivec2(glm::floor(glm::min(a, glm::min(b, c)))), 0);
    const glm::ivec2 most = glm::min(glm::ivec2(glm::ceil(glm::max(a, glm::max(b, c)))), size_ - 1);
    for (int y = least.y; y <= most.y; ++y)
        for (int x = least.x; x <= most.x; ++x) {
            const glm::vec2 p = glm::vec2{x, y} + 0.5F;
            const float u = cross(b - a, p - a) / area, v = cross(c - b, p - b) / area,
                        w = cross(a - c, p - c) / area;
            if (u >= 0 && v >= 0 && w >= 0) add(glm::ivec2{x, y});
        }
}

void Raster::add(const Raster& other) {
    assert(other.size_ == size_);
    for (std::size_t i = 0; i < inside_.size(); ++i) inside_[i] |= other.inside_[i];
}

bool Raster::isWithin(glm::vec2 at, int distance) const {
    const glm::ivec2 pixel(glm::floor(at));
    for (int y = -distance; y <= distance; ++y)
        for (int x = -distance; x <= distance; ++x)
            if (x * x + y * y <= distance * distance && !this->at(pixel.x + x, pixel.y + y))
                return false;
    return true;
}

std::vector<Polyline> contoursOf(const Raster& raster, std::size_t leastPixels) {
    std::vector<Polyline> lines;
    Raster taken(raster.sizePixels());
    for (int y = 0; y < raster.sizePixels().y; ++y)
        for (int x = 0; x < raster.sizePixels().x; ++x) {
            if (!isBorder(raster, {x, y}, 0) || taken.at(x, y)) continue;
            const Polyline line = walk(raster, {x, y}, taken);
            if (line.size() >= leastPixels) lines.push_back(smoothed(line));
        }
    return lines;
}

}  // namespace aquarama::drawings
