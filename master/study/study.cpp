// SPDX-License-Identifier: Apache-2.0
#include "master/study/study.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "capture/report/report_data.h"
#include "common/base/byte_stream.h"
#include "common/base/worker_pool.h"
#include "common/config/species.h"
#include "common/place/place.h"
#include "master/simulation/living_world.h"
#include "master/study/quantities.h"

namespace aquarama::study {

namespace {

// A run is not watched before these ticks, while its fish settle.
constexpr std::uint64_t kSettlingTicks = static_cast<std::uint64_t>(30 * kTicksPerSecond);

// One run.
struct Task {
    std::size_t scenario, condition;
    std::uint32_t seed;
};

// All runs of a plan, in the order of its tables.
std::vector<Task> tasksOf(const StudyPlan& plan) {
    std::vector<Task> tasks;
    for (std::size_t scenario = 0; scenario < plan.scenarios.size(); ++scenario)
        for (std::size_t condition = 0; condition < kConditions.size(); ++condition)
            for (std::uint32_t seed = 1; seed <= plan.seeds; ++seed)
                tasks.push_back({scenario, condition, seed});
    return tasks;
}

constexpr std::uint64_t kTicksBetweenPinches = static_cast<std::uint64_t>(30 * kTicksPerSecond);

Digest digestOfAssets(const wire::AssetBundle& assets) {
    ByteWriter content;
    const auto add = [&](const auto& bytes) {
        content.characters(digestOf(std::as_bytes(std::span(bytes))).bytes);
    };
    add(assets.scene);
    for (const wire::SpeciesAssets& species : assets.cast) {
        add(species.text);
        add(species.repertoire);
        content.unsignedNumber(species.fish);
    }
    return digestOf(content.written());
}

// A scenario for each species of the cast, named after it, with no other in it.
std::vector<Scenario> eachAlone(const Scenario& all) {
    std::vector<Scenario> scenarios;
    for (std::size_t kind = 0; kind < all.world.cast.size(); ++kind) {
        Scenario alone = all;
        alone.world.cast = {all.world.cast[kind]};
        alone.halfWidths = {all.halfWidths[kind]};
        alone.name += ": " + alone.world.cast.front().name;
        scenarios.push_back(std::move(alone));
    }
    return scenarios;
}

double secondsOf(std::uint64_t ticks) {
    return static_cast<double>(ticks) / kTicksPerSecond;
}

void addSpecies(std::ostream& text, const std::string& name, const SpeciesTally& tally) {
    const auto slip = [&](const auto& angles) {
        text << " | " << quantileDegrees(angles, 0.5) << " / " << quantileDegrees(angles, 0.99);
    };
    text << "| " << name << " | " << tally.heading.percent() << " | " << tally.pitch.percent()
         << " | " << tally.way.percent();
    slip(tally.meanSlip);
    slip(tally.bodySlip);
    text << " | " << static_cast<double>(tally.changes) / tally.fishSeconds << " | " << tally.meals
         << " | " << tally.flights << " | " << tally.dives << " | " << tally.fastStarts << " | "
         << tally.courtships << " | " << tally.spawnings << " |\n";
}

}  // namespace

Figures runOnce(const Scenario& scenario,
                const fish::Adaptation& adaptation,
                std::uint32_t seed,
                double minutes) {
    assert(minutes >= 0);
    world::WorldOptions options = scenario.world;
    options.seed = seed;
    options.threads = 1;
    options.adaptation = adaptation;
    world::World world(options);
    for (std::uint64_t tick = 0; tick < kSettlingTicks; ++tick) world.advance();
    Diary diary(world, scenario.halfWidths);
    Feeding feeding(scenario.ticksBetweenPinches, seed);
    const auto ticks = static_cast<std::uint64_t>(minutes * 60 * kTicksPerSecond);
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
        feeding.before(world);
        world.advance();
        diary.note(world);
        feeding.after(world, diary.tally().particles);
    }
    return figuresOf(diary, feeding.meanSeconds());
}

std::size_t runsOf(const StudyPlan& plan) {
    return plan.scenarios.size() * kConditions.size() * plan.seeds;
}

std::vector<Figures> runSome(const StudyPlan& plan,
                             std::size_t first,
                             std::size_t last,
                             const std::function<void(double)>& done) {
    assert(done != nullptr);
    assert(first <= last);
    assert(last <= runsOf(plan));
    const std::vector<Task> tasks = tasksOf(plan);
    std::vector<Figures> runs(last - first);
    std::atomic<std::size_t> finished = 0;
    WorkerPool(plan.threads).run(runs.size(), [&](std::size_t i) {
        const Task& task = tasks[first + i];
        // Each task writes an element of its own: no lock is needed.
        runs[i] = runOnce(plan.scenarios[task.scenario],
                          kConditions.at(task.condition).adaptation,
                          task.seed,
                          plan.minutes);
        done(static_cast<double>(++finished) / static_cast<double>(runs.size()));
    });
    return runs;
}

std::vector<Sample> samplesOf(const StudyPlan& plan, std::span<const Figures> runs) {
    assert(runs.size() == runsOf(plan));
    std::vector<Sample> samples(plan.scenarios.size());
    for (Sample& sample : samples)
        for (auto& seeds : sample) {
            seeds.assign(runs.begin(), runs.begin() + plan.seeds);
            runs = runs.subspan(plan.seeds);
        }
    return samples;
}

