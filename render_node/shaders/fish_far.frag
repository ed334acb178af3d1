// The skin of a distant fish: its pattern and its flash, without details. In: as fish_body.frag, from
// any vertex shader of fish. Out: scene radiance; alpha is `opacity`.
#include "fish_light.glsl"
#include "skin_plain.glsl"
#include "own_skin.glsl"

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 rest;
layout(location = 3) in vec2 fin;
layout(location = 5) flat in uint id;
layout(location = 6) flat in vec3 dorsal;
layout(location = 7) in float opacity;
layout(location = 9) flat in float size;  // of the fish, metres
layout(location = 0) out vec4 colour;

void main() {
    float pixel = max(length(dFdx(rest.xyz)), length(dFdy(rest.xyz)));
    SkinPoint at = SkinPoint(rest.x, rest.y, rest.z, rest.w, pixel, fwidth(rest.w), id, size, fin.y, 1.0, 0.0);
    Skin skin = wornGround(at);
    paintInside(skin, at);
    // The eye is the only detail of the head that still shows.
    float d = distance(rest.xy, eyeOfSpecies.xy) / eyeOfSpecies.z, soft = 0.7 * pixel / eyeOfSpecies.z;
    float eye = falling(1.0 - soft, 1.0 + soft, d);
    float pupil = falling(kIris.pupil - soft, kIris.pupil + soft, d);
    skin.albedo = mix(skin.albedo, kIris.colour * (0.85 - 0.80 * pupil), eye);
    skin.albedo = wetAlbedo(skin.albedo, id);
    skin.silver *= 1.0 - eye;

    vec3 toEye = normalize(eyeAndTime.xyz - place);
    vec3 n = normalize(normal);
    float facing = clamp(dot(n, toEye), 0.0, 1.0);
    vec3 radiance = litSkin(skin, place, n);
    float silver = skin.silver * smoothstep(0.0, 0.06, facing);
    if (silver > 0.0) {
        vec3 plate = plateletNormal(n, dorsal, toEye);
        vec3 shown = around(reflect(-toEye, plate), place);
        radiance = underSilver(radiance, silvered(shown, plate, skin.albedo, place, facing), silver);
    }
    colour = vec4(seen(radiance, place), opacity);
}
