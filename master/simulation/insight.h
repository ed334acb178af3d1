// SPDX-License-Identifier: Apache-2.0
// A look into one mind: what the fish senses, feels, intends and does at this tick, and why it does
// nothing else. It repeats the stages of a thought on the present world and writes nothing to it.
// The lines are for `aquarama explain`, the values for the console.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/base/units.h"
#include "common/motion/repertoire.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/perceive.h"
#include "master/behaviour/think.h"
#include "master/conductor/simulation.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"
#include "master/world/world.h"

namespace aquarama::simulation {

// All that is shown of one fish; copies, which do not depend on the world any more.
struct Insight {
    std::uint32_t fish = 0;
    Tick tick;
    // The parameters of its species.
    fish::SpeciesParameters parameters;
    float lengthMetres = 0;
    // Eaten, or not yet come: it does not think, and senses, feelings and reasoning are empty.
    bool away = false;
    // The mind after its last thought.
    fish::Mind mind;
    behaviour::Senses senses;
    fish::Feelings feelings;
    // The results of a thought at this tick; the fish may not have decided so yet.
    behaviour::Reasoning reasoning;
    // The course that it asks its motor for.
    fish::Course course;
    // The segment that is playing, its phase (0 to 1) and the present speed (body lengths a
    // second).
    motion::Action segment = motion::Action::ForwardMedium;
    float phase = 0;
    float swims = 0;
};

// Looks into the mind of a fish; empty where the world has no such fish. Call it between two ticks,
// from the thread of the world.
[[nodiscard]] std::optional<Insight> insightInto(const world::World& world, std::uint32_t fish);

// An insight as a screen of text: at most 31 lines of 78 characters, printable ASCII.

inline constexpr std::size_t kScreenLines = 31;
inline constexpr std::size_t kScreenColumns = 78;

// The data about other fish that the text needs: the view, and the names of the species by
// FishView::kind. Refers to both; used during one call only.
struct Acquaintances {
    const fish::FishView& view;
    std::span<const std::string> species;
};

// The lines of the screen, without line ends, and the values in them.
[[nodiscard]] conductor::Explanation explanationOf(const Insight& insight,
                                                   const Acquaintances& others);

}  // namespace aquarama::simulation
