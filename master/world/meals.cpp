// SPDX-License-Identifier: Apache-2.0
#include "master/world/meals.h"

#include <algorithm>

#include "master/fish/courses.h"
#include "master/fish/mouth.h"

namespace aquarama::world {

namespace {

constexpr std::uint32_t kSwallowTicks = 6;  // a tenth of a second, as suction feeders do
static_assert(kSwallowTicks < fish::kTicksBetweenThoughts);

// The share of the way that is left grows with every tick: it is gulped, not fetched.
void drawIn(surroundings::Food& food,
            std::uint32_t particle,
            glm::vec3 mouth,
            std::uint32_t ticksLeft) {
    const glm::vec3 from = food.position(particle);
    const glm::vec3 at = from + (mouth - from) / static_cast<float>(ticksLeft);
    food.x[particle] = at.x;
    food.y[particle] = at.y;
    food.z[particle] = at.z;
}

}  // namespace

Meals makeMeals(std::size_t fish) {
    Meals meals;
    meals.swallows.reserve(fish);
    return meals;
}

void beginSwallow(Meals& meals, std::uint32_t fish, std::uint32_t particle) {
    meals.swallows.push_back({fish, particle, kSwallowTicks});
}

void advanceMeals(Meals& meals, const fish::FishView& view, surroundings::Food& food, Tick tick) {
    for (Meals::Swallow& swallow : meals.swallows) {
        if (view.shows(swallow.fish, fish::kAway))
            swallow.ticksLeft = 1;  // eaten itself: what it had in its mouth goes with it
        else
            drawIn(food, swallow.particle, fish::mouthOf(view, swallow.fish), swallow.ticksLeft);
        if (--swallow.ticksLeft == 0) surroundings::removeFood(food, swallow.particle, tick);
    }
    std::erase_if(meals.swallows,
                  [](const Meals::Swallow& swallow) { return swallow.ticksLeft == 0; });
}

}  // namespace aquarama::world
