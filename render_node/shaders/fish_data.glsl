// A fish that a view draws, as fish_scatter.comp makes it from the records.
#ifndef FISH_DATA_GLSL
#define FISH_DATA_GLSL

// DrawnFish of render_node/surface/school_surface.h, 96 bytes; its first 48 and the actions are
// those of PresentedFish (common/motion/reconstruct.h).
struct Fish {
    vec3 positionMetres;
    float lengthMetres;
    vec4 rotation;  // quaternion, body to world
    float phase;    // cycles
    float fromPhase;
    float warpWeight;  // share of `action` against `fromAction`
    uint action;
    uint fromAction;
    uint id;
    uint species;  // its place in the cast
    // Low half: DetailLevel of render_node/surface/visibility.h. High half: 1 + the layer of the drawing that it
    // wears, or 0.
    uint detailAndDrawing;
    float blend;   // how far it has changed from the next coarser level: 0 looks like that level
    uint firstVertex;  // in the surface buffer, less the first vertex of its mesh
    float speed;  // body lengths a second
    float spread;  // of the pectoral fins, 0 to 1
    vec3 gaze;     // where it looks: body frame, no longer than 1
    float mouth;   // how far it is open by its record, 0 to 1
};

uint detailOf(Fish self) { return self.detailAndDrawing & 65535u; }
uint layerOf(Fish self) { return (self.detailAndDrawing >> 16) - 1u; }  // where it wears one

// Rotates a vector by a unit quaternion.
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
