// The surface from below: Snell's window where a facet lets light in, else the mirrored sea and reef.
// In: world place on the plane y = 0. Out: scene radiance, opaque.
#include "shader_interface.h"
#include "shading.glsl"
#include "sky.glsl"
layout(binding = kWaveTileUnit) uniform sampler2D waveTile;    // slopes, height, squared slope
layout(binding = kRippleTileUnit) uniform sampler2D rippleTile;  // the same
layout(location = 0) in vec3 place;
layout(location = 0) out vec4 radiance;
const float kBrightening = kIndex * kIndex;  // a beam narrows as it enters the water
const float kCritical = 0.66566;             // cosine of the angle of total reflection
// Caustics want waves less steep than the sea's: seen from below they are as steep.
const float kSteeper = 1.5;

struct Facets {
    vec2 slope;
    float variance;  // of the slopes that a pixel cannot show, along one axis
};

// Mip level for a footprint of so many texels; whole levels where quality is not fine, as they cost
// less.
float levelOf(float texels) {
    float level = log2(max(texels, 1.0));
    return kFine ? level : round(level);
}

// Slope of the surface at a place, and the variance of what is finer than the footprint (metres).
Facets facetsAt(vec2 xz, float footprint) {
    vec4 wave = textureLod(waveTile, xz / kTileMetres, levelOf(footprint * surfaceDetail.z));
    // Turned, so that the two tiles never meet in step.
    const mat2 turn = mat2(0.83, 0.558, -0.558, 0.83);
    vec4 ripple = textureLod(rippleTile, (turn * xz) / kRippleTileMetres,
                             levelOf(footprint * surfaceDetail.w));
    vec2 slope = kSteeper * wave.xy + ripple.xy * turn;
    float lost = kSteeper * kSteeper * max(wave.w - dot(wave.xy, wave.xy), 0.0) +
                 max(ripple.w - dot(ripple.xy, ripple.xy), 0.0);
    for (int i = 0; i < (kFine ? 4 : 1); ++i) {
        vec4 wide = longWaves[i];
        slope += wide.z * wide.xy * cos(dot(wide.xy, xz) + wide.w);
    }
    return Facets(slope, 0.5 * lost);
}

// Reflectance for unpolarised light from below; inward: cosine in the water.
float fresnel(float inward) {
    float outward = sqrt(max(1.0 - kIndex * kIndex * (1.0 - inward * inward), 0.0));
    float s = (kIndex * inward - outward) / (kIndex * inward + outward);
    float p = (kIndex * outward - inward) / (kIndex * outward + inward);
    return 0.5 * (s * s + p * p);
}

// What a stretch of the surface shows: light from above; of the mirrored sea floor, as it reaches the eye, and of the
// mirrored water, as it is at the mirror.
struct Stretch {
    vec3 above, floor, water;
};

// The sea floor, where a ray down from this place of the surface meets it: world metres.
vec3 floorBelow(vec3 down, vec2 xz) {
    float depth = 8.0;
    vec2 hit = xz;
    for (int i = 0; i < 2; ++i) {
        hit = xz + down.xz * (depth / max(-down.y, 0.05));
        depth = -textureLod(topHeights, hit / kPlaceMetres + 0.5, placeLod(0.6)).x;
    }
    return vec3(hit.x, -depth, hit.y);
}

// Sand in the light from above. A mirror of waves shows neither the colours of the caustics nor the lamp's light.
vec3 mirroredSand(vec3 bottom) {
    float share = unscatteredShare(max(-bottom.y, 0.1));
    vec3 sun = caustic(bottom, 2.0) * share * sunPast(bottom) * sunAndFilterDepth.y * sunlight.rgb;
    return vec3(0.30, 0.27, 0.22) * (sun + (1.0 - share) * skylight.rgb) / kPi;
}

void mirror(inout Stretch it, float share, vec3 down, vec2 xz, float range) {
    vec3 water = openWater(down, sunAndFilterDepth.w);
    if (!kFine) {
        it.water = 0.8 * share * water;
        return;
    }
    vec3 bottom = floorBelow(down, xz);
    float further = -bottom.y / max(-down.y, 0.05);
    it.floor = share * direct(mirroredSand(bottom), range + further, -bottom.y);
    it.water = share * (0.8 - 0.8 * exp(-0.11 * further)) * water;
}

Stretch stretchAt(vec3 w, vec2 xz, float range, float footprint) {
    Facets facets = facetsAt(xz, footprint);
    vec3 normal = normalize(vec3(-facets.slope.x, 1.0, -facets.slope.y));
    float inward = max(dot(w, normal), 0.02);
    // Only facets within the critical angle let light in.
    float width = sqrt(facets.variance * max(1.0 - inward * inward, 0.0)) + 0.001;
    float open = smoothstep(-1.8, 1.8, (inward - kCritical) / width);
    float within = max(inward, kCritical + 0.4 * width);
    float enters = open * (1.0 - fresnel(within));
    vec3 across = w - inward * normal;
    vec3 level = across * inversesqrt(max(dot(across, across), 1.0e-6));
    float sine = min(kIndex * sqrt(max(1.0 - within * within, 0.0)), 1.0);
    vec3 outward = level * sine + normal * sqrt(1.0 - sine * sine);
    Stretch it;
    it.above = sky(vec3(outward.x, abs(outward.y), outward.z), 0.4 * facets.variance) *
               (kBrightening * enters);
    it.floor = vec3(0.0);
    vec3 down = reflect(w, -normal);
    mirror(it, 1.0 - enters, normalize(vec3(down.x, -max(abs(down.y), 0.03), down.z)), xz, range);
    return it;
}

// The mirrored water is already coloured: it is taken at a depth where the filter has no effect, and not graded. The
// filter undoes an absorption that the light from above has not had, so that in finer tiers most of it is left out.
vec3 seenOf(Stretch it, float range) {
    float depth = sunAndFilterDepth.w;
    vec3 water = ungraded(it.water, range, depth);
    if (!kFine) return direct(it.above + water, range, depth);
    return direct(it.above, range, 0.75 * depth) + it.floor + direct(water, range, depth);
}

void main() {
    vec3 way = place - eyeAndTime.xyz;
    float range = length(way);
    vec3 w = way / range;
    // A pixel covers a long strip of the surface: one tap for each stretch of it.
    float across = range * sharedEyeAndPixel.w;
    float along = across / max(w.y, 0.02);
    int taps = int(clamp(round(along / across), 1.0, surfaceDetail.x));
    vec2 step = along / float(taps) * normalize(w.xz + 1.0e-5);
    float footprint = 1.6 * sqrt(across * along / float(taps));
    Stretch sum = Stretch(vec3(0.0), vec3(0.0), vec3(0.0));
    for (int i = 0; i < taps; ++i) {
        vec2 xz = place.xz + step * (float(i) - 0.5 * float(taps - 1));
        Stretch one = stretchAt(w, xz, range, footprint);
        sum.above += one.above;
        sum.floor += one.floor;
        sum.water += one.water;
    }
    float share = 1.0 / float(taps);
    vec3 light = seenOf(Stretch(share * sum.above, share * sum.floor, share * sum.water), range);
    // The same distance as that of open water (water.frag); otherwise a line would be visible at the
    // end.
    radiance = vec4(light + inscatter(w, min(range, 80.0)), 1.0);
}
