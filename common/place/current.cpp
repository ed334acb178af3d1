// SPDX-License-Identifier: Apache-2.0
#include "common/place/current.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace aquarama::place {

namespace {

// Width of a cell of the grid.
constexpr float kLatticeMetres = 0.5F;
// The crown's effect ends this far above it; the lee ends this far behind a boulder.
constexpr float kCrownMetres = 1.0F;
constexpr float kLeeMetres = 1.0F;
// Across the tide a boulder bends the current within this many of its radii.
constexpr float kWidestRadii = 1.2F;

std::int64_t ticksOf(double seconds) {
    return static_cast<std::int64_t>(seconds * static_cast<double>(kTicksPerSecond));
}

// The share of a period, 0 to 1, at a tick.
float shareOf(double seconds, std::int64_t tick) {
    const std::int64_t period = ticksOf(seconds);
    const std::int64_t rest = tick % period;
    return static_cast<float>(rest < 0 ? rest + period : rest) / static_cast<float>(period);
}

// The integral of wave() from 0 to a share of the period, in periods: 0 at 0 and 1, 1/3 between.
float waveIntegral(float share) {
    const float half = 2 * share - 1;
    const float size = half < 0 ? -half : half;
    return 1.0F / 3 - size * size + (2.0F / 3) * size * size * size;
}

float ramp(float from, float to, float at) {
    return std::clamp((at - from) / (to - from), 0.0F, 1.0F);
}

// The factor at a place by one boulder, with the tide towards `way`, 1 or -1, along x.
void bend(const Rock& rock, glm::vec3 place, float way, float& crown, float& lee) {
    const glm::vec3 from = place - rock.centre;
    if (std::abs(from.x) > kWidestRadii * rock.radiusMetres + kLeeMetres) return;
    const float across = std::sqrt(from.x * from.x + from.z * from.z);
    const float above = from.y - rock.radiusMetres;
    // Over the crown: fully at it, falling with the height and beside it.
    if (above > -0.5F * rock.radiusMetres) {
        const float share =
            (1 - ramp(0, kCrownMetres, above)) *
            (1 - ramp(0.6F * rock.radiusMetres, kWidestRadii * rock.radiusMetres, across));
        crown = std::max(crown, 1 + (kOverCrown - 1) * share);
    }
    // Behind it, as wide and as high as the boulder.
    const float behind = way * from.x;
    if (behind <= 0 || above > 0) return;
    const float aside =
        std::sqrt(from.z * from.z + std::max(0.0F, from.y) * std::max(0.0F, from.y));
    const float share =
        (1 - ramp(0.7F * rock.radiusMetres, kWidestRadii * rock.radiusMetres, aside)) *
        (1 - ramp(rock.radiusMetres, rock.radiusMetres + kLeeMetres, behind));
    lee = std::min(lee, 1 - (1 - kInLee) * share);
}

}  // namespace

glm::vec3 openCurrent(const config::SceneCurrent& current, std::int64_t tick) {
    const float tide =
        static_cast<float>(current.tideMetresPerSecond) * wave(shareOf(current.tideSeconds, tick));
    const float surge = static_cast<float>(current.surgeMetresPerSecond) *
                        wave(shareOf(current.surgeSeconds, tick));
    return glm::vec3{tide, 0, 0} + kSurgeCourse * surge;
}

glm::vec3 openDrift(const config::SceneCurrent& current, std::int64_t tick) {
    const float tide = static_cast<float>(current.tideMetresPerSecond * current.tideSeconds) *
                       waveIntegral(shareOf(current.tideSeconds, tick));
    const float surge = static_cast<float>(current.surgeMetresPerSecond * current.surgeSeconds) *
                        waveIntegral(shareOf(current.surgeSeconds, tick));
    return glm::vec3{tide, 0, 0} + kSurgeCourse * surge;
}

