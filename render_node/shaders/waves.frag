// Slopes and height of the surface on one tile.
#include "sea_now.glsl"
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 slopesAndHeight;
void main() {
    vec2 place = uv * 12.0;  // kTileMetres
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 32; ++i) {
        vec4 wave = waves[i];
        float angle = dot(wave.xy, place) + wave.w;
        sum += wave.z * vec3(wave.xy * cos(angle), sin(angle));
    }
    slopesAndHeight = vec4(sum, 0.0);
}
