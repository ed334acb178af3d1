// SPDX-License-Identifier: Apache-2.0
#include "capture/report/silhouette.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "capture/dynamics.h"
#include "common/body/cage.h"

namespace aquarama::report {

namespace {

// The biomechanical fish.

// The two columns of the cage's tube that form the outline: the flanks from above, back and belly
// from the side.
std::pair<int, int> edgeColumns(ViewSide view) {
    return view == ViewSide::Above ? std::pair{3, 10} : std::pair{0, 6};
}

constexpr double kFinBodyLengths = 0.17;  // length of the line that stands for a pectoral fin

// Whether a control point belongs to a dorsal or the anal fin. Those fins are flat: seen from above
// they have no area.
bool isOnBackOrBelly(const body::CageSite& site) {
    return site.kind == body::CageSiteKind::Flap &&
           (site.part == body::CagePart::FirstDorsal || site.part == body::CagePart::SecondDorsal ||
            site.part == body::CagePart::Anal);
}

// `outward` is the direction of the fin along the body's z axis: -1 for the left one, 1 for the
// right. The root is a little before and beside the middle of ring 2. The fin's normal is (across,
// flat, 0) in the body frame, and the chord is perpendicular to it.
Polygon finLine(const capture::FinPlate& fin,
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
    // The cage in the pose of the nodal points.
    body::NodalPoints points;
    std::ranges::copy(nodes, points.begin());
    assert(body.cage.vertices.size() == body::kControlPoints);
    std::vector<glm::vec3> cage(body.cage.vertices.size());
    body::poseCage(body, points, cage);
    const auto [one, other] = edgeColumns(view);
    const auto edge = [&](int ring, int column) {
        return seen(view, cage.at(static_cast<std::size_t>(ring * body::kTubeColumns + column)));
    };
    // From the nose along one edge to the tail and back along the other.
    Polygon outline{seen(view, nodes[0])};
    for (int ring = 0; ring < body::kTubeRings; ++ring) outline.push_back(edge(ring, one));
    for (int ring = body::kTubeRings; ring-- > 0;) outline.push_back(edge(ring, other));
    std::vector<Polygon> polygons{std::move(outline)};
    if (view == ViewSide::Above) return polygons;

    // The topology is the same for every species.
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

std::vector<Polygon> finLines(const capture::FinPlates& fins,
                              const capture::NodeVectors& nodes,
                              ViewSide view) {
    const capture::PoseFrame frame = capture::frameOf(nodes);
    return {finLine(fins.left, -1, frame, view), finLine(fins.right, 1, frame, view)};
}

namespace {

// A captured fish.

constexpr std::size_t kRings = 5;  // of nodal points
constexpr std::size_t kSpan = 8;   // points of a smooth curve from one knot to the next
static_assert(kMidlinePoints == (kRings + 1) * kSpan + 1);

// The column of each side where the cage is widest (see common/body/cage.h).
constexpr int kRightFlank = 3;
constexpr int kLeftFlank = 10;

// A Catmull-Rom spline through the knots. Beyond the ends it takes the mirror image of the
// neighbour of the end.
std::vector<glm::dvec2> smooth(const std::vector<glm::dvec2>& knots) {
    assert(knots.size() >= 2);
    std::vector<glm::dvec2> curve;
    const std::size_t last = knots.size() - 1;
    for (std::size_t i = 0; i < last; ++i) {
        const glm::dvec2 before = i == 0 ? knots[0] * 2.0 - knots[1] : knots[i - 1];
        const glm::dvec2 after = i + 1 == last ? knots[last] * 2.0 - knots[last - 1] : knots[i + 2];
        for (std::size_t step = 0; step < kSpan; ++step) {
            const double t = static_cast<double>(step) / kSpan;
            curve.push_back(((2.0 * knots[i]) + (knots[i + 1] - before) * t +
                             (2.0 * before - 5.0 * knots[i] + 4.0 * knots[i + 1] - after) * t * t +
                             (3.0 * knots[i] - before - 3.0 * knots[i + 1] + after) * t * t * t) *
                            0.5);
        }
    }
    curve.push_back(knots[last]);
    return curve;
}

// One side of the body from nose to tail: the curve through the middles of the upper and the lower
// node of that side in each ring. `upper` and `lower` are 0 to 3, in the order of
// biomechanical_fish.h.
std::vector<glm::dvec2> sideOf(const capture::NodeVectors& nodes,
                               std::size_t upper,
                               std::size_t lower) {
    std::vector<glm::dvec2> knots{fromAbove(nodes[0])};
    for (std::size_t ring = 0; ring < kRings; ++ring) {
        const std::size_t first = 1 + 4 * ring;
        knots.push_back(fromAbove((nodes.at(first + upper) + nodes.at(first + lower)) / 2.0));
    }
    knots.push_back(fromAbove((nodes[21] + nodes[22]) / 2.0));
    return smooth(knots);
}

// The convex hull, counter-clockwise in a frame with y up (Andrew's monotone chain): the points
// sorted by x give the lower half, in reverse order the upper half.
std::vector<glm::dvec2> hullOf(std::vector<glm::dvec2> points) {
    assert(points.size() >= 2);
    std::ranges::sort(points, [](auto a, auto b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    const auto isRightTurn = [](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) <= 0;
    };
    std::vector<glm::dvec2> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = hull.size();
        for (const glm::dvec2& point : points) {
            while (hull.size() >= start + 2 &&
                   isRightTurn(hull[hull.size() - 2], hull.back(), point))
                hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back();
        std::ranges::reverse(points);
    }
    return hull;
}

// Fills in outline and pectoral fins from the control points, as fromAbove() gives them. The
// midline is there already: the outline begins at its nose.
void addRecorded(FishOutline& view, const std::vector<glm::dvec2>& cage) {
    assert(cage.size() == body::kControlPoints);
    const auto at = [&](int ring, int column) {
        return cage.at(static_cast<std::size_t>(ring) * body::kTubeColumns +
                       static_cast<std::size_t>(column));
    };
    view.outline = {view.midline.front()};
    for (int ring = 0; ring < body::kTubeRings; ++ring)
        view.outline.push_back(at(ring, kRightFlank));
    for (int ring = body::kTubeRings; ring-- > 0;) view.outline.push_back(at(ring, kLeftFlank));
    static const std::vector<body::CageSite> kSites = body::makeCageTopology().sites;
    // Left, right. Columns of the first half of the tube are on the right side.
    std::array<std::vector<glm::dvec2>, 2> fins;
    for (std::size_t i = 0; i < kSites.size(); ++i) {
        const body::CageSite& site = kSites[i];
        if (site.part != body::CagePart::Pectoral) continue;
        auto& fin = fins.at(site.column < body::kTubeColumns / 2 ? 1 : 0);
        fin.push_back(cage.at(i));
        fin.push_back(at(site.ring, site.column));  // the root, on the body
    }
    for (auto& fin : fins) view.pectorals.push_back(hullOf(std::move(fin)));
}

}  // namespace

glm::dvec2 fromAbove(const glm::dvec3& world) {
    return {world.x, world.z};
}

std::vector<glm::dvec2> midlineFromAbove(const capture::ReplayedPhase& replayed) {
    std::vector<glm::dvec2> left = sideOf(replayed.nodes, 0, 3);
    const std::vector<glm::dvec2> right = sideOf(replayed.nodes, 1, 2);
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = (left[i] + right[i]) / 2.0;
    return left;
}

std::vector<glm::dvec3> controlPointsAt(const motion::ActionSegment& segment, std::size_t phase) {
    std::vector<glm::dvec3> points;
    for (const auto& point : segment.controlPoints.at(phase % motion::kPhases))
        points.push_back(static_cast<double>(motion::kPoseUnit) *
                         glm::dvec3(point[0], point[1], point[2]));
    return points;
}

FishOutline viewFromAbove(const motion::ActionSegment& segment,
                          const capture::ReplayedPhase& replayed,
                          std::size_t k) {
    FishOutline view{.outline = {}, .pectorals = {}, .midline = midlineFromAbove(replayed)};
    if (segment.controlPoints.empty()) {
        view.outline = sideOf(replayed.nodes, 1, 2);
        const std::vector<glm::dvec2> left = sideOf(replayed.nodes, 0, 3);
        view.outline.insert(view.outline.end(), left.rbegin(), left.rend());
        return view;
    }
    std::vector<glm::dvec2> cage;
    for (const glm::dvec3& point : controlPointsAt(segment, k))
        cage.push_back(fromAbove(replayed.origin + replayed.worldFromBody * point));
    addRecorded(view, cage);
    return view;
}

}  // namespace aquarama::report
