// SPDX-License-Identifier: Apache-2.0
// The study of adaptation: the same scenes with and without each adaptation of the mind to its
// weaker motor (paper, sections 5.1 and 5.2), over several seeds.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/base/digest.h"
#include "master/fish/secondary_controller.h"
#include "master/study/chronicle.h"
#include "master/study/overlaps.h"
#include "master/study/quantities.h"
#include "master/study/species_log.h"
#include "master/world/world.h"

namespace aquarama::study {

// A set of adaptations, with its name in tables.
struct Condition {
    const char* name;
    fish::Adaptation adaptation;
};
// The first condition is the reference for the others: the show itself.
inline constexpr std::array kConditions{
    Condition{"all", {}},
    Condition{"no recommendations", {.recommendations = false}},
    Condition{"regions not enlarged", {.enlargedRegions = false}},
    Condition{"late pursuit", {.earlierPursuit = false}},
    Condition{"none",
              {.recommendations = false, .enlargedRegions = false, .earlierPursuit = false}},
};

// A scene that is run under every condition and seed.
struct Scenario {
    std::string name;
    // Of the files that the world is made of.
    Digest inputs;
    // Its seed, threads and adaptation are replaced for each run.
    world::WorldOptions world;
    // Greatest half-width of the body in body lengths, by kind of the cast.
    std::vector<float> halfWidths;
    // Ticks between two pinches of food; 0: nobody feeds.
    std::uint64_t ticksBetweenPinches = 0;
};

// Figures of one scenario, by condition and by seed less 1.
using Sample = std::array<std::vector<Figures>, kConditions.size()>;

// The plan of a study: every scenario under every condition with seeds 1 to `seeds`.
struct StudyPlan {
    std::vector<Scenario> scenarios;
    // Simulated time of each run, after 30 s of settling.
    double minutes = 10;
    std::uint32_t seeds = 5;
    unsigned threads = 1;
};

// The runs of a plan, in the order of its tables: by scenario, condition and seed.
[[nodiscard]] std::size_t runsOf(const StudyPlan& plan);

// One run, on one thread: a new world that settles for 30 s and is then watched for `minutes`.
[[nodiscard]] Figures runOnce(const Scenario& scenario,
                              const fish::Adaptation& adaptation,
                              std::uint32_t seed,
                              double minutes);

// Makes the runs of a plan from `first` up to `last`, which is not among them, and returns their
// figures in order. After each run `done` gets the share that is done, 0 to 1, from any of the
// threads.
[[nodiscard]] std::vector<Figures> runSome(const StudyPlan& plan,
                                           std::size_t first,
                                           std::size_t last,
                                           const std::function<void(double)>& done);
// A sample for each scenario, from the figures of all runs.
[[nodiscard]] std::vector<Sample> samplesOf(const StudyPlan& plan, std::span<const Figures> runs);

// The scenarios: scenes of the show and of config/scenes/study.

// Reads a scene as a scenario of the same name. Its tour is left out: the submarine would disturb
// the fish. Throws Error.
[[nodiscard]] Scenario readScenario(const std::filesystem::path& scene);

// The scenarios of the study: the reef as shown; its school alone; fish in a tank where they must
// avoid each other; hungry fish that are fed; and one hungry fish among plankton, for each species
// that eats it ("alone: bigeye_scad").
[[nodiscard]] std::vector<Scenario> scenariosOf(const std::filesystem::path& configFolder);

// CSV files of the study and the chronicle; draw_study.py draws tables and a figure from them.

// A line for each scenario, condition and seed; a cell is empty where a run has no value.
[[nodiscard]] std::string runsCsv(const StudyPlan& plan, const std::vector<Sample>& samples);

// A line for each hour; shares are of the time of all fish, by routine.
[[nodiscard]] std::string hoursCsv(std::span<const Hour> hours);

// How the fish moved, in Markdown: a line for each species, and the share of captured turning of
// all.
[[nodiscard]] std::string speciesText(const SpeciesLog& log,
                                      std::span<const world::WorldSpecies> cast);

// A line for each overlap of two fish, with what both intended when it began.
[[nodiscard]] std::string overlapsCsv(const OverlapLog& log,
                                      const world::World& world,
                                      std::span<const world::WorldSpecies> cast);

}  // namespace aquarama::study
