// The skin of a near fish, lit and seen through the water. The skin shader's file takes the place of
// the plain one where the species has a skin shader.
// In: world place and normal, place on the skin (body lengths). Out: scene radiance, opaque.
#include "fish_light.glsl"
#include "skin_eye.glsl"
#include "skin_plain.glsl"
#include "own_skin.glsl"

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 rest;
layout(location = 3) in vec2 fin;
layout(location = 4) flat in uint part;
layout(location = 5) flat in uint id;
layout(location = 6) flat in vec3 dorsal;
layout(location = 8) flat in float nearness;  // 0: as fish_far.frag has it
layout(location = 9) flat in float size;  // of the fish, metres
layout(location = 10) flat in vec4 face;  // gaze in the body frame; how far the gill cover is lifted
layout(location = 0) out vec4 colour;

void main() {
    float pixel = max(length(dFdx(rest.xyz)), length(dFdy(rest.xyz)));
    SkinPoint at = SkinPoint(rest.x, rest.y, rest.z, rest.w, pixel, fwidth(rest.w), id, size,
                             part == kEye ? 0.0 : fin.y, 0.0, face.w);
    at.lips = (kLips - at.mouth) * pixel / max(length(vec2(dFdx(at.mouth), dFdy(at.mouth))), 1.0e-5);
    Skin far = wornGround(at);
    Skin skin = far;
    addWornDetails(skin, at);
    paintLips(skin, at);
    skin.albedo = mix(far.albedo, skin.albedo, nearness);
    skin.silver = mix(far.silver, skin.silver, nearness);
    paintInside(skin, at);

    vec3 toEye = normalize(eyeAndTime.xyz - place);
    vec3 skinNormal = normalize(normal);
    // Directions on the skin: towards the tail, and upwards.
    vec3 tailwards = normalize(cross(skinNormal, dorsal) + 1.0e-6) * (rest.z < 0.0 ? -1.0 : 1.0);
    vec3 upwards = normalize(dorsal - dot(dorsal, skinNormal) * skinNormal + 1.0e-6);
    vec3 look = vec3(dot(toEye, tailwards), dot(toEye, upwards), dot(toEye, skinNormal));
    // Towards the outline scales are seen edge on: their tilts fade before they sparkle.
    float outline = nearness * smoothstep(0.05, 0.40, look.z);
    skin.tilt *= outline;
    skin.flicker *= outline;
    skin.albedo = wetAlbedo(skin.albedo, id);
    float eye = paintEye(skin, at, kIris, part == kEye ? 0.3 : 0.85, look,
                         eyeTurn(face.xyz, sign(rest.z)));

    vec3 n = normalize(skinNormal + skin.tilt.x * tailwards + skin.tilt.y * upwards);
    float facing = clamp(dot(n, toEye), 0.0, 1.0);
    skin.albedo = iridescent(skin.albedo, nearness * skin.iridescence, facing);
    vec3 radiance = litSkin(skin, place, n);

    vec3 flickering = skinNormal + (0.35 * skin.tilt.x + 0.16 * skin.flicker.x) * tailwards +
                      (0.35 * skin.tilt.y + 0.36 * skin.flicker.y) * upwards;
    vec3 plate = plateletNormal(normalize(flickering), dorsal, toEye);
    // One look into the mirror serves platelets where there are some, and the wet skin elsewhere.
    vec3 facet = normalize(mix(n, plate, mix(1.0, skin.silver, nearness)));
    vec3 shown = around(reflect(-toEye, facet), place);
    float silver = skin.silver * smoothstep(0.0, 0.06, look.z);
    radiance = underSilver(radiance, silvered(shown, facet, skin.albedo, place, facing), silver);
    radiance += nearness * (sheenOf(shown, skin.gloss, facing, n.y, pixel) +
                            eye * cornea(reflect(-toEye, n), facing));
    colour = vec4(seen(radiance, place), 1.0);
}
