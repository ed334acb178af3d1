// SPDX-License-Identifier: Apache-2.0
// How the 426 vertices of every fish's control cage are connected: one closed all-quad surface, the
// same for all species, so that tables made for one species' mesh serve every other.
//
// A tube of 26 rings of 12 columns runs from head to tail: ring 0 is the loop of the lips, rings
// 1-20 are the body, 21 its end, 21-25 the tail fin, which is the tube drawn flat. Columns 0 | 1
// straddle the back, 2-5 go down the right side, 6 | 7 straddle the belly, 8-11 come up the left. A
// 3 x 3 grid of quads within the lips is the inside of the mouth (mouth.h), 5 quads close the tail.
// The other fins are strips of tube faces, raised by one or two levels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/body/fins.h"
#include "common/body/fish_body.h"
#include "common/body/mouth.h"
#include "common/body/sections.h"
#include "common/config/species.h"

namespace aquarama::body {

// Size of the tube: rings are numbered from nose to tail, columns as above.
inline constexpr int kTubeRings = 26;
inline constexpr int kTubeColumns = 12;
// The last ring of the body; rings behind it belong to the tail fin.
inline constexpr int kBodyEndRing = 21;

// Which part of the construction made a vertex: the tube, the grid inside the mouth, or a raised
// fin (flap).
enum class CageSiteKind : std::uint8_t { Tube, Mouth, Flap };

// The address of a vertex in the cage. The fields tell what the vertex is for, not where it is in
// space: CageShape::place() does that.
struct CageSite {
    CageSiteKind kind = CageSiteKind::Tube;
    CagePart part = CagePart::Body;
    // Ring and column of the tube vertex that it is, or that it was raised from. For the mouth: row
    // and column of the grid.
    int ring = 0;
    int column = 0;
    // For a flap: how many levels this vertex is raised, and how many the flap has; zero elsewhere.
    int level = 0;
    int levels = 0;
};

// The connections of the cage, without positions. Faces are counter-clockwise as seen from outside.
struct CageTopology {
    // One for each vertex, kControlPoints in all.
    std::vector<CageSite> sites;
    std::vector<std::array<std::uint16_t, 4>> faces;
    std::vector<CageCrease> creases;
};

// Builds the topology at every call, always the same; callers that need it often keep it.
[[nodiscard]] CageTopology makeCageTopology();

// Where the vertices of the control cage are on a species at rest: cage vertex from cage site.
// Keeps its own copies of the curves and fins that it needs, so the species may go away. Immutable.
class CageShape {
  public:
    // The shape of a species at rest.
    explicit CageShape(const config::Species& species);
    // Position, part and fin coordinates of one site of makeCageTopology().
    [[nodiscard]] CageVertex place(const CageSite& site) const;

  private:
    // The station s of each ring of the body.
    using RingStations = std::array<float, kBodyEndRing + 1>;

    // Sets back_, flank_ and belly_.
    void slantRings(const config::Species& species);
    // One function for each region of the cage. Left and right mirror each other; z is positive to
    // the right.
    [[nodiscard]] glm::vec3 onBody(int ring, int column) const;
    [[nodiscard]] glm::vec3 onPectoralRoot(int ring, int column) const;
    [[nodiscard]] CageVertex onCaudal(int ring, int column) const;
    [[nodiscard]] CageVertex onMedianFin(const CageSite& site) const;
    [[nodiscard]] CageVertex onPairedFin(const CageSite& site) const;

    Sections sections_;
    MouthShape mouth_;
    FinPatch firstDorsal_, secondDorsal_, anal_, caudal_, pelvic_, pectoral_;
    // Whether the species has one dorsal fin along the whole back, which takes the strips of both.
    bool isOneDorsal_;
    // Rings slant, so that the base of every fin lies on them: a ring has one station on the back,
    // one on the flank and one on the belly; between them they blend.
    RingStations back_{}, flank_{}, belly_{};
};

}  // namespace aquarama::body
