// SPDX-License-Identifier: Apache-2.0
#include "calibration/hall/true_lens.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace aquarama::hall {

namespace {

// A picture with its corners at -1 and 1.
glm::dvec2 centred(glm::dvec2 pixel, glm::dvec2 size) {
    return 2.0 * pixel / size - 1.0;
}

glm::dvec2 pixelAt(glm::dvec2 place, glm::dvec2 size) {
    return (place + 1.0) / 2.0 * size;
}

glm::dvec2 keystoned(glm::dvec2 pixel, const LensTruth& truth) {
    if (truth.keystone == glm::dvec2(0)) return pixel;
    const glm::dvec2 place = centred(pixel, truth.size);
    const double shrink = 1 - std::abs(truth.keystone.x) - std::abs(truth.keystone.y);
    return pixelAt(place * shrink / (1 + glm::dot(truth.keystone, place)), truth.size);
}

glm::dvec2 withoutKeystone(glm::dvec2 pixel, const LensTruth& truth) {
    if (truth.keystone == glm::dvec2(0)) return pixel;
    const glm::dvec2 shown = centred(pixel, truth.size);
    const double shrink = 1 - std::abs(truth.keystone.x) - std::abs(truth.keystone.y);
    return pixelAt(shown / (shrink - glm::dot(truth.keystone, shown)), truth.size);
}

}  // namespace

LensTruth lensOf(const config::Channel& channel) {
    const config::Projector& projector = channel.projector;
    return {.position = projector.positionMetres,
            .wallFromLens = wall::turned(projector.yawPitchRollRadians),
            .focal = projector.focalPixels,
            .principal = projector.principalPixels,
            .size = channel.sizePixels,
            .lens = {.radial = {projector.radial, 0}}};
}

LensTruth lensOf(const config::Channel& channel, const config::HallProjector& truth) {
    LensTruth lens = lensOf(channel);
    lens.position += truth.movedMetres;
    lens.wallFromLens = wall::turned(channel.projector.yawPitchRollRadians + truth.turnedRadians);
    lens.focal *= truth.focalFactor;
    lens.principal += truth.shiftPixels;
    lens.lens.radial += truth.lens.radial;
    lens.lens.tangential = truth.lens.tangential;
    lens.lens.vignetting = truth.lens.vignetting;
    lens.keystone = truth.keystone;
    return lens;
}

LensTruth lensOf(const config::HallCamera& camera) {
    const glm::dvec3 back = glm::normalize(camera.positionMetres - camera.lookAtMetres);
    return {.position = camera.positionMetres,
            .wallFromLens = wall::turned({std::atan2(back.x, back.z),
                                          -std::asin(glm::clamp(back.y, -1.0, 1.0)),
                                          camera.rollRadians}),
            .focal = glm::dvec2(camera.focalPixels),
            .principal = camera.principalPixels,
            .size = camera.sizePixels,
            .lens = camera.lens};
}

glm::dvec3 anglesOf(const glm::dmat3& wallFromFrame) {
    const glm::dvec3 back = wallFromFrame[2];
    const double pitch = -std::asin(glm::clamp(back.y, -1.0, 1.0));
    const double yaw = std::atan2(back.x, back.z);
    const glm::dmat3 rest = glm::transpose(wall::turned({yaw, pitch, 0})) * wallFromFrame;
    return {yaw, pitch, std::atan2(rest[0].y, rest[0].x)};
}

TrueLens::TrueLens(const LensTruth& truth) : truth_{truth} {
    for (const glm::dvec2 corner :
         {glm::dvec2(0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1)}) {
        const glm::dvec2 thrown = (corner * truth.size - truth.principal) / truth.focal;
        const glm::dvec2 tangent = undistorted(thrown);
        farthest_ = std::max(farthest_, glm::dot(tangent, tangent));
    }
}

