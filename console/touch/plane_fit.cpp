// SPDX-License-Identifier: Apache-2.0
#include "console/touch/plane_fit.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat2x3.hpp>
#include <glm/matrix.hpp>

#include "common/base/log.h"
#include "common/base/units.h"

namespace aquarama::console {

namespace {

// Sine of the least angle between two sides of the three, and their least lengths.
constexpr double kLeastSine = 0.1;
constexpr double kLeastShare = 0.05;
constexpr double kLeastMetres = 0.05;

// How far somebody may stand beside a mark, or hold a hand beside it; what is told is of that.
constexpr double kBesideMetres = 0.05;

// A side in other directions than these is doubtful: of a rectangle, and in metres.
constexpr double kMostSkewDegrees = 15;
constexpr double kShortMetres = 0.3;
constexpr double kLongMetres = 40;
constexpr double kMostOfACorner = 4;

double crossLength(glm::dvec2 a, glm::dvec2 b) {
    return std::abs(a.x * b.y - a.y * b.x);
}
double crossLength(glm::dvec3 a, glm::dvec3 b) {
    return glm::length(glm::cross(a, b));
}

template <class Place>
void refuseNearlyOneLine(
    Place first, Place second, Place third, double least, const std::string& which) {
    const Place a = second - first;
    const Place b = third - first;
    const Place c = third - second;
    const double nearest = std::min({glm::length(a), glm::length(b), glm::length(c)});
    if (nearest < least)
        throw Error(which + " are nearly one place; choose marks that lie farther apart (--share)");
    const double longest = std::max({glm::length(a), glm::length(b), glm::length(c)});
    if (crossLength(a, b) < kLeastSine * longest * nearest)
        throw Error(which +
                    " lie nearly on one line; was each mark the right one, and does the tracker "
                    "watch a plane before the wall? Do it again");
}

// The shares of a place in the three marks; they sum to one.
glm::dvec3 weightsAt(const SeenMarks& marks, glm::dvec2 share) {
    const glm::dmat2 sides(marks[1].share - marks[0].share, marks[2].share - marks[0].share);
    const glm::dvec2 along = glm::inverse(sides) * (share - marks[0].share);
    return {1 - along.x - along.y, along.x, along.y};
}

glm::dvec3 cornerAt(const SeenMarks& marks, glm::dvec2 share) {
    const glm::dvec3 weights = weightsAt(marks, share);
    glm::dvec3 corner(0);
    for (int i = 0; i < 3; ++i) corner += weights[i] * marks[static_cast<std::size_t>(i)].point;
    return corner;
}

// Places beyond the edge are told as at it.
bool isAtTheEdge(const SeenMark& mark) {
    constexpr double kEdge = 0.002;
    const double nearest = std::min(std::min(mark.share.x, 1 - mark.share.x),
                                    std::min(mark.share.y, 1 - mark.share.y));
    return nearest < kEdge;
}

// Seen from the audience, or from above, the places run to the right and down.
bool isMirrored(const config::TouchedSurface& surface, const glm::dvec3& eye) {
    const glm::dvec3 across = surface.topRight - surface.topLeft;
    const glm::dvec3 down = surface.bottomLeft - surface.topLeft;
    const glm::dvec3 middle = surface.topLeft + (across + down) / 2.0;
    const glm::dvec3 looks = surface.peopleReachMetres ? glm::dvec3(0, -1, 0) : middle - eye;
    return glm::dot(glm::cross(across, down), looks) < 0;
}

}  // namespace

void fitCorners(const SeenMarks& marks, config::TouchedSurface& surface) {
    const auto& [one, two, three] = marks;
    refuseNearlyOneLine(one.point, two.point, three.point, kLeastMetres, "the three marks");
    refuseNearlyOneLine(
        one.share, two.share, three.share, kLeastShare, "the three places that were seen");
    surface.topLeft = cornerAt(marks, {0, 0});
    surface.topRight = cornerAt(marks, {1, 0});
    surface.bottomLeft = cornerAt(marks, {0, 1});
}

double worstOfACorner(const SeenMarks& marks) {
    double worst = 0;
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), {1, 0}, {0, 1}, {1, 1}})
        worst = std::max(worst, glm::length(weightsAt(marks, corner)));
    return worst;
}

std::vector<PlaneFinding> findingsOf(const config::TouchedSurface& surface,
                                     const SeenMarks& marks,
                                     const glm::dvec3& eye) {
    const glm::dvec3 across = surface.topRight - surface.topLeft;
    const glm::dvec3 down = surface.bottomLeft - surface.topLeft;
    const double wide = glm::length(across), high = glm::length(down);
    const double angle = std::acos(std::clamp(glm::dot(across, down) / wide / high, -1.0, 1.0)) /
                         kRadiansPerDegree<double>;
    const double worst = worstOfACorner(marks);
    std::vector<PlaneFinding> findings{
        {fmt::format("the tracker watches {:.2f} x {:.2f} m, whose sides make {:.0f} degrees; 5 cm "
                     "beside each mark puts a corner off by up to {:.0f} cm",
                     wide,
                     high,
                     angle,
                     100 * kBesideMetres * worst)}};
    const auto doubt = [&](bool isSo, const char* why) {
        if (isSo) findings.push_back({std::string("doubtful: ") + why, true});
    };
    if (isMirrored(surface, eye))
        findings.push_back(
            {"it sees the wall mirrored, as one behind the screen or overhead does; the corners "
             "set that right"});
    doubt(std::ranges::any_of(marks, isAtTheEdge),
          "a mark is at the edge of what the tracker watches, or beyond; choose marks nearer to "
          "the middle (--share 0.5)");
    doubt(std::abs(angle - 90) > kMostSkewDegrees,
          "trackers watch rectangles, whose sides make 90 degrees; was each mark the right one? Do "
          "it again");
    doubt(std::min(wide, high) < kShortMetres || std::max(wide, high) > kLongMetres,
          "no tracker watches a surface of that size; was each mark the right one? Do it again");
    doubt(worst > kMostOfACorner,
          "the marks took a small part of what the tracker watches; choose marks that lie farther "
          "apart (--share 1)");
    return findings;
}

}  // namespace aquarama::console
