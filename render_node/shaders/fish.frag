// The skin of a near fish, lit and seen through the water.
#include "light.glsl"
#include "fish_details.glsl"

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 rest;
layout(location = 5) flat in uint id;
layout(location = 6) flat in vec3 dorsal;
layout(location = 0) out vec4 colour;

void main() {
    Footprint f = Footprint(max(length(dFdx(rest.xyz)), length(dFdy(rest.xyz))), fwidth(rest.w));
    Skin skin = paintBody(rest.x, rest.y, rest.z, rest.w, id, f);
    float eye, pupil;
    paintEye(skin, rest.xy, f, eye, pupil);
    skin.albedo *= tintOf(id);

    vec3 fromEye = normalize(place - eyeAndTime.xyz);
    vec3 skinNormal = normalize(normal);
    // Towards the outline scales are seen edge on: their tilts fade before they sparkle.
    float outline = smoothstep(0.05, 0.40, -dot(skinNormal, fromEye));
    skin.tilt *= outline;
    skin.flicker *= outline;
    // Directions on the skin: towards the tail, and upwards.
    vec3 tailwards = normalize(cross(skinNormal, dorsal) + 1.0e-6) * (rest.z < 0.0 ? -1.0 : 1.0);
    vec3 upwards = normalize(dorsal - dot(dorsal, skinNormal) * skinNormal + 1.0e-6);
    vec3 n = normalize(skinNormal + skin.tilt.x * tailwards + skin.tilt.y * upwards);
    vec3 flickering = n + 0.07 * (skin.flicker.x * tailwards + skin.flicker.y * upwards);
    vec3 plate = plateletNormal(flickering, dorsal, -fromEye);

    float facing = clamp(-dot(n, fromEye), 0.0, 1.0);
    vec3 phase = 6.2831853 * (1.1 * facing + vec3(0.0, 0.33, 0.67));
    vec3 film = 1.0 + 0.9 * skin.iridescence * cos(phase);
    FishLight light = fishLight(place, fromEye);
    vec3 matte = lit(skin.albedo * film, place, n, 0.0) * light.eased;
    // One look into the mirror serves platelets where there are some, and the wet skin elsewhere.
    vec3 shown = reflected(normalize(mix(n, plate, skin.silver)), fromEye, place);
    vec3 silver = (shown + light.white * flash(plate, fromEye)) * silverTint(facing, skin.albedo);
    vec3 sheen = sheenOf(shown, skin.gloss + 1.5 * eye, facing, n.y, f.pixel);
    // The catch light of the eye, up and to the front, where the bright surface is mirrored.
    vec2 glintAt = kEye + vec2(-0.30, 0.36) * kEyeRadius;
    float glint = eye * line(distance(rest.xy, glintAt), 0.16 * kEyeRadius, f.pixel);

    vec3 radiance = mix(matte, silver, skin.silver * smoothstep(0.0, 0.25, facing));
    colour = vec4(seen(radiance + sheen + 0.25 * glint, place), 1.0);
}
