// SPDX-License-Identifier: Apache-2.0
// The mouth in the control cage. The first ring of the cage is the loop of the lips: columns 10,
// 11, 0, 1, 2, 3 are the upper lip from the left corner over the front to the right corner, 4 to 9
// the lower lip back again. The grid that closes the ring is the inside of the mouth; the second
// ring runs around the lips. Lengths in body lengths, (s, y, z) at rest.
#pragma once

#include <array>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/body/sections.h"
#include "common/config/species.h"

namespace aquarama::body {

// Whether a snout reaches over the mouth, as a shark's does.
[[nodiscard]] bool isUnderSnout(const config::Mouth& mouth);

// Where the mouth of a species and the ring around it are at rest, shut. Immutable.
class MouthShape {
  public:
    MouthShape(const config::Mouth& mouth, const Sections& sections);

    // A vertex of the loop of the lips. step: columns from the middle of the upper lip (0) to its
    // corner (2), from the corner of the lower lip (3) to its middle (5); side: 1 right, -1 left.
    [[nodiscard]] glm::vec3 onLip(int step, float side) const;
    // A vertex of the inside: row 0 is its roof, row 1 its floor.
    [[nodiscard]] glm::vec3 inside(int row, float side) const;
    // A vertex of the ring around the lips; step as above.
    [[nodiscard]] glm::vec3 aroundLips(int step, float side) const;
    // Where that ring, extended to the rings behind it, is on back, flank and belly.
    [[nodiscard]] std::array<float, 3> ringStations() const { return ring_; }
    // The share of its half of the section (Section::heightAt) at which a column of the flank
    // passes the corner: step 2 above it, step 3 below it.
    [[nodiscard]] float shareBeside(int step) const;

  private:
    // A point of the line on which the lips meet; along: 0 at the front, 1 at the corner.
    [[nodiscard]] glm::vec2 onLine(float along) const;
    // How far out the skin is there.
    [[nodiscard]] float widthAt(glm::vec2 at) const;

    config::Mouth mouth_;
    Sections sections_;
    bool isUnderSnout_;
    std::array<float, 3> ring_{};
    float cornerShare_ = 0;  // of its half of the section
};

}  // namespace aquarama::body