glm::dvec2 TrueLens::distorted(glm::dvec2 at) const {
    const auto& [radial, tangential, vignetting] = truth_.lens;
    const double square = glm::dot(at, at);
    const double stretch = 1 + square * (radial.x + square * (radial.y + square * radial.z));
    const glm::dvec2 aside = 2 * at.x * at.y * tangential +
                             glm::dvec2(tangential.y, tangential.x) * (square + 2.0 * at * at);
    return at * stretch + aside;
}

glm::dmat2 TrueLens::slopeAt(glm::dvec2 at) const {
    const auto& [radial, p, vignetting] = truth_.lens;
    const double square = glm::dot(at, at);
    const double stretch = 1 + square * (radial.x + square * (radial.y + square * radial.z));
    const double growth = radial.x + square * (2 * radial.y + square * 3 * radial.z);
    const double across = 2 * at.x * at.y * growth + 2 * p.x * at.x + 2 * p.y * at.y;
    return {stretch + 2 * at.x * at.x * growth + 2 * p.x * at.y + 6 * p.y * at.x,
            across,
            across,
            stretch + 2 * at.y * at.y * growth + 6 * p.x * at.y + 2 * p.y * at.x};
}

// By Newton's method: the lenses of halls distort by a few percent.
glm::dvec2 TrueLens::undistorted(glm::dvec2 thrown) const {
    glm::dvec2 tangent = thrown;
    for (int i = 0; i < 50; ++i) {
        const glm::dvec2 off = distorted(tangent) - thrown;
        if (glm::dot(off, off) < 1e-28) break;
        tangent -= glm::inverse(slopeAt(tangent)) * off;
    }
    return tangent;
}

wall::Ray TrueLens::ray(glm::dvec2 pixel) const {
    const glm::dvec2 shown = keystoned(pixel, truth_);
    const glm::dvec2 tangent = undistorted((shown - truth_.principal) / truth_.focal);
    return {truth_.position, truth_.wallFromLens * glm::dvec3(tangent.x, -tangent.y, -1)};
}

glm::dvec2 TrueLens::tangentOf(glm::dvec3 seen) const {
    return glm::dvec2(seen.x, -seen.y) / -seen.z;
}

std::optional<glm::dvec2> TrueLens::pixelOf(glm::dvec3 point) const {
    const glm::dvec3 seen = (point - truth_.position) * truth_.wallFromLens;  // the transpose
    if (seen.z >= 0) return std::nullopt;
    const glm::dvec2 tangent = tangentOf(seen);
    constexpr double kSlack = 1.1;  // beyond, a lens may fold; tangents grow to the corners
    if (glm::dot(tangent, tangent) > farthest_ * kSlack) return std::nullopt;
    const glm::dvec2 shown = truth_.principal + truth_.focal * distorted(tangent);
    const glm::dvec2 pixel = withoutKeystone(shown, truth_);
    const bool inside =
        pixel.x >= 0 && pixel.y >= 0 && pixel.x <= truth_.size.x && pixel.y <= truth_.size.y;
    return inside ? std::optional(pixel) : std::nullopt;
}

// The same light leaves all pixels of a panel. It is spread over the area that a pixel covers on a
// plane across the axis, which grows with the square of the distance along it.
double TrueLens::lightAt(glm::dvec3 point) const {
    const glm::dvec3 seen = (point - truth_.position) * truth_.wallFromLens;
    const glm::dvec2 tangent = tangentOf(seen);
    const double slant = glm::length(seen) / -seen.z;  // one over the cosine to that plane
    const glm::dvec2 pixel = truth_.principal + truth_.focal * distorted(tangent);
    return glm::determinant(slopeAt(tangent)) * slant / (seen.z * seen.z) * vignetted(pixel);
}

double TrueLens::vignetted(glm::dvec2 pixel) const {
    const glm::dvec2 place = centred(pixel, truth_.size);
    return 1 - truth_.lens.vignetting * glm::dot(place, place) / 2;
}

}  // namespace aquarama::hall
