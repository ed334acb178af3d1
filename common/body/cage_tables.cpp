// SPDX-License-Identifier: Apache-2.0
#include "common/body/cage_tables.h"

namespace aquarama::body {

namespace {

// The shares of one knot: what becomes of a spine on which only this knot is not zero.
Spine onlyKnot(const std::array<float, kKnots>& stations, std::size_t knot) {
    Spine spine{.stations = stations};
    spine.centres.at(knot).x = 1;
    spine.right.at(knot).x = 1;
    setSlopes(spine);
    return spine;
}

}  // namespace

CageTables makeCageTables(const FishBody& body) {
    CageTables tables;
    tables.stations = knotStations(body);
    for (std::size_t g = 0; g < tables.groups.size(); ++g) {
        CageTables::Group& group = tables.groups.at(g);
        for (std::size_t i = 0; i < kPointGroup; ++i) {
            const glm::vec3 rest = body.cage.vertices.at(firstPointOf(g, kControlPoints) + i).rest;
            group.y.at(i) = rest.y;
            group.z.at(i) = rest.z;
            for (std::size_t k = 0; k < kKnots; ++k) {
                const SpineSample share = sampleAt(onlyKnot(tables.stations, k), rest.x);
                group.centre.at(k).at(i) = share.centre.x;
                group.tailwards.at(k).at(i) = share.tailwards.x;
                group.right.at(k).at(i) = share.right.x;
            }
        }
    }
    return tables;
}

}  // namespace aquarama::body
