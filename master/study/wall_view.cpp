// SPDX-License-Identifier: Apache-2.0
#include "master/study/wall_view.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "common/base/units.h"
#include "master/behaviour/vision.h"

namespace aquarama::study {

namespace {

// Distance of the directions that are tried for what is inside the border of a screen.
constexpr double kStep = 1 * kDegree;

glm::dvec3 directionOf(glm::dvec2 azimuthElevation) {
    const auto [azimuth, elevation] = std::pair(azimuthElevation.x, azimuthElevation.y);
    return {std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation),
            -std::cos(elevation) * std::cos(azimuth)};
}

// Calls visit for directions to all sides, in azimuth and elevation, radians.
template <class Visit>
void toAllSides(Visit visit) {
    constexpr double kHalfTurn = std::numbers::pi;
    for (double azimuth = -kHalfTurn + kStep / 2; azimuth < kHalfTurn; azimuth += kStep)
        for (double elevation = (kStep - kHalfTurn) / 2; elevation < kHalfTurn / 2;
             elevation += kStep)
            visit(glm::dvec2(azimuth, elevation));
}

std::size_t cellsAlong(double radians) {
    return static_cast<std::size_t>(std::max(1.0, std::round(radians / (kCellDegrees * kDegree))));
}

// Index of a share (0 to 1) among so many equal parts.
std::size_t partAt(double share, std::size_t parts) {
    const auto part = static_cast<std::ptrdiff_t>(std::floor(share * static_cast<double>(parts)));
    return static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(part, 0, static_cast<std::ptrdiff_t>(parts) - 1));
}

}  // namespace

WallExtent::WallExtent(const config::Rig& rig)
    : screen_{wall::makeSurface(rig)}, eye_{rig.sweetSpotMetres} {
    measure();
    columns_ = cellsAlong(high_.x - low_.x);
    rows_ = cellsAlong(high_.y - low_.y);
    nameCells();
}

// The box about the border, and about all directions to the screen: a screen may go round the
// viewer, or over him.
void WallExtent::measure() {
    constexpr double kQuarter = std::numbers::pi / 2;
    low_ = {2 * kQuarter, kQuarter};
    high_ = -low_;
    for (const glm::dvec3& point : screen_->border(0)) enclose(point - eye_);
    toAllSides([&](glm::dvec2 at) {
        if (isOnScreen(directionOf(at))) enclose(directionOf(at));
    });
    reachPoles();
    assert(high_.x > low_.x && high_.y > low_.y);
}

// No direction that was tried is quite at the back, the zenith or the nadir.
void WallExtent::reachPoles() {
    constexpr double kQuarter = std::numbers::pi / 2;
    if (high_.x - low_.x > 4 * kQuarter - 2 * kStep) low_.x = -2 * kQuarter, high_.x = 2 * kQuarter;
    if (high_.y > kQuarter - kStep) high_.y = kQuarter;
    if (low_.y < kStep - kQuarter) low_.y = -kQuarter;
}

void WallExtent::enclose(glm::dvec3 direction) {
    const glm::dvec2 at(wall::azimuthOf(direction), wall::elevationOf(direction));
    low_ = glm::min(low_, at);
    high_ = glm::max(high_, at);
}

void WallExtent::nameCells() {
    const glm::dvec2 size = (high_ - low_) / glm::dvec2(columns_, rows_);
    for (std::size_t row = 0; row < rows_; ++row)
        for (std::size_t column = 0; column < columns_; ++column) {
            const glm::dvec2 middle = low_ + (glm::dvec2(column, row) + 0.5) * size;
            const bool isCell = isOnScreen(directionOf(middle));
            numbers_.push_back(isCell ? std::optional(cells_++) : std::nullopt);
        }
}

bool WallExtent::isOnScreen(glm::dvec3 direction) const {
    return screen_->hit({eye_, direction}, 0).has_value();
}

std::optional<WallSpot> WallExtent::spotOf(glm::dvec3 direction) const {
    if (!isOnScreen(direction)) return std::nullopt;
    const glm::dvec2 at(wall::azimuthOf(direction), wall::elevationOf(direction));
    const glm::dvec2 share = (at - low_) / (high_ - low_);
    return WallSpot{numbers_[partAt(share.y, rows_) * columns_ + partAt(share.x, columns_)],
                    partAt(share.x, kThirds)};
}

WallPose poseOf(const surroundings::Vessel& vessel, const config::Rig& rig) {
    const motion::Quaternion q = surroundings::worldFromBody(vessel.attitude);
    const glm::dmat3 worldFromWall = glm::mat3_cast(glm::dquat(q.w, q.x, q.y, q.z));
    return {glm::dvec3(vessel.position) + worldFromWall * rig.sweetSpotMetres,
            glm::transpose(worldFromWall)};
}

WallView::WallView(const WallExtent& extent, place::Obstacles sight, double clarityMetres)
    : extent_{extent}, sight_{std::move(sight)}, clarityMetres_{clarityMetres} {}

