// Rock and coral.
#include "frame_uniforms.h"
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normalAndRoughness;
layout(location = 2) in vec4 albedoAndSky;
layout(location = 3) in vec4 response;  // unused, translucency, fluorescence
layout(location = 0) out vec3 place;
layout(location = 1) out vec4 normal;
layout(location = 2) out vec4 albedo;
layout(location = 3) out vec2 translucencyAndGlow;
void main() {
    place = position;
    normal = normalAndRoughness;
    albedo = albedoAndSky;
    translucencyAndGlow = response.yz;
    gl_Position = clipFromWorld * vec4(position, 1.0);
}
