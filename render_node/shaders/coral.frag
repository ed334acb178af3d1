// Near corals, sponges and leaves: polyps as a fine relief, or the meanders of a brain coral. In: world
// metres and unit vectors from coral.vert; the detail tile. Out: scene radiance, linear Rec. 709.
#include "shader_interface.h"
#include "light.glsl"
// Interpolated at centroids: outside a thin leaf the values would be extrapolated.
layout(binding = kDetailTileUnit) uniform sampler2D relief;  // slopes, albedo, crest
layout(location = 0) centroid in vec3 place;
layout(location = 1) centroid in vec3 rest;
layout(location = 2) centroid in vec4 normal;
layout(location = 3) centroid in vec3 albedo;
layout(location = 4) centroid in vec2 open;
layout(location = 5) centroid in vec3 matter;  // translucency, fluorescence, relief
layout(location = 0) out vec4 radiance;
// Side of the tile of polyps, metres.
const float kPolypTile = 0.16;
// Height of a ridge between grooves, 0 to 1.
float meander(vec3 p) {
    p = 64.0 * (p + 0.016 * sin(15.0 * p.yzx));
    return abs(sin(p.x + sin(p.y)) + sin(p.z + sin(p.x))) * 0.5;
}
void main() {
    vec3 n = normalize(normal.xyz);
    float range = distance(place, eyeAndTime.xyz);
    // Relief finer than a pixel fades to its mean.
    float pixels = range / pixelsARadian() / 0.014;
    float near = 1.0 / (1.0 + pixels * pixels);
    vec3 colour = albedo;
    float sky = open.y;
    if (matter.z > 0.5) {
        const float kStep = 0.003;
        float here = meander(rest);
        vec3 slope = vec3(meander(rest + vec3(kStep, 0.0, 0.0)), meander(rest + vec3(0.0, kStep, 0.0)),
                          meander(rest + vec3(0.0, 0.0, kStep))) - here;
        n = normalize(n - 1.4 * near * (slope - n * dot(slope, n)));
        colour *= mix(1.0, 0.45 + 0.85 * smoothstep(0.1, 0.6, here), near);
        sky *= mix(1.0, 0.5 + 0.6 * here, near);
    } else if (normal.w > 0.3) {
        vec3 side = abs(n);
        vec2 uv = (side.y > max(side.x, side.z) ? rest.xz : side.x > side.z ? rest.zy : rest.xy) / kPolypTile;
        float lod = log2(max(range * (512.0 / kPolypTile) / pixelsARadian(), 1.0));
        vec4 fine = textureLod(relief, uv, lod);
        colour *= mix(1.0, 2.0 * fine.z * (0.35 + 1.1 * fine.w), 0.7 * normal.w + 0.3);
        // Polyps stand on the crests, paler than the skeleton between them; a wave of closing passes over them.
        float closing = 0.5 + 0.5 * sin(dot(rest, vec3(2.1, 1.3, 1.7)) - 0.7 * eyeAndTime.w);
        float polyp = near * normal.w * smoothstep(0.50, 0.85, fine.w) * (0.45 + 0.55 * closing);
        colour = mix(colour, min(colour * 1.45 + vec3(0.06, 0.055, 0.03), vec3(0.85)), polyp);
        sky *= mix(1.0, 0.4 + fine.w, normal.w);
        vec3 slope = vec3(fine.x - 0.5, 0.0, fine.y - 0.5);
        n = normalize(n - 1.2 * normal.w * (slope - n * dot(slope, n)));
    }
    vec3 light = litUnder(Occlusion(open.x, sky), colour, place, n, matter.x) + fluorescent(colour, matter.y * sky);
    radiance = vec4(seen(light, place), 1.0);
}
