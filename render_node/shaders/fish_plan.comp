// Makes the commands that draw the fish, from the number of fish in each list. One thread: a few
// hundred steps, whatever the number of fish. In: totals of each list, cast. Out: firsts, pages,
// pieces, commands (fish_plan.glsl).
#include "shader_interface.h"
#include "fish_detail.glsl"
#include "fish_plan.glsl"

layout(local_size_x = 1) in;
layout(location = kSpeciesCountLocation) uniform uint speciesCount;
layout(location = kPageCountLocation) uniform uint pageCount;
layout(location = kRoomVerticesLocation) uniform uint roomVertices;  // of a page

const uint kPointIndices = 12u;

uint page = 0u, usedVertices = 0u;

Command bodyOf(Mesh mesh, uint fish, uint first) {
    return Command(mesh.bodyIndices, fish, mesh.firstBodyIndex, mesh.firstVertex, first);
}
Command finsOf(Mesh mesh, uint fish, uint first) {
    return Command(mesh.finIndices, fish, mesh.firstFinIndex, mesh.firstVertex, first);
}

void clear() {
    for (uint p = 0u; p < pageCount; ++p) {
        pages[groupsOf(p)] = pages[firstFishOf(p)] = 0u;
        pages[groupsOf(p) + 1u] = pages[groupsOf(p) + 2u] = 1u;
        for (uint k = 0u; k < speciesCount * kSurfaces; ++k) {
            uint at = p * kMostSpecies * kSurfaces + k;
            setPiece(at, Piece(0u, 0u, 0u));
            for (uint worn = 0u; worn < 2u; ++worn) {
                drawNothing(worn * kCommands + at);
                drawNothing(worn * kCommands + kFirstFins + at);
            }
        }
    }
}

// Commands for fish of a list, the first of which wear their own skins, and the others drawings: of bodies
// at `bodies`, of fins at `fins`.
void setCommands(uint bodies, uint fins, Mesh mesh, uint own, uint fish, uint first) {
    setCommand(bodies, bodyOf(mesh, own, first));
    setCommand(fins, finsOf(mesh, own, first));
    setCommand(kCommands + bodies, bodyOf(mesh, fish - own, first + own));
    setCommand(kCommands + fins, finsOf(mesh, fish - own, first + own));
}

// Gives a list of surfaces room in this page and the next ones; fish that do not fit in the last page
// are drawn as few triangles. own: how many of the fish, the first ones, wear their own skins.
void place(uint species, uint surface, uint first, uint own, uint fish) {
    Mesh mesh = kinds[species].meshes[1u + surface];
    uint placed = 0u;
    while (placed < fish && page < pageCount) {
        uint now = min(fish - placed, (roomVertices - usedVertices) / mesh.vertexCount);
        if (now > 0u) {
            uint at = (page * kMostSpecies + species) * kSurfaces + surface;
            setPiece(at, Piece(first + placed, now, usedVertices));
            setCommands(at, kFirstFins + at, mesh, min(max(own, placed) - placed, now), now, first + placed);
            if (pages[groupsOf(page)] == 0u) pages[firstFishOf(page)] = first + placed;
            pages[groupsOf(page)] += now;
            usedVertices += now * mesh.vertexCount;
            placed += now;
        }
        if (placed < fish) {
            ++page;
            usedVertices = 0u;
        }
    }
    uint at = kFirstTails + species * kTails + 1u + surface;
    setCommands(at, at + 1u + kSurfaces, kinds[species].meshes[0], max(own, placed) - placed, fish - placed,
                first + placed);
}

// Few triangles, those that fade, points: one behind the other, and those that fade are drawn as
// both. worn: 0 in their own skins, 1 in drawings.
uint placeTail(uint species, uint worn, uint first) {
    uint list = species * kDetailStride + worn * kDrawnLists;
    uint few = totals[list + kFewTriangles], fading = totals[list + kFading];
    firsts[list + kFewTriangles] = first;
    firsts[list + kFading] = first + few;
    firsts[list + kPoint] = first + few + fading;
    Mesh mesh = kinds[species].meshes[0];
    uint tail = worn * kCommands + kFirstTails + species * kTails;
    setCommand(tail, bodyOf(mesh, few + fading, first));
    setCommand(tail + 1u + kSurfaces, finsOf(mesh, few + fading, first));
    setCommand(tail + 2u + 2u * kSurfaces,
               Command(kPointIndices, fading + totals[list + kPoint], 0u, 0u, first + few));
    return first + few + fading + totals[list + kPoint];
}

void main() {
    clear();
    uint first = 0u;
    for (uint surface = kSurfaces; surface-- > 0u;) {
        for (uint species = 0u; species < speciesCount; ++species) {
            uint list = species * kDetailStride + kControlMesh + surface;
            uint own = totals[list], fish = own + totals[list + kDrawnLists];
            firsts[list] = first;
            firsts[list + kDrawnLists] = first + own;
            place(species, surface, first, own, fish);
            first += fish;
        }
    }
    for (uint species = 0u; species < speciesCount; ++species)
        for (uint worn = 0u; worn < 2u; ++worn) first = placeTail(species, worn, first);
}
