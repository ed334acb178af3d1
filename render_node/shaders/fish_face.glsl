// Jaws, gill covers and breath: a pure function of time and of a fish's record. common/body/face.h is
// the reference. Lengths in body lengths, times in seconds.
#ifndef FISH_FACE_GLSL
#define FISH_FACE_GLSL
#include "face_motion.h"
#include "fin_motion.h"
#include "fish_data.glsl"

// How far a fish has opened its mouth and lifted its gill covers, 0 to 1.
struct FacePose {
    float mouth, gill;
};

float breathHertz(float lengthMetres) {
    float hertz = kBreathHertz * pow(max(lengthMetres, 0.01), kBreathPower);
    return floor(10.0 * clamp(hertz, kLeastBreathHertz, kMostBreathHertz) + 0.5) / 10.0;
}

float breathAt(float cycles) { return 0.5 - 0.5 * cos(kWholeTurn * cycles); }

// seconds: of the show.
FacePose facePose(Fish self, float seconds) {
    float flat_ = smoothstep(kBreathesDeep, kBreathesFlat, abs(self.speed));
    float cycles = breathHertz(self.lengthMetres) * mod(seconds, kFinSeconds) + fract(0.618 * float(self.id));
    float rests = max(1.0 - flat_, self.spread);
    float mouth = mix(kSwimmingBreath, kRestingBreath, rests) * breathAt(cycles);
    float gill = mix(kSwimmingGill, 1.0, rests) * breathAt(cycles - kGillLag);
    return FacePose(self.mouth + (1.0 - self.mouth) * mouth, mix(gill, 1.0, kGapingGill * self.mouth));
}
#endif
