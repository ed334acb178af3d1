// The plan of a view's lists: where each begins, which fish each page of surfaces holds, and the
// commands that draw them. A page is a storage block of its own. FishPlan of render_node/surface/fish_tables.h.
#ifndef FISH_PLAN_GLSL
#define FISH_PLAN_GLSL
#include "shader_interface.h"
#include "fish_lists.glsl"


struct Command {  // as glDrawElementsIndirect takes it
    uint count, instances, firstIndex, firstVertex, firstInstance;
};
// Fish of one list that a page holds: places in the school, and in the page.
struct Piece {
    uint firstFish, fish, firstVertex;
};
const uint kPieces = kMostPages * kMostSpecies * kSurfaces;  // [page][species][surface]
const uint kCommands = 2u * kPieces + kMostSpecies * kTails;

// All arrays are of plain numbers: of an array of structures a driver keeps a record for each
// member of each element, which costs software OpenGL seconds a program.
layout(std430, binding = kPlanStorage) buffer Plan {
    uint totals[kMostSpecies * kDetailStride];  // fish, [species][list]
    uint firsts[kMostSpecies * kDetailStride];  // the place of each list's first
    uint pages[kMostPages * 4u];                // see groupsOf(), firstFishOf()
    uint pieces[kPieces * 3u];
    uint commands[2u * kCommands * 5u];  // see setCommand(); of fish in their own skins, then in drawings
};

// Of a page, in `pages`: workgroups (x; then y and z) that evaluate it; its first fish.
uint groupsOf(uint page) { return page * 4u; }
uint firstFishOf(uint page) { return page * 4u + 3u; }

Piece pieceAt(uint at) {
    return Piece(pieces[at * 3u], pieces[at * 3u + 1u], pieces[at * 3u + 2u]);
}
void setPiece(uint at, Piece piece) {
    pieces[at * 3u] = piece.firstFish;
    pieces[at * 3u + 1u] = piece.fish;
    pieces[at * 3u + 2u] = piece.firstVertex;
}

// Commands: of the bodies of each piece, of its fins, and of each species those that need no
// surface: bodies of few triangles, of its own list and of each surface's for which there was no
// room; the same of fins; points.
const uint kFirstFins = kPieces, kFirstTails = 2u * kPieces;
void setCommand(uint at, Command command) {
    commands[at * 5u] = command.count;
    commands[at * 5u + 1u] = command.instances;
    commands[at * 5u + 2u] = command.firstIndex;
    commands[at * 5u + 3u] = command.firstVertex;
    commands[at * 5u + 4u] = command.firstInstance;
}
void drawNothing(uint at) { commands[at * 5u + 1u] = 0u; }
#endif
