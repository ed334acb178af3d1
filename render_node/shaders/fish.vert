// A vertex of the surface that fish.comp has made, with its place on the skin.
// In: the surface buffer (world), place on the skin, slot. Out: what the fragment shaders of fish
// take; clip space.
#include "shader_interface.h"
#include "frame_uniforms.h"
#include "fish_face.glsl"
#include "fish_school.glsl"

layout(std430, binding = kSurfaceStorage) readonly buffer Surface { uvec4 surface[]; };
layout(location = 0) in vec4 vertexRest;
layout(location = 1) in vec2 vertexFin;
layout(location = 2) in uint vertexPart;
layout(location = 3) in uint slot;  // of the instance: its place in the school
layout(location = 4) in vec4 coarserRest;  // the place on the skin where the coarser level has it
layout(location = 5) in vec2 coarserFin;

layout(location = 0) out vec3 place;   // world, metres
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 rest;    // s, y, z in body lengths; height v, -1 belly .. +1 back
layout(location = 3) out vec2 fin;     // p along its base, q from base to edge
layout(location = 4) flat out uint part;
layout(location = 5) flat out uint id;
layout(location = 6) flat out vec3 dorsal;  // the fish's own up, in the world
layout(location = 7) out float opacity;     // 1, or less where a level of detail fades
layout(location = 8) flat out float nearness;  // of the skin's details, which come with the mesh
layout(location = 9) flat out float size;      // of the fish, metres
layout(location = 10) flat out vec4 face;      // gaze in the body frame; how far the gill cover is lifted
layout(location = 11) flat out uint drawing;   // layer of the drawing that it wears

void main() {
    uvec4 vertex = surface[fish[slot].firstVertex + uint(gl_VertexID)];
    place = uintBitsToFloat(vertex.xyz);
    normal = unpackNormal(vertex.w);
    rest = mix(coarserRest, vertexRest, fish[slot].blend);
    fin = mix(coarserFin, vertexFin, fish[slot].blend);
    part = vertexPart;
    id = fish[slot].id;
    size = fish[slot].lengthMetres;
    face = vec4(fish[slot].gaze, facePose(fish[slot], eyeAndTime.w).gill);
    dorsal = rotate(fish[slot].rotation, vec3(0.0, 1.0, 0.0));
    // Few triangles have no paired fins.
    bool grows = detailOf(fish[slot]) == kControlMesh && (vertexPart == kPelvic || vertexPart == kPectoral);
    opacity = grows ? fish[slot].blend : 1.0;
    nearness = detailOf(fish[slot]) == kMesh ? fish[slot].blend : 1.0;
    drawing = layerOf(fish[slot]);
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
