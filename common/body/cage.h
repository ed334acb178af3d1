// SPDX-License-Identifier: Apache-2.0
// How the 426 vertices of every fish's control cage hang together: one closed all-quad surface, the
// same for all species, so that what is made for one mesh serves all.
//
// A tube of 26 rings of 12 columns runs from head to tail: rings 0-20 are the body, 21 its end,
// 21-25 the tail fin, which is the tube drawn flat. Columns 0 | 1 straddle the back, 2-5 go down
// the right side, 6 | 7 straddle the belly, 8-11 come up the left. A 3 x 3 grid of quads closes the
// nose, 5 quads close the tail. The other fins are strips of tube faces, raised by one or two
// levels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/body/fins.h"
#include "common/body/fish_body.h"
#include "common/body/spine.h"
#include "common/config/species.h"

namespace aquarama::body {

inline constexpr int kTubeRings = 26;
inline constexpr int kTubeColumns = 12;
inline constexpr int kBodyEndRing = 21;

enum class CageSiteKind : std::uint8_t { Tube, Nose, Flap };

// Where a vertex is in the cage.
struct CageSite {
    CageSiteKind kind = CageSiteKind::Tube;
    CagePart part = CagePart::Body;
    int ring = 0;  // of the tube vertex that it is or was raised from; for the nose the grid's row
    int column = 0;  // the same; for the nose the grid's column
    int level = 0;   // how many levels a flap's vertex is raised
    int levels = 0;  // of this flap
};

struct CageTopology {
    std::vector<CageSite> sites;  // one a vertex
    std::vector<std::array<std::uint16_t, 4>> faces;
    std::vector<CageCrease> creases;
};

[[nodiscard]] CageTopology makeCageTopology();

// Where the vertices of the control cage are on a species at rest.

class CageShape {
  public:
    explicit CageShape(const config::Species& species);
    [[nodiscard]] CageVertex place(const CageSite& site) const;

  private:
    struct Section {
        float dorsal, ventral, halfWidth;
        float fullnessUp, fullnessDown;
    };
    using RingStations = std::array<float, kBodyEndRing + 1>;

    void slantRings(const config::Species& species);
    [[nodiscard]] Section sectionAt(float s) const;
    [[nodiscard]] glm::vec3 onBody(int ring, int column) const;
    [[nodiscard]] glm::vec3 onPectoralRoot(int ring, int column) const;
    [[nodiscard]] CageVertex onCaudal(int ring, int column) const;
    [[nodiscard]] glm::vec3 onNose(int row, int column) const;
    [[nodiscard]] CageVertex onMedianFin(const CageSite& site) const;
    [[nodiscard]] CageVertex onPairedFin(const CageSite& site) const;

    MonotoneCurve dorsal_, ventral_, halfWidth_, fullnessUp_, fullnessDown_;
    FinPatch firstDorsal_, secondDorsal_, anal_, caudal_, pelvic_, pectoral_;
    bool isOneDorsal_;
    // Rings slant, so that the base of every fin lies on them: their stations on back, flank,
    // belly.
    RingStations back_{}, flank_{}, belly_{};
};

}  // namespace aquarama::body
