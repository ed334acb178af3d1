// Slopes, height and squared slope of the surface on one tile: of the waves or of the ripples.
// In: uv over the tile; SeaNow. Out: slopes along x and z, height in metres, squared slope.
#include "shader_interface.h"
#include "sea_now.glsl"
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 slopesHeightSquare;
layout(location = kTileMetresLocation) uniform float tileMetres;
layout(location = kDrawsRipplesLocation) uniform bool drawsRipples;
layout(location = kTexelMetresLocation) uniform float texelMetres;
// Each texel sums 32 sines: slope and height of those that texels can hold.
void main() {
    vec3 sum = vec3(0.0);
    float lost = 0.0;
    for (int i = 0; i < 32; ++i) {
        vec4 wave = drawsRipples ? ripples[i] : waves[i];
        // A wave that is too fine for the texels only adds to the roughness of the surface.
        float k = length(wave.xy);
        float kept = 1.0 - smoothstep(1.4, 2.4, k * texelMetres);
        float angle = dot(wave.xy, uv * tileMetres) + wave.w;
        sum += kept * wave.z * vec3(wave.xy * cos(angle), sin(angle));
        lost += 0.5 * (1.0 - kept * kept) * k * k * wave.z * wave.z;
    }
    slopesHeightSquare = vec4(sum, dot(sum.xy, sum.xy) + lost);
}
