// A fish as the node receives it, and what the compute shader makes of it.
#ifndef FISH_DATA_GLSL
#define FISH_DATA_GLSL

// PresentedFish of common/motion/reconstruct.h, 64 bytes.
struct Fish {
    vec3 positionMetres;
    float lengthMetres;
    vec4 rotation;  // quaternion, body to world
    float phase;    // cycles
    float fromPhase;
    float warpWeight;  // share of `segment` against `fromSegment`
    uint segment;
    uint fromSegment;
    uint id;
    float speed;  // body lengths a second
    uint padding;
};
layout(std430, binding = 0) readonly buffer School { Fish fish[]; };

vec3 rotate(vec4 rotation, vec3 v) {
    return v + 2.0 * cross(rotation.xyz, cross(rotation.xyz, v) + rotation.w * v);
}

// Unit vectors in ten bits a component, so that a vertex is 16 bytes.
uint packNormal(vec3 normal) {
    uvec3 bits = uvec3(ivec3(round(normal * 511.0))) & 1023u;
    return bits.x | (bits.y << 10) | (bits.z << 20);
}
vec3 unpackNormal(uint bits) {
    ivec3 signedBits = ivec3(bits << 22, bits << 12, bits << 2) >> 22;
    return vec3(signedBits) / 511.0;
}
#endif
