// Which drawing of a visitor lies in which layer of the drawn skins: the table of DrawnSkins
// (render_node/surface/drawn_skins.h). In: a number of a record. Out: 1 + its layer, or 0.
#ifndef DRAWN_LAYERS_GLSL
#define DRAWN_LAYERS_GLSL
#include "shader_interface.h"

layout(std140, binding = kDrawnLayersBlock) uniform DrawnLayers {
    uvec4 drawnNumbers[kMostDrawn / 4u];  // by layer; 0: it is free
    uint drawnLayers;
};

// 0: the number is 0, or its drawing is not there.
uint layerOf(uint number) {
    for (uint layer = 0u; number != 0u && layer < drawnLayers; ++layer)
        if (drawnNumbers[layer >> 2u][layer & 3u] == number) return layer + 1u;
    return 0u;
}
#endif
