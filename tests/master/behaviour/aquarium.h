// SPDX-License-Identifier: Apache-2.0
// A small open water for tests of minds: a few fish of one or more species, put where a test wants
// them, that think without moving.
#pragma once

#include <utility>
#include <vector>

#include "common/place/place.h"
#include "master/behaviour/perceive.h"
#include "master/behaviour/think.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"

namespace aquarama::behaviour {

struct Aquarium {
    static constexpr glm::vec3 kCentre{0, -4, -5};

    // One kind that schools and has no other habits; more may be added to natures.
    explicit Aquarium(const std::vector<glm::vec3>& offsets = {}) {
        surroundings.obstacles = {{3}, {kCentre, {6, 3, 4}}, {}};
        surroundings.submarine.position = kCentre + glm::vec3{100, 0, 0};
        fish::SpeciesParameters parameters;
        parameters.habits.shares.schooling = 1;
        speciesParameters.push_back(parameters);
        for (const glm::vec3 offset : offsets) addFish(offset);
    }

    // At the centre and an offset, heading along +x; fish of one kind stand together.
    std::uint32_t addFish(glm::vec3 offset, std::uint8_t kind = 0, float length = 0.24F) {
        const std::size_t fish = view.size();
        view.resize(fish + 1);
        minds.resize(fish + 1);
        courses.resize(fish + 1);
        put(fish, offset);
        view.fish[fish].heading.x = 1;
        view.fish[fish].speed = 0.4F;
        view.fish[fish].length = length;
        view.kind[fish] = kind;
        if (speciesParameters[kind].last == 0)
            speciesParameters[kind].first = static_cast<std::uint32_t>(fish);
        speciesParameters[kind].last = static_cast<std::uint32_t>(fish) + 1;
        fish::Mind mind;
        mind.likes = fish::kLikesSchooling;
        mind.eaten = 100;
        mind.sinceMeal = 0;
        minds[fish] = mind;
        return static_cast<std::uint32_t>(fish);
    }
    void put(std::size_t fish, glm::vec3 offset) { view.fish[fish].position = kCentre + offset; }
    void head(std::size_t fish, glm::vec3 heading) { view.fish[fish].heading = heading; }

    // The grids must be made anew before they are asked.
    [[nodiscard]] Environment environment(Grids& grids) const {
        return {.view = &view,
                .grids = &grids,
                .surroundings = &surroundings,
                .speciesParameters = speciesParameters,
                .gathering = gathering,
                .goal = goal,
                .schoolRadiusMetres = 0.5F,
                .seed = 1,
                .tick = tick,
                .adaptation = {}};
    }
    [[nodiscard]] Grids freshGrids() const {
        Grids grids(surroundings.obstacles.water, view.size(), surroundings.food.size());
        grids.rebuild(view, surroundings.food, speciesParameters);
        return grids;
    }

    // Every fish thinks once.
    const fish::Courses& think() {
        Grids grids = freshGrids();
        events.clear();
        for (std::uint32_t fish = 0; fish < view.size(); ++fish)
            behaviour::think(environment(grids), fish, minds, courses, events);
        tick.value += fish::kTicksBetweenThoughts;
        return courses;
    }

    fish::FishView view;
    fish::Minds minds;
    fish::Courses courses;
    DeferredEvents events;
    surroundings::Surroundings surroundings;
    std::vector<fish::SpeciesParameters> speciesParameters;
    config::Gathering gathering = config::Gathering::None;
    surroundings::Goal goal{kCentre, {0.4F, 0, 0}};
    Tick tick;
};

}  // namespace aquarama::behaviour
