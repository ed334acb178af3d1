// SPDX-License-Identifier: Apache-2.0
// An insight as a screen of text: at most 24 lines of 78 characters, printable ASCII.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "master/fish/fish_view.h"
#include "master/simulation/insight.h"

namespace aquarama::simulation {

inline constexpr std::size_t kScreenLines = 24;
inline constexpr std::size_t kScreenColumns = 78;

// Of whom the fish is aware: where all are, and what their species are called, by FishView::kind.
struct Acquaintances {
    const fish::FishView& view;
    std::span<const std::string> species;
};

[[nodiscard]] std::vector<std::string> linesOf(const Insight& insight, const Acquaintances& others);

}  // namespace aquarama::simulation
