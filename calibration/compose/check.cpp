// SPDX-License-Identifier: Apache-2.0
#include "calibration/compose/check.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "common/base/units.h"
#include "common/config/scene.h"
#include "common/place/place.h"
#include "common/wall/wall.h"

namespace aquarama::compose {

namespace {

const char* nameOf(config::Role role) {
    if (role == config::Role::Prey) return "prey";
    return role == config::Role::Pacifist ? "pacifist" : "predator";
}

const char* nameOf(config::Gathering gathering) {
    if (gathering == config::Gathering::None) return "the school goes where its members go";
    return gathering == config::Gathering::Mill ? "the school mills"
                                                : "the school journeys past the eye";
}

// With a comma and a blank between them.
std::string joined(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list;
}

// Name, role, size, and whom it hunts or shadows.
std::string lineOf(const config::Species& species) {
    const config::Habits& habits = species.habits;
    std::string line = fmt::format("{}, {}, {:.3g} to {:.3g} m",
                                   species.name,
                                   nameOf(habits.role),
                                   double{species.size.leastMetres},
                                   double{species.size.mostMetres});
    if (!habits.hunts.empty()) line += "; hunts " + joined(habits.hunts);
    if (!habits.shadows.empty()) line += "; shadows " + joined(habits.shadows);
    return line;
}

// A tour without stops goes round the water.
std::string lineOfTour(const config::Scene& scene) {
    if (!scene.tour) return "submarine: stays at the eye until somebody steers\n";
    const std::size_t stops = scene.tour->stops.size();
    return fmt::format("submarine: tours {} at {:.3g} m/s after {:.4g} s without a hand\n",
                       stops > 0 ? fmt::format("{} stops", stops) : "round the water",
                       scene.tour->metresPerSecond,
                       scene.idleSeconds);
}

// A length of 0 means that the light never changes. `startsAt` is a share of a day.
std::string lineOf(const config::Day& day) {
    if (day.lengthSeconds <= 0)
        return fmt::format("light: always as at {:.3g} of a day\n", day.startsAt);
    return fmt::format("light: a day of {:.4g} s, from {:.3g} on, down to {:.3g} at midnight\n",
                       day.lengthSeconds,
                       day.startsAt,
                       day.night);
}

constexpr int kAlong = 12001;  // samples of the screen's mid-height; a hundredth of a degree each

// The azimuth of a point or direction of the wall frame, in degrees.
double degreesAt(glm::dvec3 point) {
    return wall::azimuthOf(point) / kRadiansPerDegree<double>;
}

// Such a screen is described by azimuths and by heights in metres, all others by angles from the
// sweet spot.
bool isUprightCylinder(const config::Screen& screen) {
    return screen.shape == config::ScreenShape::Cylinder && screen.tiltRadians == 0;
}

// Adds how much of this channel's picture another lights too, along the screen's mid-height.
void measureAlong(const wall::ScreenSurface& screen,
                  const wall::Optics& own,
                  const wall::Optics& other,
                  ChannelOverlap& overlap) {
    glm::dvec2 lastPixel{};
    double lastDegrees = 0;
    bool inside = false;
    for (int i = 0; i < kAlong; ++i) {
        const auto point = screen.at({static_cast<double>(i) / (kAlong - 1), 0.5});
        if (!point) continue;
        const auto pixel = own.pixelOf(*point);
        const bool shared = pixel && other.pixelOf(*point);
        if (shared && inside) {
            overlap.pixels += std::abs(pixel->x - lastPixel.x);
            overlap.degrees += degreesAt(*point) - lastDegrees;
        }
        inside = shared;
        if (shared) lastPixel = *pixel;
        lastDegrees = degreesAt(*point);
    }
}

// Places all over a channel's picture, and what they light.
std::vector<glm::dvec3> sampled(const wall::Optics& optics, glm::dvec2 sizePixels) {
    constexpr int kPlaces = 96;  // each way
    std::vector<glm::dvec3> points;
    for (int y = 0; y < kPlaces; ++y)
        for (int x = 0; x < kPlaces; ++x)
            if (const auto point =
                    optics.pointOf(sizePixels * (glm::dvec2(x, y) + 0.5) / double{kPlaces}, 0))
                points.push_back(*point);
    return points;
}

// Pixels per degree as seen from the sweet spot, in the middle of the picture.
glm::dvec2 densityOf(const wall::Optics& optics, glm::dvec2 sizePixels, glm::dvec3 sweetSpot) {
    const auto here = optics.pointOf(sizePixels / 2.0, 0);
    glm::dvec2 density(0);
    for (const int axis : {0, 1}) {
        glm::dvec2 step(0);
        step[axis] = 1;
        const auto next = optics.pointOf(sizePixels / 2.0 + step, 0);
        if (!here || !next) continue;
        const glm::dvec3 a = glm::normalize(*here - sweetSpot);
        const glm::dvec3 b = glm::normalize(*next - sweetSpot);
        density[axis] = kRadiansPerDegree<double> / glm::length(glm::cross(a, b));
    }
    return density;
}

// The same along and across an upright cylinder, in the middle of what the channel lights.
glm::dvec2 densityAt(const config::Screen& screen,
                     const wall::Wall& wall,
                     const wall::Optics& optics,
                     glm::dvec2 unrolledPosition) {
    constexpr double kStep = 1e-4;
    const auto pixelAt = [&](glm::dvec2 position) -> std::optional<glm::dvec2> {
        const auto point = wall.screen().at(position);
        return point ? optics.pixelOf(*point) : std::nullopt;
    };
    const auto here = pixelAt(unrolledPosition);
    const auto right = pixelAt(unrolledPosition + glm::dvec2(kStep, 0));
    const auto down = pixelAt(unrolledPosition + glm::dvec2(0, kStep));
    if (!here || !right || !down) return {};
    const double degreesRight = kStep * screen.arcRadians / kRadiansPerDegree<double>;
    const double degreesDown =
        std::atan(kStep * screen.heightMetres / screen.radiusMetres) / kRadiansPerDegree<double>;
    return {(right->x - here->x) / degreesRight, (down->y - here->y) / degreesDown};
}

// An azimuth in words.
std::string sideways(double degrees) {
    return fmt::format("{:.1f} deg {}", std::abs(degrees), degrees < 0 ? "left" : "right");
}

}  // namespace

// Throws Error where a species cannot be read or the water has no room for the fish.
std::string inventoryOf(const config::Scene& scene, const std::string& path) {
    const std::vector<config::CastSpecies> cast = config::readCastSpecies(scene, path);
    const std::size_t fish = config::fishIn(scene);
    const auto length = cast.front().species.size.meanMetres;
    place::checkRoom(scene, path, fish, length);

    std::string text =
        fmt::format("scene \"{}\": {}; {}\n",
                    scene.name,
                    scene.place == config::PlaceKind::Reef ? "a reef" : "the open sea",
                    nameOf(scene.gathering));
    for (std::size_t i = 0; i < cast.size(); ++i)
        text += fmt::format("{:7} ", scene.cast[i].fish) + lineOf(cast[i].species) +
                (scene.cast[i].start ? "; with a start" : "") + "\n";
    const place::Region water = place::waterFor(scene, fish, length);
    const glm::dvec3 size = glm::dvec3(water.halfExtent) * 2.0;
    const auto top = static_cast<double>(-water.centre.y) - size.y / 2;
    text += fmt::format(
        "water: {:.3g} x {:.3g} x {:.3g} m, {:.3g} to {:.3g} m deep, for up to {} fish\n",
        size.x,
        size.y,
        size.z,
        top,
        top + size.y,
        place::mostFishIn(scene, length));
    text += fmt::format("food: {} plankton, {} drops\n", scene.plankton, scene.drops.size());
    return text + lineOfTour(scene) + lineOf(scene.day) + path + ": good";
}

std::string inventoryOf(const config::Species& species, const std::string& path) {
    return "species " + lineOf(species) + "\n" + path + ": good";
}

namespace {

// What is lit, as azimuths, elevations and heights.
void measureReach(const std::vector<glm::dvec3>& lit, glm::dvec3 sweetSpot, ChannelSurvey& survey) {
    glm::dvec3 sum(0);
    for (const glm::dvec3& point : lit) sum += glm::normalize(point - sweetSpot);
    const double middle = degreesAt(sum);
    // Of what lies about the back, too: degrees beyond 180 go on.
    const auto degreesOf = [&](glm::dvec3 point) {
        return middle + std::remainder(degreesAt(point - sweetSpot) - middle, 360.0);
    };
    const auto [left, right] = std::ranges::minmax(lit, {}, degreesOf);
    const auto [low, high] = std::ranges::minmax(
        lit, {}, [&](glm::dvec3 point) { return wall::elevationOf(point - sweetSpot); });
    const auto [bottom, top] = std::ranges::minmax(lit, {}, &glm::dvec3::y);
    survey.leftDegrees = degreesOf(left);
    survey.rightDegrees = degreesOf(right);
    survey.bottomDegrees = wall::elevationOf(low - sweetSpot) / kRadiansPerDegree<double>;
    survey.topDegrees = wall::elevationOf(high - sweetSpot) / kRadiansPerDegree<double>;
    survey.bottomMetres = bottom.y;
    survey.topMetres = top.y;
}

// With every channel that lights a part of the same screen; panels share nothing.
std::vector<ChannelOverlap> overlapsOf(const config::Rig& rig,
                                       const wall::Wall& wall,
                                       std::size_t channel) {
    const wall::Optics& own = wall.channel(channel);
    const std::vector<glm::dvec3> points = sampled(own, rig.channels[channel].sizePixels);
    std::vector<ChannelOverlap> overlaps;
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        if (i == channel || rig.channels[i].panel) continue;
        const wall::Optics& other = wall.channel(i);
        const auto shared = std::ranges::count_if(
            points, [&](glm::dvec3 point) { return other.pixelOf(point).has_value(); });
        if (shared == 0) continue;
        ChannelOverlap overlap{.with = rig.channels[i].name};
        overlap.share = static_cast<double>(shared) / static_cast<double>(points.size());
        if (isUprightCylinder(rig.screen)) measureAlong(wall.screen(), own, other, overlap);
        overlaps.push_back(overlap);
    }
    return overlaps;
}

}  // namespace

