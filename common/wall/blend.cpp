// SPDX-License-Identifier: Apache-2.0
#include "common/wall/blend.h"

#include "common/wall/wall.h"

namespace aquarama::wall {

namespace {

// 0 with slope 0 at both borders of a picture, 1 in its middle. Two neighbours' bumps, divided by
// their sum, cross over in the overlap as t^2 / (t^2 + (1 - t)^2).
double bump(double position, double size) {
    const double t = position / size;
    const double hill = 4 * t * (1 - t);
    return hill * hill;
}

double pull(const Pinhole& projector, glm::dvec3 point) {
    const auto pixel = projector.pixelOf(point);
    if (!pixel || !lightsInside(projector, point)) return 0;
    return bump(pixel->x, projector.size().x) * bump(pixel->y, projector.size().y);
}

}  // namespace

Blend::Blend(const config::Rig& rig) {
    for (const config::Channel& channel : rig.channels) projectors_.emplace_back(channel);
}

double Blend::weight(std::size_t channel, glm::dvec3 point) const {
    const double own = pull(projectors_[channel], point);
    if (own <= 0) return 0;
    double sum = own;
    for (std::size_t i = 0; i < projectors_.size(); ++i)
        if (i != channel) sum += pull(projectors_[i], point);
    return own / sum;
}

double blendWeight(const config::Rig& rig, std::size_t channel, glm::dvec3 screenPointMetres) {
    return Blend(rig).weight(channel, screenPointMetres);
}

}  // namespace aquarama::wall
