// SPDX-License-Identifier: Apache-2.0
#include "master/study/chronicle_report.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "master/capture/report/svg.h"

namespace aquarama::study {

namespace {

constexpr std::array<const char*, fish::kIntentions> kRoutines{
    "wander", "leave", "school", "eat", "mate", "escape", "avoid fish", "avoid obstacle"};

struct Group {
    std::string name;
    std::uint64_t count = 0;
    double seconds = 0, longest = 0, longestDeep = 0;
    double deepest = 0;
};

double secondsOf(std::uint64_t ticks) {
    return static_cast<double>(ticks) / kTicksPerSecond;
}

void add(Group& group, const BodyOverlap& overlap) {
    ++group.count;
    group.seconds += secondsOf(overlap.ticks);
    group.longest = std::max(group.longest, secondsOf(overlap.ticks));
    group.longestDeep = std::max(group.longestDeep, secondsOf(overlap.deepTicks));
    group.deepest = std::max(group.deepest, static_cast<double>(overlap.deepest));
}

std::string tableOf(const std::map<std::pair<std::string, std::string>, Group>& groups,
                    const std::string& head,
                    double hours) {
    std::vector<Group> rows;
    for (const auto& [pair, group] : groups) {
        rows.push_back(group);
        rows.back().name = pair.first + ", " + pair.second;
    }
    std::ranges::stable_sort(rows, std::greater<>{}, &Group::seconds);
    std::string table = "| " + head +
                        " | overlaps an hour | seconds an hour | longest, s | longest over a "
                        "quarter of a body, s | deepest, % of the shorter body |\n"
                        "|---|---|---|---|---|---|\n";
    for (const Group& row : rows)
        table += "| " + row.name + " | " +
                 report::fixed(static_cast<double>(row.count) / hours, 1) + " | " +
                 report::fixed(row.seconds / hours, 1) + " | " + report::fixed(row.longest, 1) +
                 " | " + report::fixed(row.longestDeep, 1) + " | " +
                 report::fixed(100 * row.deepest, 0) + " |\n";
    return table;
}

std::pair<std::string, std::string> ordered(std::string a, std::string b) {
    if (b < a) std::swap(a, b);
    return {std::move(a), std::move(b)};
}

}  // namespace

std::string hoursMarkdown(std::span<const Hour> hours) {
    std::string table =
        "| hour | fewest fish | meals | catches | returns | spawnings | wander / leave / school / "
        "eat / mate / escape / avoid fish / avoid obstacle, % | changes of intention, a fish and "
        "minute | overlaps, a fish and minute | in another fish, % | into terrain | shortest way, "
        "m | longest stay, s (fish) | farthest out, m | spread, m | water used, % |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    int number = 0;
    for (const Hour& hour : hours) {
        std::string shares;
        for (const double share : hour.intentionShare)
            shares += (shares.empty() ? "" : " / ") + report::fixed(100 * share, 1);
        table += "| " + std::to_string(++number) + " | " + std::to_string(hour.fewest) + " | " +
                 std::to_string(hour.counts.meals) + " | " + std::to_string(hour.counts.catches) +
                 " | " + std::to_string(hour.counts.returns) + " | " +
                 std::to_string(hour.counts.spawnings) + " | " + shares + " | " +
                 report::fixed(hour.changes, 1) + " | " + report::fixed(hour.touches, 3) + " | " +
                 report::fixed(hour.overlapPercent, 2) + " | " + std::to_string(hour.bumps) +
                 " | " + report::fixed(static_cast<double>(hour.shortestWayMetres), 0) + " | " +
                 report::fixed(hour.longestStaySeconds, 0) + " (" + std::to_string(hour.whoStayed) +
                 ") | " + report::fixed(static_cast<double>(hour.farthestOutMetres), 2) + " | " +
                 report::fixed(static_cast<double>(hour.spreadMetres), 2) + " | " +
                 report::fixed(hour.waterUsedPercent, 0) + " |\n";
    }
    return table;
}

std::string overlapsMarkdown(const OverlapLog& log,
                             const world::World& world,
                             std::span<const world::WorldSpecies> cast,
                             double hours) {
    std::map<std::pair<std::string, std::string>, Group> bySpecies, byRoutine;
    const auto nameOf = [&](std::uint32_t fish) { return cast[world.view().kind[fish]].name; };
    const auto routineOf = [](fish::Intention intention) {
        return kRoutines.at(static_cast<std::size_t>(intention));
    };
    for (const BodyOverlap& overlap : log.all()) {
        add(bySpecies[ordered(nameOf(overlap.a), nameOf(overlap.b))], overlap);
        add(byRoutine[ordered(routineOf(overlap.intentionOfA), routineOf(overlap.intentionOfB))],
            overlap);
    }
    return tableOf(bySpecies, "species", hours) + "\n" +
           tableOf(byRoutine, "as it began they would", hours);
}

}  // namespace aquarama::study
