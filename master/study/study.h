// SPDX-License-Identifier: Apache-2.0
// The same scenes with and without each adaptation of the mind to its weaker motor (paper, sections
// 5.1 and 5.2), over several seeds.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "master/fish/secondary_controller.h"
#include "master/study/chronicle.h"
#include "master/study/quantities.h"
#include "master/world/world.h"

namespace aquarama::study {

struct Condition {
    const char* name;
    fish::Adaptation adaptation;
};
inline constexpr std::array kConditions{
    Condition{"all", {}},
    Condition{"no recommendations", {.recommendations = false}},
    Condition{"regions not enlarged", {.enlargedRegions = false}},
    Condition{"late pursuit", {.earlierPursuit = false}},
    Condition{"none",
              {.recommendations = false, .enlargedRegions = false, .earlierPursuit = false}},
};

struct Scenario {
    std::string name;
    world::WorldOptions world;              // its seed and adaptation are the run's
    std::vector<float> halfWidths;          // body lengths, by kind of the cast
    std::uint64_t ticksBetweenPinches = 0;  // of food; 0: nobody feeds
};

// Figures of one scenario: [condition][seed].
using Sample = std::array<std::vector<Figures>, kConditions.size()>;

struct StudyPlan {
    std::vector<Scenario> scenarios;
    double minutes = 10;  // of each run
    std::uint32_t seeds = 5;
    unsigned threads = 1;
};

[[nodiscard]] Figures runOnce(const Scenario& scenario,
                              const fish::Adaptation& adaptation,
                              std::uint32_t seed,
                              double minutes);

// A sample for each scenario. `done` hears after each run which share is done, from any thread.
[[nodiscard]] std::vector<Sample> runStudy(const StudyPlan& plan,
                                           const std::function<void(double)>& done);

// Where adaptation is put to the test: scenes of the show and of config/scenes/study.

// A scene's file, whose own name the scenario bears. Throws Error.
[[nodiscard]] Scenario readScenario(const std::filesystem::path& scene);

// The reef as on the wall; its school alone; fish in a tank where they must keep out of each
// other's way; and hungry ones that are fed.
[[nodiscard]] std::vector<Scenario> scenariosOf(const std::filesystem::path& configFolder);

// What the study and the chronicle write as CSV; draw_study.py makes their tables and the figure of
// it.

// A line for each scenario, condition and seed; empty where a run has none of a quantity.
[[nodiscard]] std::string runsCsv(const StudyPlan& plan, const std::vector<Sample>& samples);

// A line an hour; the shares are of the routines that the fish followed.
[[nodiscard]] std::string hoursCsv(std::span<const Hour> hours);

// A line for each time that two fish overlapped, with what both were about as it began.
[[nodiscard]] std::string overlapsCsv(const OverlapLog& log,
                                      const world::World& world,
                                      std::span<const world::WorldSpecies> cast);

}  // namespace aquarama::study
