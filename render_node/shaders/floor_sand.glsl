// What the sand is made of at a place: ripples and grains; rubble about the foot of the reefs.
// In: world place; tiles of detail, map of shade. Out: albedo, slope, and how open it is to the sun and the sky.
layout(binding = kDetailTileUnit) uniform sampler2D detail;  // slopes, albedo, crest
layout(binding = kFloorShadeUnit) uniform sampler2D shade;   // sun visibility and ambient occlusion, rubble
layout(binding = kFloorRockUnit) uniform sampler2D rock;    // as `detail`
const float kRubbleTile = 1.3;
#include "sand_colour.glsl"
struct Sand {
    vec3 albedo;
    vec2 slope;
    Occlusion open;
    float ambient;  // of the map alone
};
Sand sandAt(vec3 place) {
    vec4 fine = texture(detail, place.xz / kSandTileMetres);
    // A second sample, larger and rotated, hides the repetition of the tile.
    vec2 turned = vec2(place.x * 0.83 - place.z * 0.56, place.x * 0.56 + place.z * 0.83);
    vec4 coarse = texture(detail, turned / (kSandTileMetres * 5.3));
    vec3 open = texture(shade, place.xz / kFloorShadeMetres + 0.5).rgb;
    vec2 slope = 2.4 * (fine.xy - 0.5) + 0.6 * (coarse.xy - 0.5);
    // Where the swell is slack the sand is finer, paler and without ripples.
    float slack = smoothstep(0.35, 0.75, coarse.w);
    slope *= mix(1.0, 0.55, slack);
    vec3 albedo = kSand * (2.0 * fine.z) * (0.60 + 0.8 * coarse.z) * mix(0.92, 1.06, slack);
    float sky = open.g * (0.70 + 0.35 * fine.w);
    float rubble = open.b;
    if (rubble > 0.02) {
        vec4 stones = texture(rock, place.xz / kRubbleTile);
        // Broken branches, bleached, some with a crust: they lie on the sand in heaps.
        float lies = smoothstep(0.62, 0.80, rubble + 0.55 * (stones.w - 0.35));
        vec3 bone = mix(vec3(0.22, 0.17, 0.13), vec3(0.60, 0.50, 0.38), stones.w) * (1.4 * stones.z);
        bone = mix(bone, vec3(0.46, 0.24, 0.25) * (1.6 * stones.z), smoothstep(0.55, 0.85, coarse.z) * 0.7);
        albedo = mix(albedo * mix(1.0, 0.8, rubble), bone, lies);
        slope = mix(slope, 1.3 * (stones.xy - 0.5), lies);
        sky *= mix(1.0, 0.35 + 0.8 * stones.w, lies);
    }
    return Sand(albedo, slope, Occlusion(open.r, sky), open.g);
}
