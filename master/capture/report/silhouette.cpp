// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/silhouette.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/body/cage_topology.h"
#include "master/capture/dynamics/body_frame.h"

namespace aquarama::report {

namespace {

// Columns of the cage's tube at the edge of what is seen: flanks from above, back and belly from
// the side.
std::pair<int, int> edgeColumns(ViewSide view) {
    return view == ViewSide::Above ? std::pair{3, 10} : std::pair{0, 6};
}

constexpr double kFinBodyLengths = 0.17;

bool isOnBackOrBelly(const body::CageSite& site) {
    return site.kind == body::CageSiteKind::Flap &&
           (site.part == body::CagePart::FirstDorsal || site.part == body::CagePart::SecondDorsal ||
            site.part == body::CagePart::Anal);
}

Polygon finLine(const capture::PectoralFin& fin,
                double outward,
                const capture::PoseFrame& frame,
                ViewSide view) {
    const double across = std::cos(fin.angleRadians);
    const double flat = std::sin(fin.angleRadians);
    const glm::dvec3 root = frame.origin + frame.worldFromBody * glm::dvec3(0.1, 0, 0.05 * outward);
    const glm::dvec3 chord = frame.worldFromBody * glm::dvec3(-flat, across, 0);
    const glm::dvec3 span = frame.worldFromBody * glm::dvec3(-flat, 0, outward * std::abs(across));
    const glm::dvec3 reach = kFinBodyLengths * (view == ViewSide::Above ? span : chord);
    return {seen(view, root), seen(view, root + reach)};
}

}  // namespace

glm::dvec2 seen(ViewSide view, const glm::dvec3& world) {
    return {world.x, view == ViewSide::Above ? -world.z : world.y};
}

std::vector<Polygon> silhouetteOf(const body::FishBody& body,
                                  const capture::NodeVectors& nodes,
                                  ViewSide view) {
    body::NodalPoints points;
    std::ranges::copy(nodes, points.begin());
    std::vector<glm::vec3> cage(body.cage.vertices.size());
    body::poseCage(body, points, cage);
    const auto [one, other] = edgeColumns(view);
    const auto edge = [&](int ring, int column) {
        return seen(view, cage.at(static_cast<std::size_t>(ring * body::kTubeColumns + column)));
    };
    Polygon outline{seen(view, nodes[0])};
    for (int ring = 0; ring < body::kTubeRings; ++ring) outline.push_back(edge(ring, one));
    for (int ring = body::kTubeRings; ring-- > 0;) outline.push_back(edge(ring, other));
    std::vector<Polygon> polygons{std::move(outline)};
    if (view == ViewSide::Above) return polygons;

    static const body::CageTopology kTopology = body::makeCageTopology();
    for (const auto& face : kTopology.faces) {
        if (!std::ranges::any_of(
                face, [](auto corner) { return isOnBackOrBelly(kTopology.sites.at(corner)); }))
            continue;
        Polygon& polygon = polygons.emplace_back();
        for (const auto corner : face) polygon.push_back(seen(view, cage.at(corner)));
    }
    return polygons;
}

std::vector<Polygon> finLines(const capture::PectoralFins& fins,
                              const capture::NodeVectors& nodes,
                              ViewSide view) {
    const capture::PoseFrame frame = capture::frameOf(nodes);
    return {finLine(fins.left, -1, frame, view), finLine(fins.right, 1, frame, view)};
}

}  // namespace aquarama::report
