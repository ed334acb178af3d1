// SPDX-License-Identifier: Apache-2.0
#include "calibration/hall/true_hall.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/base/log.h"
#include "common/wall/optics.h"

namespace aquarama::hall {

namespace {

// The light of a lens on a surface where the middle of its picture meets the planned screen.
double lightInTheMiddle(const LensTruth& truth, const wall::ScreenSurface& screen) {
    LensTruth even = truth;
    even.lens.vignetting = 0;
    const TrueLens lens(even);
    const wall::Ray ray = lens.ray(truth.size / 2.0);
    const auto point = screen.hit(ray, TrueScreen::kDrapeMetres);
    if (!point) return lens.lightAt(ray.origin + ray.direction);
    const glm::dvec3 normal = glm::normalize(screen.normalAt(*point));
    return lens.lightAt(*point) * -glm::dot(normal, glm::normalize(ray.direction));
}

// The lens of a projector after it was moved.
config::HallProjector atRest(const config::Hall& hall, std::size_t projector) {
    config::HallProjector truth = hall.projectors[projector];
    const auto& moved = hall.faults.moved;
    if (moved && moved->channel == projector)
        truth.turnedRadians += glm::dvec3(moved->yawPitchRadians, 0);
    return truth;
}

void checkChannels(const config::Rig& rig, const config::Hall& hall) {
    if (hall.projectors.size() != rig.channels.size())
        throw Error(rig.name + ": the hall has not as many projectors as the rig has channels");
    for (const config::Channel& channel : rig.channels)
        if (channel.panel || channel.wallFile)
            throw Error(rig.name + ": channel \"" + channel.name +
                        "\" is no projector of the rig's own: only those are simulated");
}

}  // namespace

TrueHall::TrueHall(const config::Rig& rig, const config::Hall& hall)
    : rig_{rig},
      hall_{hall},
      nominal_{wall::makeSurface(rig)},
      screen_{rig, hall},
      camera_{lensOf(hall.camera)} {
    checkChannels(rig, hall);
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        lenses_.emplace_back(lensOf(rig.channels[i], atRest(hall, i)));
        unitLight_.push_back(lightInTheMiddle(lensOf(rig.channels[i]), *nominal_));
    }
    for (std::size_t i = 0; i < rig.channels.size(); ++i) cables_.push_back(cableOf(i));
}

// A picture with the panel's shape fills it; another leaves two of its sides black.
TrueHall::Cable TrueHall::cableOf(std::size_t channel) const {
    Cable cable{.projector = channel};
    if (const auto& swapped = hall_.faults.swapped) {
        if (channel == (*swapped)[0]) cable.projector = (*swapped)[1];
        if (channel == (*swapped)[1]) cable.projector = (*swapped)[0];
    }
    const glm::dvec2 panel = lenses_[cable.projector].truth().size;
    const glm::dvec2 picture = rig_.channels[channel].sizePixels;
    const auto& mode = hall_.faults.mode;
    const glm::dvec2 sent =
        mode && mode->channel == channel ? glm::dvec2(mode->sizePixels) : picture;
    const glm::dvec2 covered = sent * std::min(panel.x / sent.x, panel.y / sent.y);
    cable.scale = covered / picture;
    cable.corner = (panel - covered) / 2.0;
    return cable;
}

glm::dvec2 TrueHall::panelFrom(std::size_t channel, glm::dvec2 pixel) const {
    return cables_[channel].corner + cables_[channel].scale * pixel;
}

glm::dvec2 TrueHall::pictureFrom(std::size_t channel, glm::dvec2 panelPixel) const {
    return (panelPixel - cables_[channel].corner) / cables_[channel].scale;
}

std::optional<glm::dvec3> TrueHall::pointOf(std::size_t channel, glm::dvec2 pixel) const {
    return screen_.hit(lens(projectorOf(channel)).ray(panelFrom(channel, pixel)));
}

std::optional<glm::dvec2> TrueHall::pixelOf(std::size_t channel, glm::dvec3 point) const {
    const TrueLens& lens = lenses_[projectorOf(channel)];
    const auto panel = lens.pixelOf(point);
    if (!panel || !wall::isBefore(screen_.shape(), lens.truth().position, point))
        return std::nullopt;
    const glm::dvec2 pixel = pictureFrom(channel, *panel);
    const glm::dvec2 size = rig_.channels[channel].sizePixels;
    const bool inside = glm::clamp(pixel, glm::dvec2(0), size) == pixel;
    return inside ? std::optional(pixel) : std::nullopt;
}

glm::dvec2 TrueHall::unrolled(glm::dvec3 point) const {
    const glm::dvec3 eye = rig_.sweetSpotMetres;
    const auto seen = nominal_->hit({eye, point - eye}, TrueScreen::kDrapeMetres);
    return seen ? nominal_->unrolled(*seen) : glm::dvec2(std::numeric_limits<double>::quiet_NaN());
}

std::optional<glm::dvec2> TrueHall::cameraPixelOf(glm::dvec3 point) const {
    if (!wall::isBefore(screen_.shape(), camera_.truth().position, point)) return std::nullopt;
    return camera_.pixelOf(point);
}

std::optional<glm::dvec3> TrueHall::pointSeen(glm::dvec2 cameraPixel) const {
    return screen_.hit(camera_.ray(cameraPixel));
}

// Along the sequence of the plastic number, which fills the square evenly.
std::vector<glm::dvec3> TrueHall::screenPoints(std::size_t count) const {
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 step = double(i) * glm::dvec2(0.7548776662466927, 0.5698402909980532);
        if (const auto point = screen_.at(glm::fract(0.5 + step))) points.push_back(*point);
    }
    return points;
}

double TrueHall::whiteAt(std::size_t channel, glm::dvec3 point) const {
    return hall_.screen.albedo * whiteOn(channel, point, screen_.normalAt(point));
}

double TrueHall::whiteOn(std::size_t channel, glm::dvec3 point, glm::dvec3 normal) const {
    const std::size_t projector = projectorOf(channel);
    const glm::dvec3 way = glm::normalize(lenses_[projector].truth().position - point);
    const double cosine = std::max(0.0, glm::dot(way, normal));
    return hall_.projectors[projector].brightness * cosine * lenses_[projector].lightAt(point) /
           unitLight_[projector];
}

}  // namespace aquarama::hall
