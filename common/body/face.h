// SPDX-License-Identifier: Apache-2.0
// How a face moves: the jaws, the gill covers, the breath. Lengths in body lengths.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "common/body/face_motion.h"
#include "common/body/fish_body.h"
#include "common/body/sections.h"
#include "common/config/species.h"

namespace aquarama::body {

// How far a fish has opened its mouth and lifted its gill covers, 0 to 1.
struct FacePose {
    float mouth = 0, gill = 0;
};

// The inputs of one fish's face at one moment.
struct FaceDrive {
    float seconds = 0;  // of the show, modulo kFinSeconds
    float lengthMetres = 0;
    float speed = 0;       // body lengths a second; backwards is negative
    float spread = 0;      // of its pectoral fins, 0 to 1
    float mouth = 0;       // as its record has it, 0 to 1
    std::uint32_t id = 0;  // gives each its own phase
};

// Breaths a second: whole tenths of a hertz, fewer the larger the fish.
[[nodiscard]] float breathHertz(float lengthMetres);
// The mouth of the record and the breath together. This is the reference that fish_face.glsl is
// tested against.
[[nodiscard]] FacePose facePose(const FaceDrive& drive);

// Sets what moves a point of the head: FinPoint::p, q, sway, side and arm. sections: of this
// species; vertex: of its body.
void setFacePoint(const config::Species& species,
                  const Sections& sections,
                  const CageVertex& vertex,
                  FinPoint& point);

// The displacement of a point of the body: tailwards, up, to the right. Zero for a shut mouth and
// gill covers that lie on.
[[nodiscard]] glm::vec3 faceOffset(const FinStyle& style, const FinPoint& point, FacePose pose);

}  // namespace aquarama::body
