// SPDX-License-Identifier: Apache-2.0
#include "common/body/fish_body.h"

#include <algorithm>
#include <string_view>

#include "common/body/cage.h"
#include "common/body/fins.h"
#include "common/config/species.h"

namespace aquarama::body {

namespace {

// The colour of a part in the palette of the species, linear Rec. 709; `otherwise` where the
// palette has none.
glm::vec3 colourOf(const config::Species& species,
                   std::string_view part,
                   const glm::vec3& otherwise) {
    const auto paint = std::ranges::find(species.palette, part, &config::Paint::part);
    return paint == species.palette.end() ? otherwise : paint->linear;
}

FishFace faceOf(const config::Species& species) {
    const config::Mouth& mouth = species.mouth;
    return {.eye = {species.eye.s, species.eye.y, species.eye.radius},
            .front = mouth.front,
            .corner = mouth.corner,
            .lip = mouth.lip,
            .teeth = static_cast<float>(mouth.teeth),
            .gill = {species.gill.s, species.gill.bow}};
}

// The nodal points of the skeleton at rest, in the order of NodalPoints; body frame.
NodalPoints restNodesOf(const config::Skeleton& skeleton) {
    NodalPoints nodes{};
    std::size_t next = 1;
    for (const config::SkeletonRing& ring : skeleton.rings) {
        const auto x = static_cast<float>(-ring.s);
        const auto y = static_cast<float>(ring.halfHeight);
        const auto z = static_cast<float>(ring.halfWidth);
        nodes.at(next++) = {x, y, -z};
        nodes.at(next++) = {x, y, z};
        nodes.at(next++) = {x, -y, z};
        nodes.at(next++) = {x, -y, -z};
    }
    const auto span = static_cast<float>(skeleton.tailHalfSpan);
    nodes[21] = {-1, span, 0};
    nodes[22] = {-1, -span, 0};
    return nodes;
}

// The common topology with the positions of this species.
ControlCage makeCage(const config::Species& species) {
    CageTopology topology = makeCageTopology();
    const CageShape shape(species);
    ControlCage cage;
    for (const CageSite& site : topology.sites) cage.vertices.push_back(shape.place(site));
    cage.faces = std::move(topology.faces);
    cage.creases = std::move(topology.creases);
    return cage;
}

}  // namespace

FishSkin skinOf(const config::Species& species) {
    return {.species = species.name,
            .back = colourOf(species, "back", {0.05F, 0.08F, 0.10F}),
            .flank = colourOf(species, "flank", {0.40F, 0.42F, 0.40F}),
            .belly = colourOf(species, "belly", {0.70F, 0.70F, 0.68F}),
            .face = faceOf(species)};
}

FishBody makeBody(const config::Species& species) {
    FishBody body;
    body.species = species.name;
    body.typicalLengthMetres = species.size.meanMetres;
    body.restNodes = restNodesOf(species.skeleton);
    for (std::size_t r = 0; r < 5; ++r)
        body.ringStations.at(r) = static_cast<float>(species.skeleton.rings.at(r).s);
    body.profileStations = species.profile.stations;
    body.profileDorsal = species.profile.dorsal;
    body.profileVentral = species.profile.ventral;
    body.profileHalfWidth = species.profile.halfWidth;
    body.face = faceOf(species);
    body.eyeBulge = species.eye.bulge;
    for (const config::Thread& thread : species.threads)
        body.threads.push_back(
            {thread.at, thread.rootWidth, thread.tipWidth, thread.isOfFirstDorsal});
    body.cage = makeCage(species);
    body.fins = makeFinTable(species, body.cage);
    return body;
}

}  // namespace aquarama::body
