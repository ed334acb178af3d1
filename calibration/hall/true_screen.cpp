// SPDX-License-Identifier: Apache-2.0
#include "calibration/hall/true_screen.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "calibration/hall/chance.h"
#include "common/base/log.h"

namespace aquarama::hall {

namespace {

constexpr std::uint32_t kWaves = 14;
constexpr double kBefore = 0.3;  // metres: more than any bump

// A flat screen that fills the view of the curved one.
config::Screen flattened(const config::Screen& curved) {
    const bool isDome = curved.shape == config::ScreenShape::Dome;
    const double arc = curved.arcRadians * curved.radiusMetres;
    return {.shape = config::ScreenShape::Flat,
            .widthMetres = arc,
            .heightMetres = isDome ? arc : curved.heightMetres,
            .distanceMetres = curved.radiusMetres,
            // A dome's axis points up where a wall's middle is ahead.
            .tiltRadians = curved.tiltRadians - (isDome ? std::numbers::pi / 2 : 0.0)};
}

config::Rig trueRig(config::Rig rig, const config::Hall& hall) {
    config::Screen& screen = rig.screen;
    if (screen.shape == config::ScreenShape::Panels)
        throw Error(rig.name + ": a hall of panels is not simulated: give a rig of projectors");
    const bool isCurved = screen.radiusMetres > 0;
    if (hall.faults.flatScreen && isCurved) screen = flattened(screen);
    screen.radiusMetres *= hall.screen.radiusFactor;
    screen.distanceMetres *= hall.screen.radiusFactor;
    screen.arcRadians *= hall.screen.sizeFactor;
    screen.widthMetres *= hall.screen.sizeFactor;
    screen.heightMetres *= hall.screen.sizeFactor;
    screen.tiltRadians += hall.screen.tiltRadians;
    return rig;
}

glm::dvec3 along(const wall::Ray& ray, double t) {
    return ray.origin + t * ray.direction;
}

}  // namespace

TrueScreen::TrueScreen(const config::Rig& rig, const config::Hall& hall)
    : shape_{wall::makeSurface(trueRig(rig, hall))} {
    addBumps(hall.screen);
    addDents(hall.screen);
    addMarks(hall.screen, hall.faults.flatScreen ? config::ScreenShape::Flat : rig.screen.shape);
}

// Adds waves of random directions in space, so that no shape has a seam or a pole. The highest bump
// has the height that is asked for.
void TrueScreen::addBumps(const config::HallScreen& screen) {
    if (screen.bumpMetres == 0) return;
    Chance chance(screen.bumpSeed);
    for (std::uint32_t i = 0; i < kWaves; ++i) {
        const double length = screen.bumpDistanceMetres * chance.between(0.7, 1.5);
        waves_.push_back({chance.direction() * (2 * std::numbers::pi / length),
                          chance.between(0, 2 * std::numbers::pi),
                          1.0});
    }
    const double highest = highestBump();
    for (Wave& wave : waves_) wave.metres = screen.bumpMetres / highest;
}

double TrueScreen::highestBump() const {
    double highest = 0;
    constexpr int kSteps = 128;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const glm::dvec2 place = (glm::dvec2(i % kSteps, i / kSteps) + 0.5) / double{kSteps};
        if (const auto foot = shape_->at(place))
            highest = std::max(highest, std::abs(heightAt(*foot)));
    }
    return highest;
}

void TrueScreen::addDents(const config::HallScreen& screen) {
    for (const config::HallDent& dent : screen.dents)
        if (const auto middle = shape_->at(dent.place))
            dents_.push_back({*middle, dent.radiusMetres, dent.depthMetres});
}

void TrueScreen::addMarks(const config::HallScreen& screen, config::ScreenShape shape) {
    marksOff_ = screen.marksOffMetres;
    if (!marksOff_.empty()) marks_ = wall::markPlaces(shape, *shape_);
    marks_.resize(std::min(marks_.size(), marksOff_.size()));
}

double TrueScreen::heightAt(glm::dvec3 foot) const {
    double height = 0;
    for (const Wave& wave : waves_)
        height += wave.metres * std::sin(glm::dot(wave.number, foot) + wave.phase);
    for (const Dent& dent : dents_) {
        const glm::dvec3 off = foot - dent.middle;
        const double share = 1 - glm::dot(off, off) / (dent.radius * dent.radius);
        if (share > 0) height -= dent.depth * share * share;
    }
    return height;
}

