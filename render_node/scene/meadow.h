// SPDX-License-Identifier: Apache-2.0
// All kelp and seagrass of the place: one draw for each kind and level, of what is in view.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/place/place.h"
#include "render_node/gl/handle.h"
#include "render_node/scene/frustum.h"

namespace aquarama {

class Meadow {
  public:
    explicit Meadow(std::uint32_t seed);
    void draw(const Viewpoint& viewpoint);

  private:
    // As plant.vert reads it.
    struct Individual {
        glm::vec4 rootAndHeight{};
        glm::vec4 habit{};
        glm::vec4 tintAndSway{};
    };
    struct Shape {
        std::size_t firstByte = 0;
        int indexCount = 0;
        int firstVertex = 0;
    };
    struct Species {
        std::vector<Individual> individuals;
        std::array<Shape, 3> shapes{};
        std::array<float, 2> levelMetres{};
    };
    void addSpecies(PlantKind kind, const std::vector<Plant>& plants, std::array<float, 2> limits);

    std::vector<Species> species_;
    std::vector<Individual> chosen_;
    gl::Buffer vertices_, indices_, individuals_;
    gl::VertexArray array_;
    gl::ProgramHandle program_;
};

}  // namespace aquarama
