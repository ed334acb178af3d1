// Kelp and seagrass: a stem that the swell bends, and blades that hang on it.
#include "frame_uniforms.h"
#include "plant_bend.h"
#include "shading.glsl"
#include "sea_now.glsl"
layout(location = 0) in vec4 offsetAndShare;  // from the stem, metres; share of the height
layout(location = 1) in vec4 normalAndBlade;  // w: place along the blade
layout(location = 2) in vec4 albedo;
layout(location = 4) in vec4 rootAndHeight;  // of this plant
layout(location = 5) in vec4 habit;          // cosine and sine of its turn, lean in x and z
layout(location = 6) in vec4 tintAndSway;    // w: share of the swell that its tip follows
layout(location = 0) out vec3 light;
vec3 turned(vec3 v) {
    return vec3(habit.x * v.x + habit.y * v.z, v.y, habit.x * v.z - habit.y * v.x);
}
void main() {
    float share = offsetAndShare.w, height = rootAndHeight.w;
    vec3 root = rootAndHeight.xyz;
    vec2 lean = habit.zw * height;
    vec2 swell = surge(root + vec3(0.0, 0.6 * height, 0.0));
    vec3 stem = root + bentStem(share, height, lean + tintAndSway.w * height * swell);
    // A blade lags behind the stem and trails with the water.
    float blade = normalAndBlade.w;
    vec2 trail = surge(stem * vec3(1.0, 1.6, 1.0) + vec3(0.0, 0.0, 3.0 * share)) * blade * blade;
    vec3 place = stem + turned(offsetAndShare.xyz) + 0.16 * vec3(trail.x, -0.3 * abs(trail.x), trail.y);
    // A leaf has two sides: the one that looks at us is lit.
    vec3 normal = normalize(turned(normalAndBlade.xyz));
    normal *= dot(normal, eyeAndTime.xyz - place) < 0.0 ? -1.0 : 1.0;
    Openness open = openAt(place, normal);
    open = Openness(open.sun * albedo.a, open.sky * albedo.a);
    light = seen(litAt(1.0, open, albedo.rgb * tintAndSway.rgb, place, normal, 0.75), place);
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
