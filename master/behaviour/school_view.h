// SPDX-License-Identifier: Apache-2.0
// What fish can see of one another at the start of a tick: a structure of arrays, world frame.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace aquarama {

struct SchoolView {
    std::vector<float> x, y, z;                       // body frame's origin, metres
    std::vector<float> headingX, headingY, headingZ;  // course without the sway of the tail beat
    std::vector<float> speed;                         // metres a second
    std::vector<float> length;                        // metres

    void resize(std::size_t fish) {
        for (auto* values : {&x, &y, &z, &headingX, &headingY, &headingZ, &speed, &length})
            values->resize(fish);
    }
    [[nodiscard]] std::size_t size() const { return x.size(); }
    [[nodiscard]] glm::vec3 position(std::size_t fish) const { return {x[fish], y[fish], z[fish]}; }
    [[nodiscard]] glm::vec3 heading(std::size_t fish) const {
        return {headingX[fish], headingY[fish], headingZ[fish]};
    }
};

}  // namespace aquarama