Scenario readScenario(const std::filesystem::path& scene) {
    const simulation::Assets assets = simulation::readAssets(scene.string(), {});
    Scenario scenario;
    scenario.inputs = digestOfAssets(assets.bytes);
    scenario.world = simulation::worldOptionsOf(assets);
    // Fish are to be measured undisturbed, not how they make way.
    scenario.world.scene.tour.reset();
    scenario.name = scenario.world.scene.name;
    for (const config::Species& species : assets.species)
        scenario.halfWidths.push_back(std::ranges::max(species.profile.halfWidth));
    return scenario;
}

std::vector<Scenario> scenariosOf(const std::filesystem::path& configFolder) {
    std::vector<Scenario> scenarios;
    for (const std::string_view scene :
         {"reef_1998", "study/school", "study/crowded_tank", "study/feeding"})
        scenarios.push_back(
            readScenario(configFolder / "scenes" / (std::string(scene) + ".txtpb")));
    // Only the last of these is one of feeding.
    scenarios.back().ticksBetweenPinches = kTicksBetweenPinches;
    std::ranges::move(eachAlone(readScenario(configFolder / "scenes" / "study" / "alone.txtpb")),
                      std::back_inserter(scenarios));
    return scenarios;
}

std::string runsCsv(const StudyPlan& plan, const std::vector<Sample>& samples) {
    assert(samples.size() == plan.scenarios.size());
    std::ostringstream csv;
    csv << "scenario,condition,seed";
    for (std::size_t i = 0; i < kQuantities; ++i) csv << ',' << keyOf(static_cast<Quantity>(i));
    csv << '\n';
    for (std::size_t scenario = 0; scenario < samples.size(); ++scenario)
        for (std::size_t condition = 0; condition < kConditions.size(); ++condition)
            for (std::size_t seed = 0; seed < plan.seeds; ++seed) {
                csv << plan.scenarios[scenario].name << ',' << kConditions.at(condition).name << ','
                    << seed + 1;
                for (const double value : samples[scenario].at(condition)[seed]) {
                    csv << ',';
                    if (!std::isnan(value)) csv << value;
                }
                csv << '\n';
            }
    return csv.str();
}

std::string hoursCsv(std::span<const Hour> hours) {
    std::ostringstream csv;
    csv << "hour,fewest_fish,meals,catches,returns,spawnings";
    for (std::size_t i = 0; i < fish::kIntentions; ++i)
        csv << ',' << fish::nameOf(static_cast<fish::Intention>(i)) << " share";
    csv << ",changes_per_fish_minute,touches_per_fish_minute,overlap_percent,into_terrain,"
           "shortest_way_m,longest_stay_s,who_stayed,farthest_out_m,spread_m,water_used_percent\n";
    int number = 0;
    for (const Hour& hour : hours) {
        csv << ++number << ',' << hour.fewest << ',' << hour.counts.meals << ','
            << hour.counts.catches << ',' << hour.counts.returns << ',' << hour.counts.spawnings;
        for (const double share : hour.intentionShare) csv << ',' << share;
        csv << ',';
        report::addRow(csv,
                       hour.changes,
                       hour.touches,
                       hour.overlapPercent,
                       hour.bumps,
                       hour.shortestWayMetres,
                       hour.longestStaySeconds,
                       hour.whoStayed,
                       hour.farthestOutMetres,
                       hour.spreadMetres,
                       hour.waterUsedPercent);
    }
    return csv.str();
}

std::string speciesText(const SpeciesLog& log, std::span<const world::WorldSpecies> cast) {
    assert(log.byKind().size() == cast.size());
    std::ostringstream text;
    text << std::fixed << std::setprecision(1)
         << "| species | captured, %: heading | pitch | way | path against captured motion, "
            "degrees: "
            "median / 99 % | path against the body | changes of command a second | meals | flights "
            "that began | dives | fast starts | courtships that began | spawnings |\n"
            "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (std::size_t kind = 0; kind < cast.size(); ++kind)
        addSpecies(text, cast[kind].name, log.byKind()[kind]);
    const SpeciesTally all = log.all();
    addSpecies(text, "all", all);
    const auto lowest = [&](Share SpeciesTally::*share) {
        double least = 100;
        for (const SpeciesTally& tally : log.byKind())
            least = std::min(least, (tally.*share).percent());
        return least;
    };
    text << "\ndifferent commands: " << log.distinctCommands() << '\n'
         << "lowest captured: heading " << lowest(&SpeciesTally::heading) << " %, pitch "
         << lowest(&SpeciesTally::pitch) << " %, way " << lowest(&SpeciesTally::way) << " %\n";
    return text.str();
}

std::string overlapsCsv(const OverlapLog& log,
                        const world::World& world,
                        std::span<const world::WorldSpecies> cast) {
    std::ostringstream csv;
    csv << "species_a,species_b,routine_a,routine_b,from_s,seconds,deep_seconds,deepest_share\n";
    const auto speciesOf = [&](std::uint32_t fish) -> const std::string& {
        return cast[world.view().kind[fish]].name;
    };
    for (const BodyOverlap& overlap : log.all())
        report::addRow(csv,
                       speciesOf(overlap.a),
                       speciesOf(overlap.b),
                       fish::nameOf(overlap.intentionOfA),
                       fish::nameOf(overlap.intentionOfB),
                       secondsOf(overlap.from.value),
                       secondsOf(overlap.ticks),
                       secondsOf(overlap.deepTicks),
                       overlap.deepest);
    return csv.str();
}

}  // namespace aquarama::study
