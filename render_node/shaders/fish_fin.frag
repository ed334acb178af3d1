// The fins: clear membranes between rays.
#include "light.glsl"
#include "fish_skin.glsl"

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 rest;
layout(location = 3) in vec2 fin;
layout(location = 4) flat in uint part;
layout(location = 5) flat in uint id;
layout(location = 6) flat in vec3 dorsal;
layout(location = 0) out vec4 colour;

void main() {
    vec3 albedo = vec3(0.34, 0.36, 0.30);
    float opacity = 0.42 + 0.2 * smoothstep(0.4, 0.0, fin.y);
    if (part == kCaudal) {
        albedo = mix(vec3(0.30, 0.30, 0.16), vec3(0.055, 0.06, 0.06), 0.8 * smoothstep(0.55, 1.0, fin.y));
        opacity = 0.8;
    }
    vec3 n = normalize(normal);
    colour = vec4(seen(lit(albedo, place, n, 0.5), place), opacity);
}
