// Rock: worn limestone, lit at each pixel.
#include "instance.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normalAndRoughness;
layout(location = 2) in vec4 mottleAndSky;  // lightness, turf, pink crust; openness
layout(location = 4) in uint chosen;
layout(location = 0) out vec3 place;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec3 mottle;
layout(location = 3) out vec2 open;
layout(location = 4) out vec3 tint;
void main() {
    Instance one = instances[chosen];
    place = one.placeAndScale.xyz + one.placeAndScale.w * turned(one.turn, position);
    normal = turned(one.turn, normalAndRoughness.xyz);
    mottle = mottleAndSky.rgb;
    float contact = mix(0.4, 1.0, smoothstep(-0.1, 0.6, (place.y - one.light.z) / min(one.placeAndScale.w, 1.0)));
    open = vec2(one.light.x * mix(0.3, 1.0, mottleAndSky.w), one.light.y * mottleAndSky.w * contact);
    tint = one.tintAndSway.rgb;
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
