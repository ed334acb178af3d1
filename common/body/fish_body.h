// SPDX-License-Identifier: Apache-2.0
// How the fins of a species move beside its body, as shaders read it (fish_fins.glsl, std430).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace aquarama::body {

// Of a species; angles in radians, speeds in body lengths a second. Axes and arms are of the right
// side: tailwards, up, away from the body. The left side is its mirror image.
struct FinStyle {
    glm::vec3 hinge{};      // of the pectoral fin: about it the fin opens
    float open = 0;         // from the rest angle to the middle of the stroke
    glm::vec3 stroke{};     // about it the fin beats
    float fold = 0;         // from the rest angle to the flank
    glm::vec3 ray{};        // the fin's own axis, about which it feathers
    float strokeAngle = 0;  // to either side
    float featherAngle = 0, trimAngle = 0;
    float rowHertz = 0;
    float alternateBelow = 0, foldAbove = 0;
    float pelvicFold = 0;
    float swimRipple = 0, swimWaves = 0;  // of the median fins: in ray lengths, along the fin
    float hoverRipple = 0, hoverWaves = 0, hoverHertz = 0;
    float opposed = 0;  // phase of the anal fin against the dorsal
    float cupping = 0;
    float padding[3] = {0, 0, 0};  // to whole vectors
};
static_assert(sizeof(FinStyle) == 112);

// Of a control point.
struct FinPoint {
    glm::vec3 arm{};         // on a paired fin: from the middle of its root, at rest
    float side = 0;          // right 1, left -1
    float p = 0, q = 0;      // along the fin's base, and from base to edge
    float sway = 0;          // on a median fin: ray length * flex * q^1.5, body lengths
    std::uint32_t part = 0;  // CagePart; the body's and those of a fin's root stay where they are
};
static_assert(sizeof(FinPoint) == 32);

struct FinTable {
    FinStyle style;
    std::vector<FinPoint> points;  // one a control point
};

}  // namespace aquarama::body

namespace aquarama::config {
struct Species;
}

namespace aquarama::body {

// What a species is: the rest shape of the 23 nodal points and the control cage that is bound to
// them.

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
    glm::vec2
        fin{};  // on a fin: p along its base and q from base (0) to edge (1); on the body zero
};

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

// Thinner than the cage can draw, in the middle plane of the body (species.proto, Thread).
struct BodyThread {
    std::vector<glm::vec2> at;  // (s, y) from its root to its tip
    float rootWidth = 0.0F, tipWidth = 0.0F;
    bool isOfFirstDorsal = false;
};

struct FishBody {
    std::string species;
    float typicalLengthMetres = 0.0F;
    NodalPoints restNodes{};  // body lengths, nose at the origin, body along -x, y dorsal, z right
    std::array<float, 5> ringStations{};  // s of the five rings
    std::vector<float> profileStations;   // s of the body profile below (body lengths)
    std::vector<float> profileDorsal;     // height above the axis (positive)
    std::vector<float> profileVentral;    // depth below the axis (positive)
    std::vector<float> profileHalfWidth;
    glm::vec3 eye{};        // (s, y, radius)
    float eyeBulge = 0.0F;  // height over the skin, in radii
    std::vector<BodyThread> threads;
    ControlCage cage;
    FinTable fins;
};

[[nodiscard]] FishBody makeBody(const config::Species& species);

// The cage moved by the nodal points: cubic spine through nose, ring centres and tail, lateral axis
// from the rings. nodes and the result are in one and the same frame (body or world), body lengths.
// The rest nodes give the rest cage.
void poseCage(const FishBody& body, const NodalPoints& nodes, std::span<glm::vec3> controlPoints);

}  // namespace aquarama::body

namespace aquarama::config {
struct Species;
}

namespace aquarama::body {

// How the skin of a species is painted: by a program of its own where there is one, else plainly in
// the colours of its file.

struct FishSkin {
    std::string species;  // whose skin shader is render_node/shaders/skin_SPECIES.glsl
    // Linear Rec. 709.
    glm::vec3 back{}, flank{}, belly{};
};

[[nodiscard]] FishSkin skinOf(const config::Species& species);

}  // namespace aquarama::body
