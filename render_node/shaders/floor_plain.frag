// As floor.frag, under light from floor_plain.vert that has already been attenuated. Out: scene radiance, opaque.
#include "shader_interface.h"
#include "light.glsl"
#include "floor_sand.glsl"
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 sunlit;
layout(location = 3) in vec3 skylit;
layout(location = 4) in vec3 lamplit;
layout(location = 5) in vec3 veil;
layout(location = 0) out vec4 radiance;
void main() {
    Sand sand = sandAt(place);
    vec3 n = normalize(normal - vec3(sand.slope.x, 0.0, sand.slope.y));
    float towardsSun = max(dot(n, sunAndFilterDepth.xyz), 0.0);
    vec3 sun = sunlit * (sand.open.sun * towardsSun * caustic(place, causticLod(place)));
    radiance = vec4(sand.albedo * (sun + skylit * sand.open.sky + lamplit) + veil, 1.0);
}
