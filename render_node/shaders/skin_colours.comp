// The colours of a species' skin at places on it, as on a young fish from near and in plain light. The skin shader's
// file takes the place of the plain one where the species has a skin shader.
// In: for each place s, y, z, v (body lengths), and p, q and part. Out: linear albedo, opacity.
#include "shader_interface.h"
#include "skin_eye.glsl"
#include "skin_plain.glsl"

layout(local_size_x = kGroupSize) in;
struct Place {
    vec4 rest, fin;
};
layout(std430, binding = kSkinPlacesStorage) readonly buffer Places { Place places[]; };
layout(std430, binding = kSkinColoursStorage) writeonly buffer Colours { vec4 colours[]; };

const float kPixel = 0.004;  // body lengths; and in v
const float kPixelV = 0.03;
const vec3 kMirrored = vec3(0.42, 0.46, 0.48);  // what the guanine of a fish in grey surroundings shows

vec3 shownBy(Skin skin) { return mix(skin.albedo, kMirrored * (0.6 + skin.albedo), 0.6 * skin.silver); }

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(places.length())) return;
    vec4 rest = places[i].rest;
    vec4 fin = places[i].fin;
    uint part = uint(fin.z);
    SkinPoint at = SkinPoint(rest.x, rest.y, rest.z, rest.w, kPixel, kPixelV, 0u, 0.0, part == kBody ? fin.y : 0.0,
                             0.02 * (kLips - fin.y), 0.0);
    Skin skin = groundOf(at);
    if (part == kBody || part == kEye) {
        addDetails(skin, at);
        paintLips(skin, at);
        paintInside(skin, at);
        paintEye(skin, at, kIris, 0.5, vec3(0.0, 0.0, 1.0), vec2(0.0));
        colours[i] = vec4(shownBy(skin), 1.0);
        return;
    }
    Fin made = finOf(FinPoint(part, fin.x, fin.y, 0.0, at), skin);
    float grown = smoothstep(0.0, 0.15, fin.y);
    colours[i] = vec4(mix(shownBy(skin), made.albedo, grown), mix(1.0, made.opacity, grown));
}
