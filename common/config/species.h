// SPDX-License-Identifier: Apache-2.0
// A species of fish as its file describes it: shape, biomechanics, gaits, habits and colours.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/habits.h"

namespace aquarama::config {

// On the animal lengths are body lengths: s from 0 at the nose to 1 at the tip of the tail, y up.
// Columns of equal length, ascending s.
struct BodyProfile {
    std::vector<float> stations;
    std::vector<float> dorsal;
    std::vector<float> ventral;  // positive
    std::vector<float> halfWidth;
    // Of the section above and below the axis: the exponent of a superellipse, |z|^n + |y|^n = 1.
    std::vector<float> fullnessUp, fullnessDown;
};

// A ruled patch of points (s, y): ray by ray from the base on the body to the edge.
struct Fin {
    std::vector<glm::vec2> base;
    std::vector<glm::vec2> edge;
    float angleRadians = 0.0F;  // paired fins: how far it stands off the flank
    float round = 0.0F;         // paired fins: 1 makes a paddle of what is drawn
    float flex = 1.0F;          // median fins and tail: how far it ripples
};

struct Fins {
    Fin firstDorsal;  // the only one, along the whole back, where there is no second
    std::optional<Fin> secondDorsal;
    Fin anal, caudal, pelvic, pectoral;
};

// How fins move beside the body, at their most; all zero: they keep still (species.proto).
struct Rowing {
    float beatHertz = 0;
    float strokeRadians = 0, featherRadians = 0, openRadians = 0, flapRadians = 0, trimRadians = 0;
    float alternateBelow = 0, foldAbove = 0;  // body lengths a second
};
struct Ripple {
    float amplitude = 0;  // lengths of a ray
    float waves = 0;
    float beatHertz = 0;
    bool isOpposed = false;
};
struct FinMotion {
    Rowing rowing;
    Ripple swimming, hovering;
    float cuppingRadians = 0, pelvicFoldRadians = 0;
};

struct FishEye {
    float s = 0.0F;
    float y = 0.0F;
    float radius = 0.0F;
    float bulge = 0.35F;  // height over the skin, in radii
};

// Thinner than the cage can draw, in the middle plane of the body.
struct Thread {
    std::vector<glm::vec2> at;                // (s, y) from its root to its tip
    float rootWidth = 0.0F, tipWidth = 0.0F;  // seen from the side
    bool isOfFirstDorsal = false;
};

struct SkeletonRing {
    double s = 0, halfHeight = 0, halfWidth = 0;
    double nodeMass = 0;
};

// The nodal points at rest; masses count relative to each other.
struct Skeleton {
    std::array<SkeletonRing, 5> rings;
    double tailHalfSpan = 0;
    double noseMass = 0;
    double tailTipMass = 0;
};

// Units: body lengths, the animal's mass, and its own seconds, of which timeScale make one of ours.
struct Tissue {
    double timeScale = 1;
    double stiffness = 0, crossStiffness = 0, muscleStiffness = 0;
    double tailStiffening = 1;  // factor on all units behind ring 3
    double damping = 0;
    double muscleContraction = 0;  // share of its length lost at full contraction
};

struct Water {
    double drag = 0;         // mu: force on an advancing face = mu * area * (normal speed)^2
    double frontFactor = 1;  // share of that on the head
    double finDrag = 0;      // of each pectoral fin: force = finDrag * normal speed
};

struct Gait {
    double beatHertz = 0;
    double gain = 1;
};

struct Swim {
    double middleDrive = 0, backDrive = 0;  // contraction, 0 to 1
    double backLagRadians = 0;
    Gait slow, medium, fast;
};

// Of the whole body to one side, quick to come and slow to go.
struct Bend {
    double strength = 0;  // 0 to 1
    double tempo = 1;     // 1: over in 1.45 of the fish's own seconds
};

struct Turn {
    Bend gradual, sharp;
};

// How long the fish of a species are: a bell curve, cut off.
struct SizeRange {
    float meanMetres = 0.24F, deviationMetres = 0.012F, leastMetres = 0.20F, mostMetres = 0.28F;
};

struct Paint {
    std::string part;
    glm::vec3 linear{};  // Rec. 709
};

struct Species {
    std::string name;
    SizeRange size;
    BodyProfile profile;
    Fins fins;
    FinMotion finMotion;
    FishEye eye;
    std::vector<Thread> threads;
    Skeleton skeleton;
    Tissue tissue;
    Water water;
    Swim swim;
    Turn turn;
    Habits habits;
    std::vector<Paint> palette;
    // The repertoire keeps the control points of every frame (eq. 9) beside the nodal points, which
    // saves time and costs memory: for those that swim in great numbers.
    bool recordsControlPoints = false;
};

// Throws Error with file:line:column for whatever the schema or the animal cannot have.
[[nodiscard]] Species readSpecies(const std::string& path);
[[nodiscard]] Species parseSpecies(const std::string& text, const std::string& source);
// All of the file that moves the animal, in one form: no habits, colours or comments. Two files
// that agree in it swim alike.
[[nodiscard]] std::string motionText(const std::string& text, const std::string& source);

}  // namespace aquarama::config
