// SPDX-License-Identifier: Apache-2.0
// A species as data for drawing: how its fins move, its rest shape, its control cage, its colours.
// Lengths are in body lengths where no unit is named.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace aquarama::body {

// How the fins and the face of one species move, as shaders read it (fish_fins.glsl, std430).
// Angles in radians, speeds in body lengths a second. Axes and arms are those of the right side:
// tailwards, up, away from the body. The left side is the mirror image.
struct FinStyle {
    glm::vec3 hinge{};   // of the pectoral fin: about it the fin opens
    float spread = 0;    // of a pectoral fin that brakes, from the rest angle
    glm::vec3 stroke{};  // about it the fin beats
    float trim = 0;      // the largest twist with which a fish balances
    glm::vec3 ray{};     // the fin's own axis, about which it twists
    // From the rest angle to the belly, at speed.
    float pelvicFold = 0;
    // The ripple of the median fins, swimming and hovering: amplitude in ray lengths, waves along
    // the fin.
    float swimRipple = 0, swimWaves = 0;
    float hoverRipple = 0, hoverWaves = 0, hoverHertz = 0;
    float opposed = 0;  // phase of the anal fin against the dorsal
    // How far the middle rays of the tail fin bend against its lobes, for each unit of drift.
    float cupping = 0;
    float gape = 0;  // so far the lower jaw turns, wide open
    // So far the upper jaw slides, wide open, and a gill cover lifts; body lengths.
    float protrusion = 0, flare = 0;
    std::array<float, 2> padding{};  // to whole vectors
};
static_assert(sizeof(FinStyle) == 96);

// Where a pectoral fin stands relative to its rest, radians: twisted about its ray, at the tip,
// then opened about its hinge, then carried about the axis of its stroke.
struct FinPose {
    float open = 0, stroke = 0, twist = 0;
};

// A control point as the shader of fins and faces reads it.
struct FinPoint {
    // On a paired fin: from the middle of its root, at rest. On the head: from the joint of the
    // jaw; of the upper lip, the direction in which it slides.
    glm::vec3 arm{};
    float side = 0;  // right 1, left -1
    // Along the fin's base, and from base to edge. On the head: how far the upper and the lower jaw
    // carry it along, 0 to 1.
    float p = 0, q = 0;
    // On a median fin: ray length * flex * q^1.5, body lengths. On the head: how far the gill cover
    // carries it along, 0 to 1.
    float sway = 0;
    std::uint32_t part = 0;  // CagePart; of the body only points of the head move
};
static_assert(sizeof(FinPoint) == 32);

// The constants of the fins and the face of one species.
struct FinTable {
    FinStyle style;
    // One for each vertex of the cage, in its order.
    std::vector<FinPoint> points;
};

}  // namespace aquarama::body

namespace aquarama::config {
struct Species;
}

namespace aquarama::body {

// The rest shape of the 23 nodal points, which the biomechanics moves, and the control cage that is
// bound to them. All species have the same numbers of both.
inline constexpr int kNodalPoints = 23;
inline constexpr int kControlPoints = 426;
inline constexpr int kCageFaces = 424;

// All positions of the 23 nodal points, in the order of the paper's Fig. 1: 0 nose, rings 1-4, 5-8,
// 9-12, 13-16, 17-20 (dorsal left, dorsal right, ventral right, ventral left), 21 dorsal and 22
// ventral tail tip.
using NodalPoints = std::array<glm::vec3, kNodalPoints>;

// Which part of the fish a cage vertex belongs to; the skin is painted by it.
enum class CagePart : std::uint8_t {
    Body,
    Caudal,
    FirstDorsal,
    SecondDorsal,
    Anal,
    Pelvic,
    Pectoral,
    Eye  // no vertex of the cage: a ball that is set into the skin
};

// One vertex of the control cage. Rest coordinates in body lengths: s from nose (0) to caudal tip
// (1), y up, z right.
struct CageVertex {
    glm::vec3 rest{};  // (s, y, z)
    CagePart part = CagePart::Body;
    // On a fin: p along its base and q from base (0) to edge (1). On the body zero.
    glm::vec2 fin{};
    // From the skin (0) over the lips (kLips) to the inside of the mouth (1).
    float mouth = 0;
};
inline constexpr float kLips = 0.5F;

// An edge that subdivision keeps sharp. The ends are in ascending order; the sharpness is
// OpenSubdiv's, in levels of refinement.
struct CageCrease {
    std::array<std::uint16_t, 2> edge{};
    float sharpness = 0.0F;
};

// A closed all-quad surface, outward when seen counter-clockwise, of kControlPoints vertices and
// kCageFaces faces.
struct ControlCage {
    std::vector<CageVertex> vertices;
    std::vector<std::array<std::uint16_t, 4>> faces;
    std::vector<CageCrease> creases;
};

// A whip, lone spine or barbel: thinner than the cage can draw, in the middle plane of the body
// (species.proto, Thread). Widths in body lengths.
struct BodyThread {
    std::vector<glm::vec2> at;  // (s, y) from its root to its tip
    float rootWidth = 0.0F, tipWidth = 0.0F;
    bool isOfFirstDorsal = false;
};

// How the face of one species is painted. Lengths in body lengths.
struct FishFace {
    glm::vec3 eye{};              // (s, y, radius)
    glm::vec2 front{}, corner{};  // of the gape, (s, y)
    float lip = 0;                // width of each lip
    float teeth = 0;              // config::Teeth
    glm::vec2 gill{};             // of the cover's hind edge: station, bow
};

// The data of a species' file that drawing and posing need. Made once by makeBody(), then read
// only.
struct FishBody {
    std::string species;
    float typicalLengthMetres = 0.0F;
    NodalPoints restNodes{};  // body lengths, nose at the origin, body along -x, y dorsal, z right
    std::array<float, 5> ringStations{};  // s of the five rings
    std::vector<float> profileStations;   // s of the body profile below (body lengths)
    std::vector<float> profileDorsal;     // height above the axis (positive)
    std::vector<float> profileVentral;    // depth below the axis (positive)
    std::vector<float> profileHalfWidth;
    FishFace face;
    float eyeBulge = 0.0F;  // height of an eye over the skin, in its radii
    std::vector<BodyThread> threads;
    ControlCage cage;
    FinTable fins;
};

// species: as its reader has checked it. A pure function.
[[nodiscard]] FishBody makeBody(const config::Species& species);

// Moves the cage by the nodal points: a cubic spine through nose, ring centres and tail, the
// lateral axis from the rings. nodes and controlPoints are in the same frame (body or world), in
// body lengths; controlPoints has one element for each vertex of the cage. The rest nodes give the
// rest cage.
void poseCage(const FishBody& body, const NodalPoints& nodes, std::span<glm::vec3> controlPoints);

}  // namespace aquarama::body

namespace aquarama::config {
struct Species;
}

namespace aquarama::body {

// How the skin of a species is painted: by its own shader where there is one, else with a plain
// pattern in these colours of its file.
struct FishSkin {
    // Name of the species; its shader is render_node/shaders/skin_SPECIES.glsl.
    std::string species;
    // Linear Rec. 709.
    glm::vec3 back{}, flank{}, belly{};
    FishFace face;
};

// A colour that the file does not name has a neutral default.
[[nodiscard]] FishSkin skinOf(const config::Species& species);

}  // namespace aquarama::body
