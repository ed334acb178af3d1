// SPDX-License-Identifier: Apache-2.0
// Where the vertices of the control cage are on a species at rest.
#pragma once

#include <array>

#include "common/body/cage_topology.h"
#include "common/body/fin_patch.h"
#include "common/body/fish_body.h"
#include "common/body/monotone_curve.h"
#include "common/config/species.h"

namespace aquarama::body {

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
