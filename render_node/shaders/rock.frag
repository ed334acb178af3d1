// Rock: grit, pits and knobs at two or three scales, mapped from three sides; turf on faces that look
// up, pink crusts of algae in the shade, sponges in patches. In: world place and normal, colours and
// occlusion from rock.vert; the rock tile. Out: scene radiance, opaque.
#include "shader_interface.h"
#include "light.glsl"
// Interpolated at centroids: outside a thin shape the values would be extrapolated.
layout(binding = kDetailTileUnit) uniform sampler2D grit;  // slopes, albedo, crest
layout(location = kRockScalesLocation) uniform int scales;        // 2 or 3
layout(location = 0) centroid in vec3 place;
layout(location = 1) centroid in vec3 normal;
layout(location = 2) centroid in vec3 mottle;  // lightness, turf, crust
layout(location = 3) centroid in vec2 open;
layout(location = 4) centroid in vec3 tint;
layout(location = 0) out vec4 radiance;

// xyz: slope as a vector of the world; tone: albedo and crest.
struct Relief {
    vec3 slope;
    vec2 tone;
};
Relief reliefAt(vec3 p, vec3 weight, float tile, float pixelMetres) {
    float lod = log2(max(pixelMetres * float(kDetailTexels) / tile, 1.0));
    vec4 above = textureLod(grit, p.xz / tile, lod) - vec4(0.5, 0.5, 0.0, 0.0);
    vec4 east = textureLod(grit, p.zy / tile + 0.37, lod) - vec4(0.5, 0.5, 0.0, 0.0);
    vec4 south = textureLod(grit, p.xy / tile + 0.71, lod) - vec4(0.5, 0.5, 0.0, 0.0);
    vec3 slope = weight.y * vec3(above.x, 0.0, above.y) + weight.x * vec3(0.0, east.y, east.x) +
                 weight.z * vec3(south.xy, 0.0);
    return Relief(slope, weight.y * above.zw + weight.x * east.zw + weight.z * south.zw);
}
#include "rock_colour.glsl"
void main() {
    vec3 n = normalize(normal);
    float pixelMetres = distance(place, eyeAndTime.xyz) / pixelsARadian();
    vec3 weight = pow(abs(n), vec3(4.0));
    weight /= weight.x + weight.y + weight.z;
    Relief broad = reliefAt(place, weight, 3.7, pixelMetres);
    Relief middle = reliefAt(place + 0.9, weight, kRockTileMetres, pixelMetres);
    Relief fine = Relief(vec3(0.0), vec2(0.5));
    if (scales > 2) fine = reliefAt(place, weight, 0.31, pixelMetres);
    vec3 slope = 1.1 * broad.slope + 0.9 * middle.slope + 0.5 * fine.slope;
    n = normalize(n - (slope - n * dot(slope, n)));
    float tone = 2.0 * middle.tone.x * mix(1.0, 2.0 * fine.tone.x, 0.9) * mix(1.0, 2.0 * broad.tone.x, 0.8);
    float pits = mix(0.30, 1.0, smoothstep(0.15, 0.75, middle.tone.y)) *
                 mix(0.35, 1.0, smoothstep(0.15, 0.55, fine.tone.y)) *
                 mix(0.45, 1.0, smoothstep(0.15, 0.6, broad.tone.y));
    float patches = broad.tone.y + 0.35 * (middle.tone.y - 0.5);
    vec3 sponge = vec3(0.58, 0.27, 0.07) * (0.7 + 0.5 * middle.tone.y);
    vec3 colour = rockColour(mottle, tone, patches, middle.tone.y);
    colour = mix(colour, sponge, 0.8 * smoothstep(0.86, 0.94, patches + 0.15 * (fine.tone.y - 0.5)) * step(n.y, 0.6));
    Occlusion occlusion = Occlusion(open.x * mix(0.6, 1.0, pits), open.y * pits);
    if (kFine) {
        Occlusion mapped = openAt(place, normalize(normal));
        occlusion = Occlusion(min(occlusion.sun, mapped.sun), min(occlusion.sky, mapped.sky));
    }
    radiance = vec4(seen(litUnder(occlusion, colour * tint, place, n, 0.0), place), 1.0);
}
