// SPDX-License-Identifier: Apache-2.0
// What a visitor sees of a world at one moment, from the rig, the viewer's eye and the fish. Rock
// and sand hide fish; one fish does not hide another. World frame in metres, where nothing else is
// said.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/config/rig.h"
#include "common/place/obstacles.h"
#include "common/wall/surface.h"
#include "master/fish/fish_view.h"
#include "master/surroundings/vessel.h"

namespace aquarama::study {

// Left, middle and right third of the wall's range of azimuth.
inline constexpr std::size_t kThirds = 3;
// Width and height of a cell, nearly: a whole number of cells fills the extent of the wall.
inline constexpr double kCellDegrees = 10;

// Where a line of sight meets the wall.
struct WallSpot {
    // One of WallExtent::cells(); nothing in a cell whose middle is off the screen.
    std::optional<std::size_t> cell;
    // Below kThirds.
    std::size_t third = 0;
};

// The extent of a wall as its viewer sees it, by azimuth and elevation, in cells. Directions are in
// the wall's frame, from between the viewer's eyes (Rig::sweetSpotMetres), of any length.
class WallExtent {
  public:
    // Throws Error where the file of a measured screen cannot be used.
    explicit WallExtent(const config::Rig& rig);

    // Number of cells whose middle is on the screen.
    [[nodiscard]] std::size_t cells() const { return cells_; }
    // Ranges of azimuth (x) and elevation (y), radians.
    [[nodiscard]] glm::dvec2 low() const { return low_; }
    [[nodiscard]] glm::dvec2 high() const { return high_; }
    // Nothing where the direction misses the screen.
    [[nodiscard]] std::optional<WallSpot> spotOf(glm::dvec3 direction) const;

  private:
    void measure();
    void enclose(glm::dvec3 direction);
    void reachPoles();
    void nameCells();
    [[nodiscard]] bool isOnScreen(glm::dvec3 direction) const;

    std::unique_ptr<const wall::ScreenSurface> screen_;
    glm::dvec3 eye_;
    glm::dvec2 low_{}, high_{};  // azimuth and elevation, radians
    std::size_t columns_ = 0, rows_ = 0;
    // By column and row, row after row.
    std::vector<std::optional<std::size_t>> numbers_;
    std::size_t cells_ = 0;
};

// From where and in which direction the wall is looked at.
struct WallPose {
    // Between the viewer's eyes.
    glm::dvec3 eye{};
    // A rotation.
    glm::dmat3 wallFromWorld{1.0};
};
// The pose of a viewer of this rig in the submarine.
[[nodiscard]] WallPose poseOf(const surroundings::Vessel& vessel, const config::Rig& rig);

// The smallest angle of a fish that counts as seen, and that of a large one.
inline constexpr double kLeastAngle = 0.5 * kRadiansPerDegree<double>;
inline constexpr double kLargeAngle = 1.0 * kRadiansPerDegree<double>;

// A fish that can be seen on the wall.
struct SeenFish {
    std::uint32_t fish = 0;
    // Its length across the line of sight, divided by its distance; radians.
    double angle = 0;
    WallSpot spot;
};

// The eyes of a visitor: which fish can be seen. Immutable.
class WallView {
  public:
    // `sight` has all rocks that may stand before a fish. Keeps a reference to the extent.
    WallView(const WallExtent& extent, place::Obstacles sight, double clarityMetres);

    // The fish, if it is there, at least kLeastAngle large, on the screen, within the clarity of
    // the water and its middle neither behind rock nor sand. O(rocks).
    [[nodiscard]] std::optional<SeenFish> seen(const fish::FishView& view,
                                               std::uint32_t fish,
                                               const WallPose& pose) const;
    // All that are seen, by index. O(fish x rocks).
    [[nodiscard]] std::vector<SeenFish> allSeen(const fish::FishView& view,
                                                const WallPose& pose) const;
    [[nodiscard]] const WallExtent& extent() const { return extent_; }

  private:
    [[nodiscard]] bool isInClearWater(double metres) const {
        return metres > 0 && metres <= clarityMetres_;
    }

    const WallExtent& extent_;
    place::Obstacles sight_;
    double clarityMetres_;
};

// Two fish of a species are linked where their bodies' origins are nearer than this, in body
// lengths (the mean of both).
inline constexpr float kLinkLengths = 5;

// The group of each fish, of one species and linked by chains of links: the lowest index in it. A
// fish that is away has none: kNobody. Fish of a species follow one another in the view.
[[nodiscard]] std::vector<std::uint32_t> groupsOf(const fish::FishView& view);

// The figures of one moment.
struct WallGlance {
    // Share of the cells that a fish is seen in, 0 to 1.
    double cellShare = 0;
    std::uint32_t inView = 0;
    // Large fish by third, and species with a large fish.
    std::array<std::uint32_t, kThirds> large{};
    std::uint32_t species = 0;
    // Share of the fish in view that belong to the largest group; 0 without any.
    double largestGroup = 0;
};
// `groups` as groupsOf() gives them.
[[nodiscard]] WallGlance glanceOf(std::span<const SeenFish> seen,
                                  const WallExtent& extent,
                                  const fish::FishView& view,
                                  std::span<const std::uint32_t> groups);

}  // namespace aquarama::study
