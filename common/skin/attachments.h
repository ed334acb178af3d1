// SPDX-License-Identifier: Apache-2.0
// What the cage has no room for, bound to it and drawn with the skin: eyes as balls that are set
// into the head, whips, lone spines and barbels. The same at every level of detail.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "common/body/fish_body.h"
#include "common/skin/limit_table.h"

namespace aquarama::skin {

struct Attachments {
    struct Vertex {
        std::vector<StencilEntry> entries;  // as a vertex of the surface has them
        SkinPlace place;                    // v is not yet known
    };
    std::vector<Vertex> vertices;
    // Of these vertices, an even number each: with the body, and with the fins.
    std::vector<std::array<std::uint32_t, 3>> onBody, onFins;
};

using RestTriangle = std::array<glm::vec3, 3>;  // (s, y, z)

// head: the skin of its right side, where the eye is.
[[nodiscard]] Attachments makeAttachments(const body::FishBody& body,
                                          std::span<const RestTriangle> head);

// Into so many pieces a thread is cut from root to tip; each is a tube of four sides.
[[nodiscard]] std::size_t threadSteps(const body::BodyThread& thread);

}  // namespace aquarama::skin
