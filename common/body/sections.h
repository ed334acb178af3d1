// SPDX-License-Identifier: Apache-2.0
// The cross-sections of a body at rest, from the profile in the species' file. Lengths in body
// lengths.
#pragma once

#include "common/body/spine.h"
#include "common/config/species.h"

namespace aquarama::body {

// A Catmull-Clark limit surface is smaller than its cage by this.
inline constexpr float kCageGrowth = 1.045F;

// The cross-section at a station: heights above and below the axis, half width, and the exponents
// of the superellipses of upper and lower half.
struct Section {
    float dorsal, ventral, halfWidth;
    float fullnessUp, fullnessDown;

    // The height of a share of the upper (positive) or lower (negative) half; 1 is the back.
    [[nodiscard]] float heightAt(float share) const {
        return share * (share < 0 ? ventral : dorsal);
    }
    // How far from the middle plane the skin is at such a share.
    [[nodiscard]] float widthAt(float share) const;
};

// The sections of one species. Immutable.
class Sections {
  public:
    explicit Sections(const config::BodyProfile& profile);
    // Outside of the profile that of its nearest end.
    [[nodiscard]] Section at(float s) const;

  private:
    MonotoneCurve dorsal_, ventral_, halfWidth_, fullnessUp_, fullnessDown_;
};

}  // namespace aquarama::body
