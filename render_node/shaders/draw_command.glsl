// A draw, as glMultiDrawElementsIndirect reads it.
#ifndef DRAW_COMMAND_GLSL
#define DRAW_COMMAND_GLSL
struct Command {
    uint count, instanceCount, firstIndex;
    int baseVertex;
    uint baseInstance;
};
#endif
