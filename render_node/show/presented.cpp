// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/presented.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace aquarama::show {

std::optional<motion::PresentedFish> presentedFish(const wire::StateFrame& frame,
                                                   std::span<const motion::FishTraits> school,
                                                   std::size_t place) {
    if (place >= std::min(frame.after.size(), school.size())) return std::nullopt;
    // Without a record of the tick before, the frame shows the later tick.
    const bool between = frame.before.size() == frame.after.size();
    const motion::FishRecord& before = between ? frame.before[place] : frame.after[place];
    return motion::present(
        before, frame.after[place], between ? frame.fraction : 1.0F, school[place]);
}

std::vector<motion::PresentedFish> presentedFish(const wire::StateFrame& frame,
                                                 std::span<const motion::FishTraits> school) {
    std::vector<motion::PresentedFish> fish;
    const std::size_t count = std::min(frame.after.size(), school.size());
    fish.reserve(count);
    for (std::size_t i = 0; i < count; ++i) fish.push_back(*presentedFish(frame, school, i));
    return fish;
}

void presentFood(const wire::StateFrame& frame, std::vector<scene::FoodParticle>& food) {
    const bool between = frame.foodBefore.size() == frame.foodAfter.size();
    food.clear();
    food.reserve(frame.foodAfter.size());
    for (std::size_t i = 0; i < frame.foodAfter.size(); ++i) {
        const wire::FoodRecord after = frame.foodAfter[i];
        if (after.kind() == wire::FoodRecord::Kind::None) continue;
        const wire::FoodRecord before = between ? frame.foodBefore[i] : after;
        const bool isSame =
            before.kind() == after.kind() && before.generation() == after.generation();
        const glm::vec3 to = after.offsetMetres();
        const glm::vec3 from = isSame ? before.offsetMetres() : to;
        food.push_back({frame.foodOriginMetres + glm::mix(from, to, frame.fraction),
                        static_cast<std::uint32_t>(4 * i + after.generation()),
                        after.kind() == wire::FoodRecord::Kind::Pellet});
    }
}

double presentedSeconds(const wire::StateFrame& frame) {
    const double ticks =
        static_cast<double>(frame.tick.value) - 1 + static_cast<double>(frame.fraction);
    return std::max(ticks, 0.0) / kTicksPerSecond;
}

glm::dmat4 wallFromWorld(const wire::Eye& eye) {
    const glm::dmat4 wallFromWorldRotation =
        glm::mat4_cast(glm::conjugate(glm::dquat(eye.worldFromWall)));
    return glm::translate(wallFromWorldRotation, -glm::dvec3(eye.positionMetres));
}

}  // namespace aquarama::show
