// SPDX-License-Identifier: Apache-2.0
#include "console/touch/wall_marks.h"

#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "common/base/log.h"
#include "common/base/units.h"
#include "common/wall/pattern.h"
#include "common/wall/wall.h"

namespace aquarama::console {

namespace {

constexpr int kStep = static_cast<int>(wall::kGridDegrees);
constexpr int kBright = static_cast<int>(wall::kGridMajorDegrees);

// A hand reaches from here to there, from the height of a standing viewer's eye, metres.
constexpr double kReachDown = -1.0, kReachUp = 0.5;
// The floor is so far below the sweet spot, and whoever stands at the wall so far before it.
constexpr double kEyeMetres = 1.6;
constexpr double kBodyMetres = 0.3;

// A crossing of the grid: degrees to the right and up, as multiples of kStep.
using Crossing = std::pair<int, int>;
using Crossings = std::map<Crossing, glm::dvec3>;

bool isLit(const wall::Wall& wall, glm::dvec3 point) {
    for (std::size_t channel = 0; channel < wall.channels(); ++channel)
        if (wall.channel(channel).pixelOf(point)) return !wall.isMasked(point);
    return false;
}

// Where a line of sight of the grid meets the lit wall within a share of it.
std::optional<glm::dvec3> pointAlong(const wall::Wall& wall, Crossing crossing, double share) {
    const double right = crossing.first * kDegree, up = crossing.second * kDegree;
    const glm::dvec3 direction(
        std::cos(up) * std::sin(right), std::sin(up), -std::cos(up) * std::cos(right));
    const auto point = wall.screen().hit({wall.patternOrigin(), direction}, 0);
    if (!point) return std::nullopt;
    const glm::dvec2 off = glm::abs(wall.screen().unrolled(*point) - 0.5);
    const bool isWithin = std::max(off.x, off.y) <= share / 2 && isLit(wall, *point);
    return isWithin ? point : std::nullopt;
}

Crossings crossingsOf(const wall::Wall& wall, double share) {
    Crossings crossings;
    for (int right = -180 + kStep; right <= 180; right += kStep)
        for (int up = -90 + kStep; up < 90; up += kStep)
            if (const auto point = pointAlong(wall, {right, up}, share))
                crossings[{right, up}] = *point;
    return crossings;
}

Crossings withinReach(const Crossings& all, double eyeHeight) {
    Crossings reached;
    for (const auto& [crossing, point] : all)
        if (point.y >= eyeHeight + kReachDown && point.y <= eyeHeight + kReachUp)
            reached[crossing] = point;
    return reached;
}

double areaOf(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    return glm::length(glm::cross(b - a, c - a));
}

// How lines of one direction are told from each other.
struct LineNames {
    const char *negative, *positive, *beforeNegative, *beforePositive, *zero;
};
constexpr LineNames kUpright{"left", "right", "left of", "right of", "straight ahead"};
constexpr LineNames kLevel{"down", "up", "below", "above", "at eye level"};

std::string angleWords(int degrees, const LineNames& names) {
    if (degrees == 0) return names.zero;
    return fmt::format(
        "{} degrees {}", std::abs(degrees), degrees < 0 ? names.negative : names.positive);
}

// "the 2nd line left of the bright one straight ahead"
std::string lineWords(int degrees, const LineNames& names) {
    const int bright = degrees / kBright * kBright;
    const int lines = std::abs(degrees - bright) / kStep;
    const std::string brightOne = angleWords(bright, names);
    if (lines == 0) return "the bright line " + brightOne;
    constexpr std::array kOrdinals{"", "1st", "2nd", "3rd", "4th", "5th"};
    return fmt::format("the {} line {} the bright one {}",
                       kOrdinals.at(static_cast<std::size_t>(lines)),
                       degrees < 0 ? names.beforeNegative : names.beforePositive,
                       brightOne);
}

std::string wordsOf(Crossing crossing) {
    return fmt::format("hold a hand still at {}, {}: where {} crosses {}",
                       angleWords(crossing.first, kUpright),
                       angleWords(crossing.second, kLevel),
                       lineWords(crossing.first, kUpright),
                       lineWords(crossing.second, kLevel));
}

// Three crossings with the largest area between them: two at one height, one below the first.
std::optional<std::array<Crossing, 3>> widest(const Crossings& crossings) {
    double most = 0;
    std::optional<std::array<Crossing, 3>> best;
    const auto consider = [&](Crossing one, Crossing two, Crossing three) {
        if (!crossings.contains(two) || !crossings.contains(three)) return;
        const double area = areaOf(crossings.at(one), crossings.at(two), crossings.at(three));
        if (area <= most) return;
        most = area;
        best = {one, two, three};
    };
    for (const auto& [one, at] : crossings)
        for (int right = one.first + kStep; right <= 180; right += kStep)
            for (int up = one.second - kStep; up > -90; up -= kStep)
                consider(one, {right, one.second}, {one.first, up});
    return best;
}

[[noreturn]] void refuseFew() {
    throw Error(
        "the grid has no three crossings within that much of the wall; choose a larger --share");
}

// Where somebody stands before the wall under an upright line; the first of its crossings tells.
std::map<int, glm::dvec3> feetOf(const wall::Wall& wall, double share, double floor) {
    std::map<int, glm::dvec3> feet;
    for (const auto& [crossing, point] : crossingsOf(wall, share)) {
        glm::dvec3 off = wall.screen().normalAt(point);
        off.y = 0;
        if (glm::length(off) < 1e-9) continue;
        const glm::dvec3 stands = point + glm::normalize(off) * kBodyMetres;
        feet.emplace(crossing.first, glm::dvec3(stands.x, floor, stands.z));
    }
    return feet;
}

std::string standWords(int right) {
    return fmt::format("stand at the wall, as near as you can, at {}: before {}",
                       angleWords(right, kUpright),
                       lineWords(right, kUpright));
}

std::string spotWords(const wall::Wall& wall, glm::dvec3 eye) {
    const std::string words = "stand at the sweet spot, from where the picture is exactly right";
    const auto ahead = wall.screen().hit({eye, {0, 0, -1}}, 0);
    return ahead ? words + fmt::format(": {:.1f} m from the wall straight ahead", eye.z - ahead->z)
                 : words;
}

}  // namespace

WallMarks marksForHands(const config::Rig& rig, double share) {
    const wall::Wall wall(rig);
    const Crossings all = crossingsOf(wall, share);
    const Crossings near = withinReach(all, rig.sweetSpotMetres.y);
    auto chosen = widest(near);
    if (!chosen) chosen = widest(all);
    if (!chosen) refuseFew();
    WallMarks marks;
    for (std::size_t i = 0; i < marks.size(); ++i)
        marks.at(i) = {all.at(chosen->at(i)), wordsOf(chosen->at(i))};
    return marks;
}

WallMarks marksForPeople(const config::Rig& rig, double share) {
    const wall::Wall wall(rig);
    const glm::dvec3 spot = rig.sweetSpotMetres - glm::dvec3(0, kEyeMetres, 0);
    const auto feet = feetOf(wall, share, spot.y);
    double most = 0;
    std::pair<int, int> chosen;
    for (const auto& [left, one] : feet)
        for (const auto& [right, two] : feet)
            if (left < right && areaOf(one, two, spot) > most)
                std::tie(most, chosen) = std::pair(areaOf(one, two, spot), std::pair(left, right));
    if (most <= 0) refuseFew();
    return {{{feet.at(chosen.first), standWords(chosen.first)},
             {feet.at(chosen.second), standWords(chosen.second)},
             {spot, spotWords(wall, rig.sweetSpotMetres)}}};
}

}  // namespace aquarama::console
