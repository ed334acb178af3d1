// Fins that row, flutter, ripple and fold beside the body: a pure function of time and of a fish's
// record. common/body/fins.h is the reference. Lengths in body lengths, angles in radians, times in
// seconds; axes tailwards, up, right.
#ifndef FISH_FINS_GLSL
#define FISH_FINS_GLSL
#include "fin_motion.h"
#include "fish_face.glsl"
#include "shader_interface.h"

// FinStyle and FinPoint of common/body/fish_body.h. Tailwards, up, away from the body; the left side
// is the mirror image of the right.
struct FinStyle {
    vec3 hinge;
    float spread;
    vec3 stroke;
    float trim;
    vec3 ray;
    float pelvicFold;
    float swimRipple, swimWaves, hoverRipple, hoverWaves;
    float hoverHertz, opposed, cupping;
    float gape, protrusion, flare;  // of the face
};
struct FinPoint {
    vec3 arm;
    float side;
    float p, q, sway;
    uint part;
};

// The inputs of the motion of one fish's fins. A pectoral fin's pose is how far it is opened, carried by
// its stroke, and twisted.
struct FinDrive {
    float seconds, speed;
    float tilt, spread;
    vec3 left, right;
    float own;     // the fish's phase offset, cycles
    float phase, fromPhase, weight;
};

vec3 rotatedAbout(vec3 axis, float angle, vec3 v) {
    float c = cos(angle);
    return c * v + sin(angle) * cross(axis, v) + (1.0 - c) * dot(axis, v) * axis;
}

// A pectoral fin stands as it was captured, with a twist that balances; a fish that brakes holds it
// across the water.
vec3 rowedFin(FinStyle style, FinPoint point, FinDrive drive) {
    bool isRight = point.side > 0.0;
    vec3 pose = isRight ? drive.right : drive.left;
    float rows = 1.0 - drive.spread;
    float lift = isRight ? -drive.tilt : drive.tilt;
    float twist = rows * pose.z + style.trim * clamp(kTrimGain * lift, -1.0, 1.0);
    vec3 arm = rotatedAbout(style.ray, twist * point.q, point.arm);
    arm = rotatedAbout(style.hinge, mix(pose.x, style.spread, drive.spread), arm);
    return rotatedAbout(style.stroke, rows * pose.y, arm) - point.arm;
}

float finWave(FinPoint point, float cycles, float waves) {
    return sin(kWholeTurn * (waves * point.p - cycles) - kMarginLag * point.q);
}

float rippledFin(FinStyle style, FinPoint point, FinDrive drive) {
    float swimming = mix(finWave(point, drive.fromPhase, style.swimWaves),
                         finWave(point, drive.phase, style.swimWaves), drive.weight);
    float opposed = point.part == kAnal ? style.opposed / kWholeTurn : 0.0;
    float hovering = finWave(point, style.hoverHertz * drive.seconds + drive.own + opposed,
                             style.hoverWaves);
    return point.sway * mix(style.hoverRipple * hovering, style.swimRipple * swimming,
                            smoothstep(kStands, kSwims, abs(drive.speed)));
}

// faceOffset() of common/body/face.h: the lower jaw turns, the upper one slides, the gill covers lift.
vec3 faceOffset(FinStyle style, FinPoint point, FacePose pose) {
    float angle = style.gape * pose.mouth * point.q;
    float c = cos(angle), s = sin(angle);
    vec2 jaw = point.q > 0.0 ? mat2(c, s, -s, c) * point.arm.xy - point.arm.xy : vec2(0.0);
    return vec3(jaw, 0.0) + point.p * style.protrusion * pose.mouth * point.arm +
           vec3(0.0, 0.0, point.sway * style.flare * pose.gill * point.side);
}

// The displacement of a control point from where the body alone would place it: tailwards, up, to the
// right.
vec3 finOffset(FinStyle style, FinPoint point, FinDrive drive, float drift) {
    vec3 mirror = vec3(1.0, 1.0, point.side);
    switch (point.part) {
        case kBody: return vec3(0.0);  // see faceOffset()
        case kPectoral: return rowedFin(style, point, drive) * mirror;
        case kPelvic: {
            float angle = style.pelvicFold * (1.0 - drive.spread) * smoothstep(kStands, kFolded, abs(drive.speed));
            return (rotatedAbout(vec3(0.0, 0.0, 1.0), angle, point.arm) - point.arm) * mirror;
        }
        case kCaudal: {
            float lobe = 2.0 * point.p - 1.0;
            float bend = clamp(drift, -kMostDrift, kMostDrift) * style.cupping;
            return vec3(0.0, 0.0, bend * (lobe * lobe - 0.5) * pow(point.q, 1.5));
        }
        default: return vec3(0.0, 0.0, rippledFin(style, point, drive));
    }
}

// Converts (tailwards, up, right) to the body frame, in which right is turned from z towards x.
vec3 turnedBy(float heading, vec3 offset) {
    float c = cos(heading), s = sin(heading);
    return vec3(s * offset.z - c * offset.x, offset.y, c * offset.z + s * offset.x);
}
#endif
