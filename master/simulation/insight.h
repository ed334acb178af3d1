// SPDX-License-Identifier: Apache-2.0
// A look into one mind: what the fish senses, feels, intends and does at this tick, and why it does
// nothing else. Looking changes nothing: the stages of a thought run once more on the world as it
// is, and what they give is thrown away.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/motion/repertoire.h"
#include "common/units/units.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/mental_state.h"
#include "master/behaviour/perceive.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"
#include "master/world/world.h"

namespace aquarama::simulation {

struct Insight {
    std::uint32_t fish = 0;
    Tick tick;
    fish::SpeciesParameters parameters;
    float lengthMetres = 0;
    bool away = false;  // eaten, or not yet come: it thinks nothing
    fish::Mind mind;    // as its last thought left it
    behaviour::Senses senses;
    fish::Feelings feelings;
    behaviour::Reasoning reasoning;  // of a thought now; the mind may not have come to it yet
    fish::Course course;             // that it asks its motor for
    motion::Action segment = motion::Action::ForwardMedium;  // that is playing
    float phase = 0;                                         // of it, 0 to 1
    float swims = 0;                                         // body lengths a second
};

// Empty where the world has no such fish.
[[nodiscard]] std::optional<Insight> insightInto(const world::World& world, std::uint32_t fish);

// An insight as a screen of text: at most 24 lines of 78 characters, printable ASCII.

inline constexpr std::size_t kScreenLines = 24;
inline constexpr std::size_t kScreenColumns = 78;

// Of whom the fish is aware: where all are, and what their species are called, by FishView::kind.
struct Acquaintances {
    const fish::FishView& view;
    std::span<const std::string> species;
};

[[nodiscard]] std::vector<std::string> linesOf(const Insight& insight, const Acquaintances& others);

}  // namespace aquarama::simulation
