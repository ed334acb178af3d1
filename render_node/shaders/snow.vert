// Marine snow: specks in a box round the shared eye that wraps in the world.
// In: the vertex number alone. Out: point sprites in clip space with the light that reaches the
// eye.
#include "water.glsl"
#include "sea_now.glsl"
#include "hash.h"
#include "speck_lens.glsl"
layout(location = 0) out vec3 light;
// Side of the box.
const float kBoxMetres = 9.0;
float unit(uint n) { return unitOf(hashOf(uint(gl_VertexID) * 4u + n)); }
void main() {
    vec3 home = vec3(unit(0u), unit(1u), unit(2u));
    vec2 carried = 0.25 * surge(home * 9.0 - vec3(0.0, 9.0, 0.0));
    vec3 sinking = vec3(0.05, -0.012, 0.03) * eyeAndTime.w + vec3(current.x, 0.0, current.y);
    vec3 eye = eyeAndTime.xyz;
    vec3 away = (fract(home + (sinking + vec3(carried.x, 0.0, carried.y) - eye) / kBoxMetres) - 0.5) *
                kBoxMetres;
    vec3 place = eye + away;
    float range = length(away);
    float e = unit(3u);
    float diameter = mix(0.0005, 0.0026, e * e * e * e * e);
    float perRadian = pixelsARadian();
    float sharp = diameter / range * perRadian;
    float blur = lensBlurRadians(range) * perRadian;
    // In pixels; never so small that it twinkles as it drifts across them.
    float size = sqrt(sharp * sharp + blur * blur + 2.2);
    float fade = nearFade(range) * smoothstep(0.5, 0.36, range / kBoxMetres);
    float phase = 1.4 * lobe(dot(away / range, sunAndFilterDepth.xyz), 0.75) + 0.12;
    vec3 lit = unscatteredShare(-place.y) * caustic(place, 1.0) * pastFish(place).sun * sunlight.rgb +
               0.35 * skylight.rgb;
    light = direct(vec3(0.95, 0.97, 1.0) * (phase * lit / kPi), range, max(-place.y, 0.1)) *
            (0.5 * fade * sharp * sharp / (size * size));
    gl_Position = place.y < -0.1 ? clipFromWorld * vec4(place, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = min(2.0 * size, 0.012 * viewport.z);
}