glm::dvec3 TrueScreen::slopeAt(glm::dvec3 foot) const {
    glm::dvec3 slope(0);
    for (const Wave& wave : waves_)
        slope += wave.metres * std::cos(glm::dot(wave.number, foot) + wave.phase) * wave.number;
    for (const Dent& dent : dents_) {
        const glm::dvec3 off = foot - dent.middle;
        const double square = dent.radius * dent.radius;
        const double share = 1 - glm::dot(off, off) / square;
        if (share > 0) slope += 4 * dent.depth * share / square * off;
    }
    return slope;
}

// Searches from a little before the screen back to it.
std::optional<glm::dvec3> TrueScreen::footOf(glm::dvec3 point) const {
    const glm::dvec3 normal = glm::normalize(shape_->normalAt(point));
    return shape_->hit({point + kBefore * normal, -normal}, kDrapeMetres);
}

std::optional<double> TrueScreen::gap(glm::dvec3 point, glm::dvec3& foot) const {
    const auto found = footOf(point);
    if (!found) return std::nullopt;
    foot = *found;
    return glm::dot(point - foot, glm::normalize(shape_->normalAt(foot))) - heightAt(foot);
}

std::optional<TrueScreen::Meeting> TrueScreen::meet(const wall::Ray& ray) const {
    const auto smooth = shape_->hit(ray, kDrapeMetres);
    if (!smooth) return std::nullopt;
    Meeting meeting;
    if (!approach(ray, *smooth, meeting)) return std::nullopt;
    const glm::dvec3 normal = glm::normalize(shape_->normalAt(meeting.foot));
    meeting.isScreen = shape_->hit({meeting.foot + kBefore * normal, -normal}, 0).has_value();
    for (std::size_t i = 0; i < marks_.size(); ++i)
        meeting.isMarked |= marks_[i].covers(meeting.foot, marksOff_[i], 0);
    return meeting;
}

// Uses the secant method, from the point where the ray meets the smooth shape.
bool TrueScreen::approach(const wall::Ray& ray, glm::dvec3 smooth, Meeting& meeting) const {
    const double square = glm::dot(ray.direction, ray.direction);
    double t = glm::dot(smooth - ray.origin, ray.direction) / square;
    double slope = glm::dot(ray.direction, glm::normalize(shape_->normalAt(smooth)));
    std::optional<double> off = gap(along(ray, t), meeting.foot);
    for (int i = 0; off && std::abs(*off) > 1e-10 && i < 30; ++i) {
        const double step = -*off / slope;
        t += step;
        const auto next = gap(along(ray, t), meeting.foot);
        if (next && *next != *off) slope = (*next - *off) / step;
        off = next;
    }
    meeting.point = along(ray, t);
    return off.has_value();
}

std::optional<glm::dvec3> TrueScreen::hit(const wall::Ray& ray) const {
    const auto meeting = meet(ray);
    return meeting && meeting->isScreen ? std::optional(meeting->point) : std::nullopt;
}

glm::dvec3 TrueScreen::normalAt(glm::dvec3 point) const {
    const auto foot = footOf(point);
    const glm::dvec3 normal = glm::normalize(shape_->normalAt(point));
    if (!foot) return normal;
    const glm::dvec3 slope = slopeAt(*foot);
    return glm::normalize(normal - (slope - glm::dot(slope, normal) * normal));
}

glm::dvec3 TrueScreen::raised(glm::dvec3 foot) const {
    return foot + heightAt(foot) * glm::normalize(shape_->normalAt(foot));
}

std::optional<glm::dvec3> TrueScreen::at(glm::dvec2 place) const {
    const auto foot = shape_->at(place);
    return foot ? std::optional(raised(*foot)) : std::nullopt;
}

std::vector<glm::dvec3> TrueScreen::border() const {
    std::vector<glm::dvec3> points = shape_->border(0);
    for (glm::dvec3& point : points) point = raised(point);
    return points;
}

}  // namespace aquarama::hall
