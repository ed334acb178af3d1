// SPDX-License-Identifier: Apache-2.0
#include "calibration/geometry/model.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace aquarama::geometry {

Tangent tangentOf(const LensParameters& lens, glm::dvec2 place) {
    const BrownLens<double> distortion{
        lens[lens::K1], lens[lens::K2], lens[lens::K3], lens[lens::P1], lens[lens::P2]};
    const glm::dvec2 focal(lens[lens::Focal], lens[lens::Focal] * lens[lens::Aspect]);
    const glm::dvec2 centre(lens[lens::CentreX], lens[lens::CentreY]);
    const glm::dvec2 tangent = tangentOf(distortion, (place - centre) / focal);
    const glm::dmat2 byImage = glm::inverse(imageSlope(distortion, tangent));
    return {tangent, {byImage[0] / focal.x, byImage[1] / focal.y}};
}

SmoothField::Cell SmoothField::cellAt(glm::dvec2 place) const {
    const glm::dvec2 scaled = place * glm::dvec2(cells_);
    const glm::ivec2 index = glm::clamp(glm::ivec2(glm::floor(scaled)), glm::ivec2(0), cells_ - 1);
    return {index, scaled - glm::dvec2(index)};
}

double SmoothField::at(glm::dvec2 place) const {
    const Cell cell = cellAt(glm::clamp(place, 0.0, 1.0));
    const auto across = splineWeights(cell.within.x);
    const auto down = splineWeights(cell.within.y);
    double sum = 0;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            sum += across[static_cast<std::size_t>(column)] * down[static_cast<std::size_t>(row)] *
                   controls_[control(cell.index.x + column, cell.index.y + row)];
    return sum;
}

glm::dvec3 BumpyScreen::baseAt(glm::dvec2& place) const {
    constexpr int kSteps = 500;
    place = glm::clamp(place, 0.0, 1.0);
    for (int i = 0; i < kSteps; ++i) {
        if (const auto point = screen_.at(place)) return *point;
        place = glm::mix(place, glm::dvec2(0.5), 1.0 / kSteps);
    }
    place = glm::dvec2(0.5);  // also of what is not a number
    return screen_.at(place).value_or(glm::dvec3(0));
}

LensParameters lensOf(const config::Projector& projector) {
    LensParameters lens{};
    lens[lens::Focal] = projector.focalPixels.x;
    lens[lens::Aspect] = projector.focalPixels.y / projector.focalPixels.x;
    lens[lens::CentreX] = projector.principalPixels.x;
    lens[lens::CentreY] = projector.principalPixels.y;
    lens[lens::K1] = projector.distortion.k1;
    lens[lens::K2] = projector.distortion.k2;
    return lens;
}

PoseParameters poseOf(glm::dvec3 position, const glm::dmat3& wallFromOwn) {
    // From y up and z back to y down and z ahead.
    const glm::dmat3 flip(1, 0, 0, 0, -1, 0, 0, 0, -1);
    const glm::dmat3 ownFromWall = flip * glm::transpose(wallFromOwn);
    PoseParameters pose{};
    ceres::RotationMatrixToAngleAxis(&ownFromWall[0][0], pose.data());
    const glm::dvec3 shift = -(ownFromWall * position);
    for (int i = 0; i < 3; ++i) pose[static_cast<std::size_t>(i) + 3] = shift[i];
    return pose;
}

PoseParameters poseOf(const config::Projector& projector) {
    return poseOf(projector.positionMetres, wall::turned(projector.yawPitchRollRadians));
}

wall::Ray rayOf(const LensParameters& lens, const PoseParameters& pose, glm::dvec2 place) {
    const RayOf<double> ray = rayOf(lens.data(), pose.data(), place, tangentOf(lens, place));
    return {{ray.origin[0], ray.origin[1], ray.origin[2]},
            {ray.direction[0], ray.direction[1], ray.direction[2]}};
}

glm::dvec3 positionOf(const PoseParameters& pose) {
    const Three<double> back{-pose[0], -pose[1], -pose[2]};
    const Three<double> shift{-pose[3], -pose[4], -pose[5]};
    Three<double> position;
    ceres::AngleAxisRotatePoint(back.data(), shift.data(), position.data());
    return {position[0], position[1], position[2]};
}

}  // namespace aquarama::geometry
