// A corner of a fish of few triangles: a control point, which is posed here, as a separate kernel would
// not pay. In: control point, normal at rest (body frame), place on the skin. Out: as fish.vert, in
// world metres and clip space.
#include "frame_uniforms.h"
#include "fish_coarse.glsl"
#include "fish_pose.glsl"

layout(location = 0) in vec4 vertexRest;
layout(location = 1) in vec2 vertexFin;
layout(location = 2) in uint vertexPart;
layout(location = 3) in uint slot;  // of the instance: its place in the school
layout(location = 4) in uint controlPoint;
layout(location = 5) in vec3 restNormal;

void main() {
    Fish self = fish[slot];
    vec3 point = controlPointOf(self, livingOf(self), controlPoint);
    place = self.positionMetres + rotate(self.rotation, point * self.lengthMetres);
    normal = rotate(self.rotation, restNormal);
    rest = vertexRest;
    fin = vertexFin;
    part = vertexPart;
    id = self.id;
    size = self.lengthMetres;
    dorsal = rotate(self.rotation, vec3(0.0, 1.0, 0.0));
    opacity = self.blend;
    drawing = layerOf(self);
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
