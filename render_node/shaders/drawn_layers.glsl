// Which drawing of a visitor lies in which layer of the drawn skins: the table of DrawnSkins
// (render_node/surface/drawn_skins.h). In: records, and species that may wear drawings. Out: 1 + a layer, or 0.
#ifndef DRAWN_LAYERS_GLSL
#define DRAWN_LAYERS_GLSL
#include "shader_interface.h"
#include "fish_record.glsl"

layout(std140, binding = kDrawnLayersBlock) uniform DrawnLayers {
    uvec4 drawnNumbers[kMostDrawn / 4u];  // by layer; 0: it is free
    uint drawnLayers;
};

layout(location = kDrawnSpeciesLocation) uniform uvec2 drawnSpecies;  // a bit each

// Of the drawing that a fish wears; 0: it wears none, or its drawing is not there.
uint drawingOf(uint i, uint species) {
    bool mayWear = (drawnSpecies[species >> 5] >> (species & 31u) & 1u) != 0u;
    uint number = mayWear ? skinOf(i) : 0u;
    for (uint layer = 0u; number != 0u && layer < drawnLayers; ++layer)
        if (drawnNumbers[layer >> 2u][layer & 3u] == number) return layer + 1u;
    return 0u;
}
#endif
