// Twigs, tubes and fans, lit at their corners: a pixel holds several of them.
#include "shading.glsl"
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 normalAndRoughness;
layout(location = 2) in vec4 albedoAndSky;
layout(location = 3) in vec4 response;  // unused, translucency, fluorescence
layout(location = 0) out vec3 light;
void main() {
    vec3 normal = normalize(normalAndRoughness.xyz);
    vec3 albedo = albedoAndSky.rgb;
    Openness open = openAt(place, normal);
    open.sun *= mix(0.5, 1.0, albedoAndSky.w);
    open.sky *= albedoAndSky.w;
    vec3 own = litAt(1.0, open, albedo, place, normal, response.y) +
               fluorescent(albedo, response.z * albedoAndSky.w);
    light = seen(own, place);
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
