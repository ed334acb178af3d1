// SPDX-License-Identifier: Apache-2.0
// What fish can see of one another at the start of a tick: a structure of arrays, world frame.
// Nothing in it changes while the fish think.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace aquarama {

inline constexpr std::uint32_t kNobody = 0xffffffffU;  // no fish, no particle

// What a fish shows of its mood, as bits of FishView::signs.
enum Sign : std::uint8_t {
    kAway = 1,     // eaten, or not yet come: nobody sees it
    kWilling = 2,  // would mate
    kFemale = 4,
    kHunting = 8,
    kSchooling = 16,  // swims in a school
};

struct FishView {
    std::vector<float> x, y, z;                       // body frame's origin, metres
    std::vector<float> headingX, headingY, headingZ;  // course without the sway of the tail beat
    std::vector<float> speed;                         // metres a second
    std::vector<float> length;                        // metres
    std::vector<std::uint8_t> kind;                   // its species, an index into the cast
    std::vector<std::uint8_t> signs;                  // of Sign
    std::vector<std::uint32_t> partner;               // whom it courts; kNobody
    std::vector<std::uint8_t> stage;                  // of its courtship or hunt: Mind::stage

    void resize(std::size_t fish) {
        for (auto* values : {&x, &y, &z, &headingX, &headingY, &headingZ, &speed, &length})
            values->resize(fish);
        kind.resize(fish);
        signs.resize(fish);
        partner.resize(fish, kNobody);
        stage.resize(fish);
    }
    [[nodiscard]] std::size_t size() const { return x.size(); }
    [[nodiscard]] glm::vec3 position(std::size_t fish) const { return {x[fish], y[fish], z[fish]}; }
    [[nodiscard]] glm::vec3 heading(std::size_t fish) const {
        return {headingX[fish], headingY[fish], headingZ[fish]};
    }
    [[nodiscard]] bool shows(std::size_t fish, Sign sign) const {
        return (signs[fish] & sign) != 0;
    }
};

}  // namespace aquarama
