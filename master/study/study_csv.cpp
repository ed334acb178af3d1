// SPDX-License-Identifier: Apache-2.0
#include "master/study/study_csv.h"

#include <cmath>
#include <sstream>

#include "master/capture/report/csv.h"

namespace aquarama::study {

namespace {

constexpr std::array<const char*, fish::kIntentions> kRoutines{
    "wander", "leave", "school", "eat", "mate", "escape", "avoid fish", "avoid obstacle"};

double secondsOf(std::uint64_t ticks) {
    return static_cast<double>(ticks) / kTicksPerSecond;
}

}  // namespace

std::string runsCsv(const StudyPlan& plan, const std::vector<Sample>& samples) {
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
    for (const char* routine : kRoutines) csv << ',' << routine << " share";
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
                       kRoutines.at(static_cast<std::size_t>(overlap.intentionOfA)),
                       kRoutines.at(static_cast<std::size_t>(overlap.intentionOfB)),
                       secondsOf(overlap.from.value),
                       secondsOf(overlap.ticks),
                       secondsOf(overlap.deepTicks),
                       overlap.deepest);
    return csv.str();
}

}  // namespace aquarama::study
