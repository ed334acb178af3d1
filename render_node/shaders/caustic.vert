// A grid over the surface, moved to where the refracted sunlight meets one depth, less the mean shift.
// So the tile is indexed by the place where the straight ray meets the surface. In: the vertex number,
// (cells + 1)^2 vertices; the wave tile; receiverMetres, the depth of the layer. Out: place on the tile
// in clip space, and the place before refraction, metres.
#include "shader_interface.h"
#include "frame_uniforms.h"
layout(binding = kWaveTileUnit) uniform sampler2D waveTile;
layout(location = kReceiverMetresLocation) uniform float receiverMetres;
layout(location = kCellsLocation) uniform int cells;
layout(location = 0) out vec2 before;
const float kMargin = 0.12;  // of the tile: light that comes in over the edge
// Refractive index of sea water.
const float kIndex = 1.335;
void main() {
    ivec2 corner = ivec2(gl_VertexID % (cells + 1), gl_VertexID / (cells + 1));
    vec2 place = (vec2(corner) / float(cells) * (1.0 + 2.0 * kMargin) - kMargin) * kTileMetres;
    vec3 wave = textureLod(waveTile, place / kTileMetres, 0.0).xyz;
    vec3 normal = normalize(vec3(-wave.x, 1.0, -wave.y));
    vec3 sun = sunAndFilterDepth.xyz;
    vec2 across = sun.xz * kIndex;  // of the sun in the air
    vec3 sunInAir = vec3(across.x, sqrt(max(1.0 - dot(across, across), 0.05)), across.y);
    vec3 ray = refract(-sunInAir, normal, 1.0 / kIndex);
    vec2 hit = place + ray.xz / max(-ray.y, 0.1) * (receiverMetres + wave.z) +
               sun.xz / sun.y * receiverMetres;
    before = place;
    gl_Position = vec4(hit / kTileMetres * 2.0 - 1.0, 0.0, 1.0);
}
