// Fins that row, flutter, ripple and fold beside the body: a pure function of time and of a fish's
// record. common/body/fins.h is the reference. Lengths in body lengths, angles in radians, times in
// seconds; axes tailwards, up, right.
#ifndef FISH_FINS_GLSL
#define FISH_FINS_GLSL
#include "fin_motion.h"
#include "shader_interface.h"

// FinStyle and FinPoint of common/body/fish_body.h. Tailwards, up, away from the body; the left side
// is the mirror image of the right.
struct FinStyle {
    vec3 hinge;
    float open;
    vec3 stroke;
    float fold;
    vec3 ray;
    float strokeAngle;
    float featherAngle, trimAngle, rowHertz, alternateBelow;
    float foldAbove, pelvicFold, swimRipple, swimWaves;
    float hoverRipple, hoverWaves, hoverHertz, opposed;
    float cupping, spread;
};
struct FinPoint {
    vec3 arm;
    float side;
    float p, q, sway;
    uint part;
};

// The inputs of the motion of one fish's fins.
struct FinDrive {
    float seconds, speed, climb;
    float tilt, spread;
    vec2 turning;  // how far it is in a turn to the left, to the right
    float own;     // the fish's phase offset, cycles
    float phase, fromPhase, weight;
};

vec3 rotatedAbout(vec3 axis, float angle, vec3 v) {
    float c = cos(angle);
    return c * v + sin(angle) * cross(axis, v) + (1.0 - c) * dot(axis, v) * axis;
}

// 0 well below a speed, 1 well above it.
float beyondSpeed(float speed, float limit) {
    float band = kFoldBand * limit + 1.0e-4;
    return smoothstep(limit - band, limit + band, abs(speed) + 1.0e-3);
}

// A pectoral fin rows with its stroke and feathers its blade. Fast fish fold it, and a fish that brakes
// holds it across the water. Its twist gives lift, for a slope and for balance. Below the speed
// `alternateBelow` the left fin is half a cycle behind the right one.
vec3 rowedFin(FinStyle style, FinPoint point, FinDrive drive) {
    bool isRight = point.side > 0.0;
    float apart = isRight ? 0.0 : 0.5 * (1.0 - beyondSpeed(drive.speed, style.alternateBelow));
    float beat = style.rowHertz * drive.seconds + drive.own + apart;
    float outer = isRight ? drive.turning.x : drive.turning.y;
    float opens = (1.0 - beyondSpeed(drive.speed, style.foldAbove)) * (1.0 - outer);
    float rows = opens * (1.0 - drive.spread);
    float lift = drive.climb - (isRight ? drive.tilt : -drive.tilt);
    float twist = rows * style.featherAngle * cos(kWholeTurn * beat) +
                  style.trimAngle * clamp(kTrimGain * lift, -1.0, 1.0);
    float angle = rows * style.strokeAngle * sin(kWholeTurn * (beat - kTipLag * point.q));
    vec3 arm = rotatedAbout(style.ray, twist * point.q, point.arm);
    float opened = mix(style.fold, style.open, opens);
    arm = rotatedAbout(style.hinge, mix(opened, style.spread, drive.spread), arm);
    return rotatedAbout(style.stroke, angle, arm) - point.arm;
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

// The displacement of a control point from where the body alone would place it: tailwards, up, to the
// right.
vec3 finOffset(FinStyle style, FinPoint point, FinDrive drive, float drift) {
    vec3 mirror = vec3(1.0, 1.0, point.side);
    switch (point.part) {
        case kBody: return vec3(0.0);
        case kPectoral: return rowedFin(style, point, drive) * mirror;
        case kPelvic: {
            float angle = style.pelvicFold * (1.0 - drive.spread) * smoothstep(kStands, kFolded, abs(drive.speed));
            return (rotatedAbout(vec3(0.0, 0.0, 1.0), angle, point.arm) - point.arm) * mirror;
        }
        case kCaudal: {
            float lobe = 2.0 * point.p - 1.0;
            return vec3(0.0, 0.0, drift * style.cupping * (lobe * lobe - 0.5) * pow(point.q, 1.5));
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