// Azimuths on an upright cylinder are from the origin of the wall frame, on other screens from the
// sweet spot.
ChannelSurvey surveyChannel(const config::Rig& rig, const wall::Wall& wall, std::size_t channel) {
    assert(channel < rig.channels.size());
    const wall::Optics& own = wall.channel(channel);
    std::vector<glm::dvec3> lit = own.outline(0);
    ChannelSurvey survey;
    survey.name = rig.channels[channel].name;
    survey.isUpright = isUprightCylinder(rig.screen);
    survey.overlaps = overlapsOf(rig, wall, channel);
    if (!survey.isUpright) {
        std::ranges::copy(sampled(own, rig.channels[channel].sizePixels), std::back_inserter(lit));
        measureReach(lit, rig.sweetSpotMetres, survey);
        survey.pixelsPerDegree =
            densityOf(own, rig.channels[channel].sizePixels, rig.sweetSpotMetres);
        return survey;
    }
    measureReach(lit, glm::dvec3(0), survey);
    const auto [left, right] = std::ranges::minmax(lit, {}, wall::azimuthOf);
    const auto [bottom, top] = std::ranges::minmax(lit, {}, &glm::dvec3::y);
    const double u = (wall.screen().unrolled(left).x + wall.screen().unrolled(right).x) / 2;
    const double v = (wall.screen().unrolled(bottom).y + wall.screen().unrolled(top).y) / 2;
    survey.pixelsPerDegree = densityAt(rig.screen, wall, own, {u, v});
    return survey;
}

