// The skin of a fish of the reef, lit and seen through the water.
#include "light.glsl"
#include "reef_skins.glsl"

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 rest;
layout(location = 5) flat in uint id;
layout(location = 6) flat in vec3 dorsal;
layout(location = 0) out vec4 colour;

// Pupil, iris and a dark rim. Returns how much of the pixel the eye covers.
float paintEye(inout Paint paint, vec2 at, float pixel) {
    float d = distance(at, eyeOfSpecies.xy) / eyeOfSpecies.z;
    float soft = 0.7 * pixel / eyeOfSpecies.z;
    float eye = 1.0 - smoothstep(1.0 - soft, 1.0 + soft, d);
    float pupil = 1.0 - smoothstep(0.47 - soft, 0.47 + soft, d);
    vec3 iris = mix(irisOf() * 0.85, vec3(0.003, 0.004, 0.006), pupil);
    iris = mix(iris, vec3(0.010, 0.012, 0.014), 0.85 * smoothstep(0.80, 0.98, d));
    paint.albedo = mix(paint.albedo, iris, eye);
    return eye;
}

void main() {
    float pixel = max(length(dFdx(rest.xyz)), length(dFdy(rest.xyz)));
    Paint paint = paintOf(rest.x, rest.w, rest.y, id, pixel);
    paint.albedo *= tintOf(id);
    float eye = paintEye(paint, rest.xy, pixel);
    paint.gloss = mix(paint.gloss, 1.0, eye);

    vec3 fromEye = normalize(place - eyeAndTime.xyz);
    vec3 n = normalize(normal);
    float facing = clamp(-dot(n, fromEye), 0.0, 1.0);
    FishLight light = fishLight(place, fromEye);
    vec3 matte = lit(paint.albedo, place, n, 0.0) * light.eased;
    vec3 shown = reflected(n, fromEye, place);
    float glint = eye * line(distance(rest.xy, eyeOfSpecies.xy + vec2(-0.30, 0.36) * eyeOfSpecies.z),
                             0.16 * eyeOfSpecies.z, pixel);
    vec3 radiance = matte + sheenOf(shown, paint.gloss, facing, n.y, pixel) + 0.25 * glint;
    colour = vec4(seen(radiance, place), 1.0);
}
