// The sand, lit at each pixel.
// In: world place and normal; what sandAt() reads. Out: scene radiance, opaque.
#include "shader_interface.h"
#include "light.glsl"
#include "floor_sand.glsl"
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 radiance;
void main() {
    Sand sand = sandAt(place);
    vec3 n = normalize(normal - vec3(sand.slope.x, 0.0, sand.slope.y));
    Occlusion occlusion = sand.open;
    if (kFine) {
        occlusion = openAt(place, normal);
        occlusion.sky *= sand.open.sky / max(sand.ambient, 0.01);
    }
    radiance = vec4(seen(litUnder(occlusion, sand.albedo, place, n, 0.0), place), 1.0);
}
