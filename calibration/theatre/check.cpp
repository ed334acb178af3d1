// SPDX-License-Identifier: Apache-2.0
#include "calibration/theatre/check.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "common/base/units.h"
#include "common/config/scene.h"
#include "common/place/place.h"
#include "common/wall/pinhole.h"
#include "common/wall/wall.h"

namespace aquarama::theatre {

namespace {

// As printf(), up to 511 characters.
[[gnu::format(printf, 1, 2)]] std::string said(const char* format, ...) {
    char text[512];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return text;
}

const char* nameOf(config::Role role) {
    if (role == config::Role::Prey) return "prey";
    return role == config::Role::Pacifist ? "pacifist" : "predator";
}

const char* nameOf(config::Gathering gathering) {
    if (gathering == config::Gathering::None) return "the school goes where its members go";
    return gathering == config::Gathering::Mill ? "the school mills"
                                                : "the school journeys past the eye";
}

std::string joined(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list;
}

// Name, role, size, and whom it hunts or shadows.
std::string lineOf(const config::Species& species) {
    const config::Habits& habits = species.habits;
    std::string line = said("%s, %s, %.3g to %.3g m",
                            species.name.c_str(),
                            nameOf(habits.role),
                            double{species.size.leastMetres},
                            double{species.size.mostMetres});
    if (!habits.hunts.empty()) line += "; hunts " + joined(habits.hunts);
    if (!habits.shadows.empty()) line += "; shadows " + joined(habits.shadows);
    return line;
}

std::string lineOfTour(const config::Scene& scene) {
    if (!scene.tour) return "submarine: stays at the eye until somebody steers\n";
    const std::size_t stops = scene.tour->stops.size();
    return said("submarine: tours %s at %.3g m/s after %.4g s without a hand\n",
                stops > 0 ? said("%zu stops", stops).c_str() : "round the water",
                scene.tour->metresPerSecond,
                scene.idleSeconds);
}

std::string lineOf(const config::Day& day) {
    if (day.lengthSeconds <= 0) return said("light: always as at %.3g of a day\n", day.startsAt);
    return said("light: a day of %.4g s, from %.3g on, down to %.3g at midnight\n",
                day.lengthSeconds,
                day.startsAt,
                day.night);
}

constexpr int kAlong = 12001;  // samples of the screen's mid-height; a hundredth of a degree each

double degreesAt(glm::dvec3 point) {
    return wall::azimuthOf(point) / kRadiansPerDegree<double>;
}

// How much of this projector's picture a neighbour lights too, at the screen's mid-height.
ChannelOverlap overlapOf(const config::Screen& screen,
                         const wall::Pinhole& own,
                         const config::Channel& neighbour) {
    const wall::Pinhole other(neighbour);
    ChannelOverlap overlap;
    overlap.with = neighbour.name;
    glm::dvec2 lastPixel{};
    double lastDegrees = 0;
    bool inside = false;
    for (int i = 0; i < kAlong; ++i) {
        const glm::dvec3 point =
            wall::screenPointAt(screen, {static_cast<double>(i) / (kAlong - 1), 0.5});
        const auto pixel = own.pixelOf(point);
        const bool shared = pixel && other.pixelOf(point) && wall::lightsInside(own, point) &&
                            wall::lightsInside(other, point);
        if (shared && inside) {
            overlap.pixels += std::abs(pixel->x - lastPixel.x);
            overlap.degrees += degreesAt(point) - lastDegrees;
        }
        inside = shared;
        if (shared) lastPixel = *pixel;
        lastDegrees = degreesAt(point);
    }
    return overlap;
}

// Pixels per degree as seen from the sweet spot, by the closest thing to a derivative.
glm::dvec2 densityAt(const config::Screen& screen,
                     const wall::Pinhole& projector,
                     glm::dvec2 unrolledPosition) {
    constexpr double kStep = 1e-4;
    const auto here = projector.pixelOf(wall::screenPointAt(screen, unrolledPosition));
    const auto right =
        projector.pixelOf(wall::screenPointAt(screen, unrolledPosition + glm::dvec2(kStep, 0)));
    const auto down =
        projector.pixelOf(wall::screenPointAt(screen, unrolledPosition + glm::dvec2(0, kStep)));
    if (!here || !right || !down) return {};
    const double degreesRight = kStep * screen.arcRadians / kRadiansPerDegree<double>;
    const double degreesDown =
        std::atan(kStep * screen.heightMetres / screen.radiusMetres) / kRadiansPerDegree<double>;
    return {(right->x - here->x) / degreesRight, (down->y - here->y) / degreesDown};
}

// An azimuth in words.
std::string sideways(double degrees) {
    char text[48];
    std::snprintf(
        text, sizeof text, "%.1f deg %s", std::abs(degrees), degrees < 0 ? "left" : "right");
    return text;
}

}  // namespace

std::string inventoryOf(const config::Scene& scene, const std::string& path) {
    const std::vector<config::CastSpecies> cast = config::readCastSpecies(scene, path);
    const std::size_t fish = config::fishIn(scene);
    const auto length = cast.front().species.size.meanMetres;
    place::checkRoom(scene, path, fish, length);

    std::string text = said("scene \"%s\": %s; %s\n",
                            scene.name.c_str(),
                            scene.place == config::PlaceKind::Reef ? "a reef" : "the open sea",
                            nameOf(scene.gathering));
    for (std::size_t i = 0; i < cast.size(); ++i)
        text += said("%7u ", scene.cast[i].fish) + lineOf(cast[i].species) +
                (scene.cast[i].start ? "; with a start" : "") + "\n";
    const place::Region water = place::waterFor(scene, fish, length);
    const glm::dvec3 size = glm::dvec3(water.halfExtent) * 2.0;
    const auto top = static_cast<double>(-water.centre.y) - size.y / 2;
    text += said("water: %.3g x %.3g x %.3g m, %.3g to %.3g m deep, for up to %u fish\n",
                 size.x,
                 size.y,
                 size.z,
                 top,
                 top + size.y,
                 place::mostFishIn(scene, length));
    text += said("food: %u plankton, %zu drops\n", scene.plankton, scene.drops.size());
    return text + lineOfTour(scene) + lineOf(scene.day) + path + ": good\n";
}

std::string inventoryOf(const config::Species& species, const std::string& path) {
    return "species " + lineOf(species) + "\n" + path + ": good\n";
}

ChannelSurvey surveyChannel(const config::Rig& rig, std::size_t channel) {
    assert(channel < rig.channels.size());
    const wall::Pinhole own(rig.channels[channel]);
    const std::vector<glm::dvec3> lit = wall::litOutline(rig.screen, own, 0);
    const auto [left, right] = std::ranges::minmax(lit, {}, wall::azimuthOf);
    const auto [bottom, top] = std::ranges::minmax(lit, {}, &glm::dvec3::y);
    ChannelSurvey survey;
    survey.name = rig.channels[channel].name;
    survey.leftDegrees = degreesAt(left);
    survey.rightDegrees = degreesAt(right);
    survey.bottomMetres = bottom.y;
    survey.topMetres = top.y;
    const double u = (wall::unrolled(rig.screen, left).x + wall::unrolled(rig.screen, right).x) / 2;
    const double v = (wall::unrolled(rig.screen, bottom).y + wall::unrolled(rig.screen, top).y) / 2;
    survey.pixelsPerDegree = densityAt(rig.screen, own, {u, v});
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        if (i == channel) continue;
        const ChannelOverlap overlap = overlapOf(rig.screen, own, rig.channels[i]);
        if (overlap.pixels > 0) survey.overlaps.push_back(overlap);
    }
    return survey;
}

