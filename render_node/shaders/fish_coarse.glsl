// What the coarser levels of fish give to their fragment shaders: as fish.vert, without what is seen from near alone.
#ifndef FISH_COARSE_GLSL
#define FISH_COARSE_GLSL
layout(location = 0) out vec3 place;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 rest;
layout(location = 3) out vec2 fin;
layout(location = 4) flat out uint part;
layout(location = 5) flat out uint id;
layout(location = 6) flat out vec3 dorsal;
layout(location = 7) out float opacity;
layout(location = 9) flat out float size;
layout(location = 11) flat out uint drawing;
#endif