// Samples a grid of 601 by 151 places. Points that are masked or that no channel lights do not
// count.
double worstBlendSum(const wall::Wall& wall) {
    constexpr glm::ivec2 kGrid(601, 151);
    double worst = 0;
    for (int y = 0; y < kGrid.y; ++y)
        for (int x = 0; x < kGrid.x; ++x) {
            const glm::dvec2 t = glm::dvec2(x, y) / glm::dvec2(kGrid - 1);
            const auto point =
                wall.screen().at(wall::kDarkBorder + (1 - 2 * wall::kDarkBorder) * t);
            if (!point || wall.isMasked(*point)) continue;
            double sum = 0;
            for (std::size_t i = 0; i < wall.channels(); ++i) sum += wall.weight(i, *point);
            if (sum > 0) worst = std::max(worst, std::abs(sum - 1));
        }
    return worst;
}

namespace {

// An elevation in words.
std::string upward(double degrees) {
    return fmt::format("{:.1f} deg {}", std::abs(degrees), degrees < 0 ? "down" : "up");
}

}  // namespace

// A span of more than 350 degrees is called all round.
std::string oneLine(const ChannelSurvey& survey) {
    constexpr double kNearlyRound = 350;
    std::string line = survey.name + ": lights ";
    line += survey.rightDegrees - survey.leftDegrees > kNearlyRound
                ? "all round, "
                : sideways(survey.leftDegrees) + " to " + sideways(survey.rightDegrees) + ", ";
    line += survey.isUpright
                ? fmt::format("{:+.2f} to {:+.2f} m", survey.bottomMetres, survey.topMetres)
                : upward(survey.bottomDegrees) + " to " + upward(survey.topDegrees);
    line += fmt::format(
        "; {:.1f} x {:.1f} px per degree", survey.pixelsPerDegree.x, survey.pixelsPerDegree.y);
    for (const ChannelOverlap& overlap : survey.overlaps)
        line += (overlap.pixels > 0 ? fmt::format("; blends over {:.0f} px ({:.1f} deg) with ",
                                                  overlap.pixels,
                                                  overlap.degrees)
                                    : fmt::format("; blends over {:.0f} % of its picture with ",
                                                  100 * overlap.share)) +
                overlap.with;
    return line;
}

}  // namespace aquarama::compose
