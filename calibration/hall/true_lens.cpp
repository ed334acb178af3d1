// SPDX-License-Identifier: Apache-2.0
#include "calibration/hall/true_lens.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace aquarama::hall {

namespace {

// The place of a pixel where the corners of the picture are at -1 and 1.
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

// The tangent of a point in the frame of the lens: right and down.
glm::dvec2 tangentTo(glm::dvec3 seen) {
    return glm::dvec2(seen.x, -seen.y) / -seen.z;
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
            .lens = {.distortion = projector.distortion}};
}

LensTruth lensOf(const config::Channel& channel, const config::HallProjector& truth) {
    LensTruth lens = lensOf(channel);
    lens.position += truth.movedMetres;
    lens.wallFromLens = wall::turned(channel.projector.yawPitchRollRadians + truth.turnedRadians);
    lens.focal *= truth.focalFactor;
    lens.principal += truth.shiftPixels;
    const BrownLens<double> more = truth.lens.distortion;
    lens.lens.distortion.k1 += more.k1;
    lens.lens.distortion.k2 += more.k2;
    lens.lens.distortion.k3 += more.k3;
    lens.lens.distortion.p1 = more.p1;
    lens.lens.distortion.p2 = more.p2;
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
        const glm::dvec2 tangent = tangentOf(truth.lens.distortion, thrown);
        farthest_ = std::max(farthest_, glm::dot(tangent, tangent));
    }
}

wall::Ray TrueLens::ray(glm::dvec2 pixel) const {
    const glm::dvec2 shown = keystoned(pixel, truth_);
    const glm::dvec2 tangent =
        tangentOf(truth_.lens.distortion, (shown - truth_.principal) / truth_.focal);
    return {truth_.position, truth_.wallFromLens * glm::dvec3(tangent.x, -tangent.y, -1)};
}

std::optional<glm::dvec2> TrueLens::pixelOf(glm::dvec3 point) const {
    const glm::dvec3 seen = (point - truth_.position) * truth_.wallFromLens;  // the transpose
    if (seen.z >= 0) return std::nullopt;
    const glm::dvec2 tangent = tangentTo(seen);
    constexpr double kSlack = 1.1;  // beyond, a lens may fold; tangents grow to the corners
    if (glm::dot(tangent, tangent) > farthest_ * kSlack) return std::nullopt;
    const glm::dvec2 shown =
        truth_.principal + truth_.focal * imageOf(truth_.lens.distortion, tangent);
    const glm::dvec2 pixel = withoutKeystone(shown, truth_);
    const bool inside =
        pixel.x >= 0 && pixel.y >= 0 && pixel.x <= truth_.size.x && pixel.y <= truth_.size.y;
    return inside ? std::optional(pixel) : std::nullopt;
}

// All pixels of a panel send the same light. It is spread over the area that a pixel covers on a
// plane across the axis; this area grows with the square of the distance along the axis.
double TrueLens::lightAt(glm::dvec3 point) const {
    const glm::dvec3 seen = (point - truth_.position) * truth_.wallFromLens;
    const glm::dvec2 tangent = tangentTo(seen);
    const double slant = glm::length(seen) / -seen.z;  // one over the cosine to that plane
    const glm::dvec2 pixel =
        truth_.principal + truth_.focal * imageOf(truth_.lens.distortion, tangent);
    return glm::determinant(imageSlope(truth_.lens.distortion, tangent)) * slant /
           (seen.z * seen.z) * vignetted(pixel);
}

double TrueLens::vignetted(glm::dvec2 pixel) const {
    const glm::dvec2 place = centred(pixel, truth_.size);
    return 1 - truth_.lens.vignetting * glm::dot(place, place) / 2;
}

}  // namespace aquarama::hall
