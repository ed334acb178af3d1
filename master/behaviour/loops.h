// SPDX-License-Identifier: Apache-2.0
// The rounds of fish that graze on a loop of patches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "master/fish/fish_view.h"
#include "master/surroundings/turf.h"

namespace aquarama::behaviour {

// The round of a fish: 8 to 15 patches, by index, far apart from each other, in the order in which
// it visits them. All where there are fewer.
struct Loop {
    static constexpr std::size_t kMost = 15;
    std::array<std::uint32_t, kMost> patches{};
    std::size_t count = 0;
    // The patches in use, in the order of the round.
    [[nodiscard]] std::span<const std::uint32_t> all() const {
        return std::span(patches).first(count);
    }
};
// The turf must have a patch.
[[nodiscard]] Loop loopOf(const surroundings::Turf& turf, std::uint32_t seed, std::uint32_t fish);

// The rounds of all fish of a world that graze so: they never change, and each is a search among
// all patches. Constant once made.
class Loops {
  public:
    // None.
    Loops() = default;
    Loops(const surroundings::Turf& turf,
          std::uint32_t seed,
          std::span<const fish::SpeciesParameters> speciesParameters);

    // That of a fish; null where none was made.
    [[nodiscard]] const Loop* of(const fish::SpeciesParameters& parameters,
                                 std::uint32_t fish) const;

  private:
    std::vector<std::vector<Loop>> ofKind_;
};

}  // namespace aquarama::behaviour
