// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include <glm/common.hpp>

#include "common/body/cage_topology.h"
#include "master/capture/dynamics/anatomy.h"
#include "master/capture/measure/measure.h"
#include "master/capture/report/fish_view.h"
#include "master/capture/report/path_figures.h"
#include "master/capture/report/plot.h"

namespace aquarama::report {

namespace {

constexpr const char* kSkin = R"(fill="#d8e3e9" stroke="#d8e3e9" stroke-width="0.6")";
constexpr const char* kSpring = R"(stroke="#8ba0ab" stroke-width="0.8")";
constexpr const char* kMuscle = R"(stroke="#bf4a24" stroke-width="2")";
constexpr double kScale = 430;  // paper units a body length
constexpr double kMargin = 16;

// The head to the right; from the side y is up, from above the right of the fish is down.
using ViewSide = glm::dvec2 (*)(const glm::dvec3&);

struct Picture {
    Svg& svg;
    ViewSide view;
    glm::dvec2 shift{};
    [[nodiscard]] glm::dvec2 operator()(const glm::dvec3& point) const {
        return shift + view(point) * kScale;
    }
};

void drawSkin(const Picture& picture, const std::vector<glm::dvec3>& cage) {
    static const body::CageTopology kTopology = body::makeCageTopology();
    for (const auto& face : kTopology.faces) {
        std::vector<glm::dvec2> corners;
        corners.reserve(face.size());
        for (const std::uint16_t corner : face) corners.push_back(picture(cage.at(corner)));
        picture.svg.polygon(corners, kSkin);
    }
}

void drawUnits(const Picture& picture, const std::vector<glm::dvec3>& nodes, bool muscles) {
    for (const auto& unit : capture::anatomy().units)
        if ((unit.kind >= capture::UnitKind::FrontMuscle) == muscles)
            picture.svg.line(picture(nodes.at(unit.first)),
                             picture(nodes.at(unit.second)),
                             muscles ? kMuscle : kSpring);
}

struct Bounds {
    glm::dvec2 least{1e9}, most{-1e9};
};

Bounds boundsOf(ViewSide view, const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    Bounds bounds;
    for (const auto* points : {&a, &b})
        for (const glm::dvec3& point : *points) {
            bounds.least = glm::min(bounds.least, view(point) * kScale);
            bounds.most = glm::max(bounds.most, view(point) * kScale);
        }
    return bounds;
}

}  // namespace

std::string drawBody(const motion::Repertoire& repertoire) {
    const motion::ActionSegment& straight =
        repertoire.segments.at(static_cast<std::size_t>(motion::Action::Glide));
    const capture::NodeVectors pose = capture::poseAt(straight, 0);
    const std::vector<glm::dvec3> nodes(pose.begin(), pose.end());
    std::vector<glm::dvec3> cage;
    if (!straight.controlPoints.empty()) cage = controlPointsAt(straight, 0);
    const ViewSide fromTheSide = [](const glm::dvec3& p) { return glm::dvec2(p.x, -p.y); };
    const ViewSide fromTheTop = [](const glm::dvec3& p) { return glm::dvec2(p.x, p.z); };
    const Bounds side = boundsOf(fromTheSide, nodes, cage);
    const Bounds top = boundsOf(fromTheTop, nodes, cage);
    const glm::dvec2 sideSize = side.most - side.least;
    const glm::dvec2 topSize = top.most - top.least;
    const double height = std::max(sideSize.y, topSize.y) + 2 * kMargin;
    Svg svg(sideSize.x + topSize.x + 4 * kMargin, height + 34);
    const double middle = height / 2;
    const glm::dvec2 sideShift{kMargin - side.least.x, middle - (side.least.y + side.most.y) / 2};
    const glm::dvec2 topShift{sideSize.x + 3 * kMargin - top.least.x,
                              middle - (top.least.y + top.most.y) / 2};
    for (const Picture& picture :
         {Picture{svg, fromTheSide, sideShift}, Picture{svg, fromTheTop, topShift}}) {
        if (!cage.empty()) drawSkin(picture, cage);
        drawUnits(picture, nodes, false);
        drawUnits(picture, nodes, true);
        for (const glm::dvec3& node : nodes)
            svg.circle(picture(node), 2.6, std::string("fill=\"") + kInk + "\"");
    }
    const double below = height + 14;
    svg.circle({kMargin + 4, below}, 2.6, std::string("fill=\"") + kInk + "\"");
    svg.text({kMargin + 14, below + 4}, "23 nodal points", letters(12));
    svg.line({kMargin + 120, below}, {kMargin + 144, below}, kSpring);
    svg.text({kMargin + 150, below + 4}, "79 springs", letters(12));
    svg.line({kMargin + 230, below}, {kMargin + 254, below}, kMuscle);
    svg.text({kMargin + 260, below + 4}, "12 muscles", letters(12));
    if (!cage.empty()) {
        svg.rectangle({kMargin + 344, below - 6}, {22, 12}, kSkin);
        svg.text({kMargin + 372, below + 4}, "recorded control points", letters(12));
    }
    return std::move(svg).finish();
}

}  // namespace aquarama::report
