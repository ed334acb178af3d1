// A fish of about one pixel: a sprite of four triangles, opaque in the middle and clear at its rim,
// with the area of the fish. The skin is spread over it, so that a pixel shows a mean of the flank's
// colours. It is lit as the flank is, so that it flashes when the fish turns. In: five corners for each
// fish. Out: as fish.vert. The size follows the shared eye, not the view's own, so that neighbours
// agree.
#include "frame_uniforms.h"
#include "fish_coarse.glsl"
#include "fish_school.glsl"
#include "fish_lists.glsl"

layout(location = 3) in uint slot;  // of the instance: its place in the school

const vec2 kCorners[5] =
    vec2[](vec2(0.0), vec2(-1.0, -1.0), vec2(1.0, -1.0), vec2(1.0, 1.0), vec2(-1.0, 1.0));

// Square metres that an ellipsoid covers, seen from this direction of its body frame.
float areaSeen(Fish self, vec3 direction) {
    vec3 shares = kinds[self.species].area.xyz * direction;
    return length(shares) * self.lengthMetres * self.lengthMetres;
}

void main() {
    Fish self = fish[slot];
    vec3 anterior = rotate(self.rotation, vec3(1.0, 0.0, 0.0));
    vec3 right = rotate(self.rotation, vec3(0.0, 0.0, 1.0));
    dorsal = rotate(self.rotation, vec3(0.0, 1.0, 0.0));
    vec3 middle = self.positionMetres +
                  rotate(self.rotation, kinds[self.species].middle.xyz * self.lengthMetres);
    vec3 toEye = sharedEyeAndPixel.xyz - middle;
    float pixel = length(toEye) * sharedEyeAndPixel.w;
    toEye = normalize(toEye);

    // Across the line of sight: along the body, and across it, upwards.
    vec3 along = anterior - dot(anterior, toEye) * toEye;
    float halfLength = 0.5 * length(along) * self.lengthMetres;
    vec3 u = normalize(along + 1.0e-4 * dorsal);
    vec3 v = cross(toEye, u);
    if (dot(v, dorsal) < 0.0) v = -v;

    // An ellipse as large as the fish appears, blurred by a pixel.
    float area = areaSeen(self, vec3(dot(toEye, anterior), dot(toEye, dorsal), dot(toEye, right)));
    float a = max(halfLength, sqrt(area / 3.1415927));
    float b = area / (3.1415927 * a);
    vec2 halfSize = sqrt(1.5 * vec2(a * a, b * b) + pixel * pixel);
    vec2 corner = kCorners[gl_VertexID];
    place = middle + u * (corner.x * halfSize.x) + v * (corner.y * halfSize.y);

    // The four triangles hold a third of the box about them. Under a fish that fades in, the point
    // goes late.
    float peak = min(area / (1.3333333 * halfSize.x * halfSize.y), 1.0);
    opacity = gl_VertexID == 0 ? peak * (1.0 - self.blend * self.blend) : 0.0;

    float side = dot(toEye, right);
    normal = normalize(side * right + 0.35 * toEye + 0.5 * corner.y * dorsal);
    rest = vec4(0.47 - 0.45 * corner.x, 0.1 * corner.y, 0.03 * sign(side), 0.9 * corner.y);
    fin = vec2(0.0);
    part = 0u;
    id = self.id;
    size = self.lengthMetres;
    drawing = layerOf(self);
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
