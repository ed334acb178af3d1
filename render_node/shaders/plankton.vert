// Plankton: small clear bodies that catch the light as they turn. Those that cannot be seen are left out first.
// In: specks, world metres; the sea's light. Out: point sprites in clip space with the light that reaches the eye.
#include "shader_interface.h"
#include "water.glsl"
#include "food_particle.glsl"
#include "speck_lens.glsl"
layout(location = kFirstLocation) uniform int first;
layout(location = 0) out vec3 light;
// Colour of the bodies.
const vec3 kTint = vec3(1.0, 0.96, 0.78);
// Most light of a speck once it is exposed: less than blooms.
const float kBrightest = 0.35;
void main() {
    Speck speck = specks[first + gl_VertexID];
    vec3 way = speck.place - eyeAndTime.xyz;
    float range = length(way);
    light = vec3(0.0);
    gl_Position = kOutside;
    gl_PointSize = 1.0;
    if (range >= kPlanktonMetres || !isInFrustum(speck.place, kMostReach)) return;
    float diameter = mix(0.0030, 0.0065, unit(speck.seed, 3u));
    float sharp = diameter / range * pixelsARadian();
    float blur = lensBlurRadians(range) * pixelsARadian();
    float size = sqrt(sharp * sharp + blur * blur + 1.4);
    // A flat side turns through the sun's direction once in a while.
    float turn = eyeAndTime.w * mix(0.5, 1.3, unit(speck.seed, 4u)) + 6.2832 * unit(speck.seed, 5u);
    vec3 side = axisOf(speck.seed);
    side = vec3(side.x * cos(turn) - side.z * sin(turn), side.y, side.x * sin(turn) + side.z * cos(turn));
    float glint = pow(abs(dot(side, normalize(sunAndFilterDepth.xyz - way / range))), 24.0);
    float phase = 1.1 * lobe(dot(way / range, sunAndFilterDepth.xyz), 0.7) + 0.16;
    vec3 lit = sunlight.rgb * (unscatteredShare(-speck.place.y) * caustic(speck.place, 1.0) * (phase + 0.9 * glint));
    float fade = nearFade(range) * smoothstep(kPlanktonMetres, 0.6 * kPlanktonMetres, range);
    vec3 outgoing = kTint * ((lit + 0.35 * phase * skylight.rgb) / kPi);
    light = direct(outgoing, range, max(-speck.place.y, 0.1)) * (0.8 * sharp * sharp / (size * size));
    float exposed = max(light.g, max(light.r, light.b)) * kdAndExposure.w;
    light *= fade * min(1.0, kBrightest / max(exposed, 1.0e-6));
    gl_Position = clipFromWorld * vec4(speck.place, 1.0);
    gl_PointSize = min(2.0 * size, 0.02 * viewport.z);
}