Current::Current(const config::SceneCurrent& current,
                 std::span<const Rock> rocks,
                 const Region& water)
    : current_{current}, origin_{water.centre - water.halfExtent} {
    if (current.tideMetresPerSecond <= 0 && current.surgeMetresPerSecond <= 0) return;
    const auto corners = [](float half) { return static_cast<int>(2 * half / kLatticeMetres) + 2; };
    countX_ = corners(water.halfExtent.x);
    countY_ = corners(water.halfExtent.y);
    countZ_ = corners(water.halfExtent.z);
    const auto cornerAt = [&](int x, int y, int z) {
        return origin_ +
               glm::vec3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)} *
                   kLatticeMetres;
    };
    std::vector<Rock> near;
    for (int z = 0; z < countZ_; ++z) {
        const float rowZ = cornerAt(0, 0, z).z;
        near.clear();
        std::ranges::copy_if(rocks, std::back_inserter(near), [&](const Rock& rock) {
            return std::abs(rock.centre.z - rowZ) <= kWidestRadii * rock.radiusMetres;
        });
        for (int y = 0; y < countY_; ++y)
            for (int x = 0; x < countX_; ++x)
                for (const float way : {1.0F, -1.0F}) {
                    float crown = 1;
                    float lee = 1;
                    for (const Rock& rock : near) bend(rock, cornerAt(x, y, z), way, crown, lee);
                    factors_.push_back(crown * lee);
                }
    }
    isOpen_.resize(factors_.size() / 2);
    for (int z = 0; z + 1 < countZ_; ++z)
        for (int y = 0; y + 1 < countY_; ++y)
            for (int x = 0; x + 1 < countX_; ++x)
                isOpen_[indexOf(x, y, z)] = isOpenFrom(x, y, z) ? 1 : 0;
}

bool Current::isOpenFrom(int x, int y, int z) const {
    for (const int dz : {0, 1})
        for (const int dy : {0, 1})
            for (const int dx : {0, 1}) {
                const std::size_t corner = indexOf(x + dx, y + dy, z + dz);
                if (factors_[2 * corner] != 1 || factors_[2 * corner + 1] != 1) return false;
            }
    return true;
}

Current::Cell Current::cellOf(glm::vec3 position) const {
    const glm::vec3 cell = (position - origin_) * (1 / kLatticeMetres);
    const auto within = [](float at, int count) {
        return std::clamp(at, 0.0F, static_cast<float>(count) - 1.001F);
    };
    const glm::vec3 at{within(cell.x, countX_), within(cell.y, countY_), within(cell.z, countZ_)};
    const int x = static_cast<int>(at.x);
    const int y = static_cast<int>(at.y);
    const int z = static_cast<int>(at.z);
    return {
        x,
        y,
        z,
        {at.x - static_cast<float>(x), at.y - static_cast<float>(y), at.z - static_cast<float>(z)}};
}

void Current::fetch(glm::vec3 position) const {
    if (isStill()) return;
    const Cell cell = cellOf(position);
    __builtin_prefetch(&isOpen_[indexOf(cell.x, cell.y, cell.z)]);
    for (const int dz : {0, 1})
        for (const int dy : {0, 1})
            __builtin_prefetch(&factors_[2 * indexOf(cell.x, cell.y + dy, cell.z + dz)]);
}

glm::vec3 Current::at(glm::vec3 position, glm::vec3 open) const {
    if (isStill()) return {};
    const Cell cell = cellOf(position);
    if (isOpen_[indexOf(cell.x, cell.y, cell.z)] != 0) return open;
    const std::size_t side = open.x < 0 ? 1 : 0;
    const auto corner = [&](int dx, int dy, int dz) {
        return factors_[2 * indexOf(cell.x + dx, cell.y + dy, cell.z + dz) + side];
    };
    const auto along = [&](int dy, int dz) {
        return corner(0, dy, dz) + (corner(1, dy, dz) - corner(0, dy, dz)) * cell.share.x;
    };
    const auto plane = [&](int dz) {
        return along(0, dz) + (along(1, dz) - along(0, dz)) * cell.share.y;
    };
    return open * (plane(0) + (plane(1) - plane(0)) * cell.share.z);
}

}  // namespace aquarama::place
