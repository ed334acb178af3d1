// As rock.frag, with two scales of grit from one side.
// In: from rock_plain.vert, light that has already been attenuated. Out: scene radiance, opaque.
#include "shader_interface.h"
#include "light.glsl"
layout(binding = kDetailTileUnit) uniform sampler2D grit;  // slopes, albedo, crest
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 mottle;  // lightness, turf, crust
layout(location = 3) in vec3 sunlit;
layout(location = 4) in vec3 skylit;
layout(location = 5) in vec3 veil;
layout(location = 0) out vec4 radiance;
#include "rock_colour.glsl"
void main() {
    vec3 side = abs(normal);
    vec2 uv = side.y > max(side.x, side.z) ? place.xz : side.x > side.z ? place.zy : place.xy;
    vec4 relief = texture(grit, uv / kRockTileMetres);
    vec4 broad = texture(grit, uv / 3.7);
    float pits = mix(0.30, 1.0, smoothstep(0.15, 0.75, relief.w)) * mix(0.5, 1.0, smoothstep(0.2, 0.6, broad.w));
    vec3 colour = rockColour(mottle, 4.0 * relief.z * broad.z, broad.w + 0.35 * (relief.w - 0.5), relief.w);
    vec3 light = colour * (sunlit * caustic(place, 2.0) + skylit * pits);
    radiance = vec4(light + veil, 1.0);
}