std::optional<SeenFish> WallView::seen(const fish::FishView& view,
                                       std::uint32_t fish,
                                       const WallPose& pose) const {
    if (view.shows(fish, fish::kAway)) return std::nullopt;
    const fish::VisibleFish& body = view.fish[fish];
    const glm::dvec3 heading(body.heading);
    const double length{body.length};
    // From the origin of the body frame to the middle of the body.
    constexpr double kToMiddle = double{fish::kNoseBodyLengths} - 0.5;
    const glm::dvec3 offset = glm::dvec3(body.position) + kToMiddle * length * heading - pose.eye;
    const double distance = glm::length(offset);
    if (!isInClearWater(distance)) return std::nullopt;
    const glm::dvec3 sight = offset / distance;
    const double across = length * glm::length(heading - glm::dot(heading, sight) * sight);
    const double angle = across / distance;
    if (angle < kLeastAngle) return std::nullopt;
    const std::optional<WallSpot> spot = extent_.spotOf(pose.wallFromWorld * sight);
    if (!spot || behaviour::terrainHides(sight_, {glm::vec3(pose.eye), glm::vec3(offset)}))
        return std::nullopt;
    return SeenFish{fish, angle, *spot};
}

std::vector<SeenFish> WallView::allSeen(const fish::FishView& view, const WallPose& pose) const {
    std::vector<SeenFish> all;
    for (std::uint32_t fish = 0; fish < view.size(); ++fish)
        if (const auto found = seen(view, fish, pose)) all.push_back(*found);
    return all;
}

namespace {

// Sets of fish that are joined pair by pair; each is named by its lowest index.
class JoinedSets {
  public:
    explicit JoinedSets(std::size_t fish) : parent_(fish) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    [[nodiscard]] std::uint32_t nameOf(std::uint32_t fish) {
        while (parent_[fish] != fish) {
            parent_[fish] = parent_[parent_[fish]];
            fish = parent_[fish];
        }
        return fish;
    }
    void join(std::uint32_t one, std::uint32_t other) {
        const auto [low, high] = std::minmax({nameOf(one), nameOf(other)});
        parent_[high] = low;
    }

  private:
    std::vector<std::uint32_t> parent_;
};

bool areLinked(const fish::VisibleFish& one, const fish::VisibleFish& other) {
    const float reach = kLinkLengths * 0.5F * (one.length + other.length);
    return glm::distance(one.position, other.position) < reach;
}

// Joins those of one species that are linked. Along x the search ends where no link is that long.
void joinLinked(const fish::FishView& view, std::vector<std::uint32_t>& fish, JoinedSets& sets) {
    std::ranges::sort(fish, {}, [&](std::uint32_t i) { return std::pair(view.position(i).x, i); });
    float longest = 0;
    for (const std::uint32_t i : fish) longest = std::max(longest, view.fish[i].length);
    for (std::size_t i = 0; i < fish.size(); ++i)
        for (std::size_t j = i + 1; j < fish.size(); ++j) {
            const float ahead = view.position(fish[j]).x - view.position(fish[i]).x;
            if (ahead > kLinkLengths * longest) break;
            if (areLinked(view.fish[fish[i]], view.fish[fish[j]])) sets.join(fish[i], fish[j]);
        }
}

double largestShare(std::span<const SeenFish> seen, std::span<const std::uint32_t> groups) {
    std::vector<std::uint32_t> sizes(groups.size());
    std::uint32_t largest = 0;
    for (const SeenFish& fish : seen) largest = std::max(largest, ++sizes[groups[fish.fish]]);
    return seen.empty() ? 0 : static_cast<double>(largest) / static_cast<double>(seen.size());
}

}  // namespace

namespace {

// The names of the sets of all fish; a fish that is away has none.
std::vector<std::uint32_t> namesOf(JoinedSets& sets, const fish::FishView& view) {
    std::vector<std::uint32_t> names(view.size(), fish::kNobody);
    for (std::uint32_t fish = 0; fish < view.size(); ++fish)
        if (!view.shows(fish, fish::kAway)) names[fish] = sets.nameOf(fish);
    return names;
}

}  // namespace

std::vector<std::uint32_t> groupsOf(const fish::FishView& view) {
    JoinedSets sets(view.size());
    std::vector<std::uint32_t> species;
    for (std::uint32_t fish = 0; fish < view.size(); ++fish) {
        if (!view.shows(fish, fish::kAway)) species.push_back(fish);
        const bool isLast = fish + 1 == view.size() || view.kind[fish + 1] != view.kind[fish];
        if (!isLast) continue;
        joinLinked(view, species, sets);
        species.clear();
    }
    return namesOf(sets, view);
}

WallGlance glanceOf(std::span<const SeenFish> seen,
                    const WallExtent& extent,
                    const fish::FishView& view,
                    std::span<const std::uint32_t> groups) {
    assert(groups.size() == view.size());
    WallGlance glance;
    glance.inView = static_cast<std::uint32_t>(seen.size());
    std::vector<bool> occupied(extent.cells());
    std::array<bool, kMostSpecies> species{};
    for (const SeenFish& fish : seen) {
        if (fish.spot.cell) occupied[*fish.spot.cell] = true;
        if (fish.angle < kLargeAngle) continue;
        ++glance.large.at(fish.spot.third);
        species.at(view.kind[fish.fish]) = true;
    }
    glance.cellShare = static_cast<double>(std::ranges::count(occupied, true)) /
                       static_cast<double>(std::max<std::size_t>(extent.cells(), 1));
    glance.species = static_cast<std::uint32_t>(std::ranges::count(species, true));
    glance.largestGroup = largestShare(seen, groups);
    return glance;
}

}  // namespace aquarama::study