double worstBlendSum(const config::Rig& rig) {
    const wall::Blend blend(rig);
    constexpr glm::ivec2 kGrid(601, 151);
    double worst = 0;
    for (int y = 0; y < kGrid.y; ++y)
        for (int x = 0; x < kGrid.x; ++x) {
            const glm::dvec2 t = glm::dvec2(x, y) / glm::dvec2(kGrid - 1);
            const glm::dvec2 at = wall::kDarkBorder + (1 - 2 * wall::kDarkBorder) * t;
            double sum = 0;
            for (std::size_t i = 0; i < rig.channels.size(); ++i)
                sum += blend.weight(i, wall::screenPointAt(rig.screen, at));
            worst = std::max(worst, std::abs(sum - 1));
        }
    return worst;
}

std::string oneLine(const ChannelSurvey& survey) {
    char numbers[128];
    std::snprintf(numbers,
                  sizeof numbers,
                  ", %+.2f to %+.2f m; %.1f x %.1f px per degree",
                  survey.bottomMetres,
                  survey.topMetres,
                  survey.pixelsPerDegree.x,
                  survey.pixelsPerDegree.y);
    std::string line = survey.name + ": lights " + sideways(survey.leftDegrees) + " to " +
                       sideways(survey.rightDegrees) + numbers;
    for (const ChannelOverlap& overlap : survey.overlaps) {
        std::snprintf(numbers,
                      sizeof numbers,
                      "; blends over %.0f px (%.1f deg) with ",
                      overlap.pixels,
                      overlap.degrees);
        line += numbers + overlap.with;
    }
    return line;
}

}  // namespace aquarama::theatre
