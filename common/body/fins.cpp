// SPDX-License-Identifier: Apache-2.0
#include "common/body/fins.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/body/face.h"
#include "common/body/spine.h"

namespace aquarama::body {

namespace {

// Samples of each curve of a patch, evenly spaced in p.
constexpr int kSamples = 101;

// Values from 0 to 1.
std::vector<float> evenSteps(std::size_t count) {
    std::vector<float> steps(count);
    for (std::size_t i = 0; i < count; ++i)
        steps[i] = static_cast<float>(i) / static_cast<float>(count - 1);
    return steps;
}

// One component of a drawn line, sampled by a monotone curve through its points.
std::vector<float> sampled(const std::vector<glm::vec2>& points, int component) {
    assert(points.size() >= 2);
    std::vector<float> values(points.size());
    std::ranges::transform(
        points, values.begin(), [&](glm::vec2 point) { return point[component]; });
    const MonotoneCurve curve(evenSteps(points.size()), values);
    std::vector<float> samples = evenSteps(kSamples);
    for (float& sample : samples) sample = curve.at(sample);
    return samples;
}

// Angle off the flank of a folded fin, and of a fin that brakes.
constexpr float kFlatRadians = 5.0F * kWholeTurn / 360;
constexpr float kSpreadRadians = 75.0F * kWholeTurn / 360;

// About a unit axis (Rodrigues).
glm::vec3 rotated(glm::vec3 axis, float angle, glm::vec3 v) {
    const float c = std::cos(angle);
    return c * v + std::sin(angle) * glm::cross(axis, v) + (1 - c) * glm::dot(axis, v) * axis;
}

// The axes of a paired fin of the right side, in (s, y, z) of the rest cage.
struct Hinge {
    glm::vec3 root{};   // its middle
    glm::vec3 axis{};   // about it the fin leaves the flank
    glm::vec3 ray{};    // from the root to the middle of the margin
    glm::vec3 chord{};  // from there to the margin's front
};

// flank: how far the root is from the middle plane.
Hinge hingeOf(const config::Fin& fin, float flank) {
    const FinPatch patch(fin);
    const glm::vec2 base = glm::normalize(patch.baseRear() - patch.baseFront());
    const glm::vec2 square{-base.y, base.x};
    const glm::vec2 ray = patch.at(0.5F, 1) - patch.at(0.5F, 0);
    const glm::vec2 out = glm::dot(ray, square) < 0 ? -square : square;
    const auto lifted = [&](glm::vec2 drawn) {
        const float reach = glm::dot(drawn, out);
        return glm::vec3(base * glm::dot(drawn, base) + out * reach * std::cos(fin.angleRadians),
                         reach * std::sin(fin.angleRadians));
    };
    return {.root = {patch.at(0.5F, 0), flank},
            .axis = {out.y, -out.x, 0},
            .ray = glm::normalize(lifted(ray)),
            .chord = lifted(patch.at(0, 1) - patch.at(0.5F, 1))};
}

// Rounds to whole tenths of a hertz: then every fin is where it was ten seconds ago, so time can
// restart after kFinSeconds and keeps its precision in a show of days.
float tenths(float hertz) {
    return std::round(10 * hertz) / 10;
}

float flankAt(const config::Species& species, const config::Fin& fin) {
    return interpolate(
        species.profile.stations, species.profile.halfWidth, FinPatch(fin).at(0.5F, 0).x);
}

// Of a patch, by its cells.
float areaOf(const FinPatch& patch) {
    constexpr int kCells = 24;
    const auto at = [&](int i, int j) {
        return patch.at(static_cast<float>(i) / kCells, static_cast<float>(j) / kCells);
    };
    float area = 0;
    for (int i = 0; i < kCells; ++i)
        for (int j = 0; j < kCells; ++j) {
            const glm::vec2 a = at(i + 1, j + 1) - at(i, j);
            const glm::vec2 b = at(i, j + 1) - at(i + 1, j);
            area += std::abs(a.x * b.y - a.y * b.x) / 2;
        }
    return area;
}

FinStyle styleOf(const config::Species& species, const PectoralFin& fin) {
    const config::FinMotion& motion = species.finMotion;
    FinStyle style;
    style.hinge = fin.hinge;
    style.ray = fin.ray;
    style.stroke = fin.stroke;
    style.spread = fin.spread;
    // A twist that lifts the front of the fin.
    const glm::vec3 open = rotated(fin.hinge, fin.rowing, fin.ray);
    const glm::vec3 chord = rotated(fin.hinge, fin.rowing, fin.chord);
    style.trim =
        glm::cross(open, chord).y > 0 ? motion.rowing.trimRadians : -motion.rowing.trimRadians;
    style.pelvicFold = motion.pelvicFoldRadians;
    style.swimRipple = motion.swimming.amplitude;
    style.swimWaves = motion.swimming.waves;
    style.hoverRipple = motion.hovering.amplitude;
    style.hoverWaves = motion.hovering.waves;
    style.hoverHertz = tenths(motion.hovering.beatHertz);
    style.opposed = motion.hovering.isOpposed ? kWholeTurn / 2 : 0;
    style.cupping = motion.cuppingRadians;
    style.gape = species.mouth.gapeRadians;
    style.protrusion = species.mouth.protrusion;
    style.flare = species.gill.flare;
    return style;
}

// The fin of the file that a part of the cage was made from.
const config::Fin& finOf(const config::Fins& fins, CagePart part) {
    switch (part) {
        case CagePart::Caudal:
            return fins.caudal;
        case CagePart::SecondDorsal:
            return fins.secondDorsal ? *fins.secondDorsal : fins.firstDorsal;
        case CagePart::Anal:
            return fins.anal;
        default:
            return fins.firstDorsal;
    }
}

// FinPoint::sway of a point (p, q) of a median fin. It grows with q^1.5, so the root stays in place
// and the margin swings most.
float swayOf(const config::Fin& fin, glm::vec2 at) {
    const FinPatch patch(fin);
    const float span = glm::distance(patch.at(at.x, 0), patch.at(at.x, 1));
    return fin.flex * span * std::pow(at.y, 1.5F);
}

// A phase offset, by which a fish differs from others.
float ownCycles(std::uint32_t id) {
    return glm::fract(0.37F * static_cast<float>(id));
}

// The displacement of a point of a pectoral fin, right side: its captured pose, with a twist that
// balances; a fish that brakes holds it across the water.
glm::vec3 rowed(const FinStyle& style, const FinPoint& point, const FinDrive& drive) {
    const bool isRight = point.side > 0;
    const FinPose& pose = isRight ? drive.right : drive.left;
    const float rows = 1 - drive.spread;
    const float lift = isRight ? -drive.tilt : drive.tilt;  // on the lower side
    const float twist = rows * pose.twist + style.trim * std::clamp(kTrimGain * lift, -1.0F, 1.0F);
    glm::vec3 arm = rotated(style.ray, twist * point.q, point.arm);
    arm = rotated(style.hinge, glm::mix(pose.open, style.spread, drive.spread), arm);
    return rotated(style.stroke, rows * pose.stroke, arm) - point.arm;
}

// The displacement to the right of a point of a median fin: the wave of swimming, locked to the
// tail beat, and that of hovering, by the clock, mixed by speed.
float rippled(const FinStyle& style, const FinPoint& point, const FinDrive& drive) {
    const auto wave = [&](float cycles, float waves) {
        return std::sin(kWholeTurn * (waves * point.p - cycles) - kMarginLag * point.q);
    };
    const float swimming = glm::mix(
        wave(drive.fromPhase, style.swimWaves), wave(drive.phase, style.swimWaves), drive.weight);
    const bool isAnal = point.part == static_cast<std::uint32_t>(CagePart::Anal);
    const float hovering = wave(style.hoverHertz * drive.seconds + ownCycles(drive.id) +
                                    (isAnal ? style.opposed / kWholeTurn : 0),
                                style.hoverWaves);
    return point.sway * glm::mix(style.hoverRipple * hovering,
                                 style.swimRipple * swimming,
                                 glm::smoothstep(kStands, kSwims, std::abs(drive.speed)));
}

}  // namespace

FinPatch::FinPatch(const config::Fin& fin)
    : p_(evenSteps(kSamples)),
      baseS_(sampled(fin.base, 0)),
      baseY_(sampled(fin.base, 1)),
      edgeS_(sampled(fin.edge, 0)),
      edgeY_(sampled(fin.edge, 1)),
      angleRadians_(fin.angleRadians),
      round_(fin.round) {}

glm::vec2 FinPatch::at(float p, float q) const {
    const glm::vec2 base{interpolate(p_, baseS_, p), interpolate(p_, baseY_, p)};
    const glm::vec2 edge{interpolate(p_, edgeS_, p), interpolate(p_, edgeY_, p)};
    return glm::mix(base, edge, q);
}

glm::vec2 FinPatch::paddleAt(float p, float q) const {
    const float paddle = 1 + 0.3F * std::sin(std::numbers::pi_v<float> * q) - 0.42F * q * q;
    const glm::vec2 middle = at(0.5F, q);
    return middle + glm::mix(1.0F, paddle, round_) * (at(p, q) - middle);
}

float FinPatch::rayAtStation(float s) const {
    return interpolate(baseS_, p_, s);
}

PectoralFin pectoralFinOf(const config::Species& species) {
    const config::Rowing& rowing = species.finMotion.rowing;
    const config::Fin& drawn = species.fins.pectoral;
    const FinPatch patch(drawn);
    const Hinge hinge = hingeOf(drawn, 0.97F * flankAt(species, drawn));
    PectoralFin fin{
        .root = hinge.root,
        .hinge = hinge.axis,
        .ray = hinge.ray,
        .chord = glm::normalize(glm::vec3(patch.baseRear() - patch.baseFront(), 0)),
        .span = glm::distance(patch.at(0.5F, 0), patch.at(0.5F, 1)),
        .area = areaOf(patch),
        .rowing = rowing.openRadians - drawn.angleRadians,
        .folded = rowing.rows() ? std::min(kFlatRadians - drawn.angleRadians, 0.0F) : 0};
    fin.spread = rowing.rows() ? std::max(kSpreadRadians - drawn.angleRadians, fin.rowing) : 0;
    const glm::vec3 open = rotated(fin.hinge, fin.rowing, fin.ray);
    const glm::vec3 lifts = glm::normalize(glm::cross(open, glm::vec3(0, 1, 0)));
    fin.stroke = glm::normalize(std::cos(rowing.flapRadians) * fin.hinge +
                                std::sin(rowing.flapRadians) * lifts);
    return fin;
}

FinTable makeFinTable(const config::Species& species, const ControlCage& cage) {
    const config::Fins& fins = species.fins;
    assert(cage.vertices.size() == kControlPoints);
    const PectoralFin pectoral = pectoralFinOf(species);
    const Hinge pelvic = hingeOf(fins.pelvic, 0.35F * flankAt(species, fins.pelvic));
    const Sections sections(species.profile);
    FinTable table{.style = styleOf(species, pectoral), .points = {}};
    for (const CageVertex& vertex : cage.vertices) {
        FinPoint point{
            .p = vertex.fin.x, .q = vertex.fin.y, .part = static_cast<std::uint32_t>(vertex.part)};
        if (vertex.part == CagePart::Pectoral || vertex.part == CagePart::Pelvic) {
            const glm::vec3 root = vertex.part == CagePart::Pectoral ? pectoral.root : pelvic.root;
            point.side = vertex.rest.z > 0 ? 1.0F : -1.0F;
            point.arm = glm::vec3(glm::vec2(vertex.rest), std::abs(vertex.rest.z)) - root;
        } else if (vertex.part != CagePart::Body) {
            point.sway = swayOf(finOf(fins, vertex.part), vertex.fin);
        } else {
            setFacePoint(species, sections, vertex, point);
        }
        table.points.push_back(point);
    }
    return table;
}

glm::vec3 finOffset(const FinTable& fins, std::size_t i, const FinDrive& drive, float drift) {
    assert(i < fins.points.size());
    const FinPoint& point = fins.points[i];
    const FinStyle& style = fins.style;
    switch (static_cast<CagePart>(point.part)) {
        case CagePart::Body:
            return faceOffset(style, point, drive.face);
        case CagePart::Pectoral:
            return rowed(style, point, drive) * glm::vec3(1, 1, point.side);
        case CagePart::Pelvic: {
            const float angle = style.pelvicFold * (1 - drive.spread) *
                                glm::smoothstep(kStands, kFolded, std::abs(drive.speed));
            const glm::vec3 offset = rotated({0, 0, 1}, angle, point.arm) - point.arm;
            return offset * glm::vec3(1, 1, point.side);
        }
        case CagePart::Caudal: {
            const float lobe = 2 * point.p - 1;
            const float bend = std::clamp(drift, -kMostDrift, kMostDrift) * style.cupping;
            return {0, 0, bend * (lobe * lobe - 0.5F) * std::pow(point.q, 1.5F)};
        }
        default:
            return {0, 0, rippled(style, point, drive)};
    }
}

void headingsOf(const FishBody& body, const NodalPoints& nodes, std::span<float> headings) {
    assert(headings.size() <= body.cage.vertices.size());
    const Spine spine = spineOf(knotStations(body), nodes);
    for (std::size_t i = 0; i < headings.size(); ++i) {
        const glm::vec3 right = sampleAt(spine, body.cage.vertices[i].rest.x).right;
        headings[i] = std::atan2(right.x, right.z);
    }
}

glm::vec3 turned(glm::vec3 offset, float heading) {
    const float c = std::cos(heading), s = std::sin(heading);
    return {s * offset.z - c * offset.x, offset.y, c * offset.z + s * offset.x};
}

}  // namespace aquarama::body
