// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/against.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>

#include <spdlog/fmt/fmt.h>

#include "common/base/log.h"
#include "tests/bench/machine.h"

namespace aquarama::bench {

namespace {

// What a library of benchmarks adds to a name for a figure over all repetitions.
constexpr std::array<std::string_view, 4> kOverAll{"_mean", "_median", "_stddev", "_cv"};

// Name of the figure, and its value; nothing for a figure over all repetitions.
struct Row {
    std::string name;
    double value = 0;
};

double numberIn(std::string_view text, const std::string& where) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size())
        throw Error(where + ": \"" + std::string(text) + "\" is no number; measure once more");
    return number;
}

// A line is "MACHINE",BENCHMARK,TIME,COUNTER,VALUE, where either TIME or COUNTER and VALUE are
// given. Neither machines nor benchmarks have a quotation mark in their names.
std::optional<Row> rowIn(std::string_view line,
                         const std::string& machine,
                         const std::string& where) {
    const std::size_t end = line.find("\",");
    if (!line.starts_with('"') || end == std::string_view::npos)
        throw Error(where + ": this is no row of measurements; measure once more");
    const std::string_view of = line.substr(1, end - 1);
    if (of != machine)
        throw Error(where + ": was measured on \"" + std::string(of) + "\", this machine is \"" +
                    machine + "\"; compare runs of one machine");
    std::string_view benchmark = line.substr(end + 2);
    std::array<std::string_view, 3> fields;
    for (auto field = fields.rbegin(); field != fields.rend(); ++field) {
        const std::size_t comma = benchmark.rfind(',');
        if (comma == std::string_view::npos)
            throw Error(where + ": this is no row of measurements; measure once more");
        *field = benchmark.substr(comma + 1);
        benchmark = benchmark.substr(0, comma);
    }
    const auto [time, counter, value] = fields;
    const auto isOverAll = [&](std::string_view ending) { return benchmark.ends_with(ending); };
    if (std::ranges::any_of(kOverAll, isOverAll)) return std::nullopt;
    if (!time.empty()) return Row{std::string(benchmark), numberIn(time, where)};
    return Row{std::string(benchmark) + " " + std::string(counter), numberIn(value, where)};
}

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

// Half the distance between the least and the most, as a share of the median.
double spreadOf(const std::vector<double>& values) {
    const auto [least, most] = std::ranges::minmax(values);
    return (most - least) / 2 / std::abs(medianOf(values));
}

}  // namespace

Measurements readMeasurements(const std::string& path, const std::string& machine) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line))
        throw Error(path + ": cannot be read; name a file of measurements");
    if (line != kCsvHead)
        throw Error(path + ":1: this is no file of measurements; it would begin with " +
                    std::string(kCsvHead));
    Measurements measured;
    for (std::size_t number = 2; std::getline(file, line); ++number)
        if (const auto row = rowIn(line, machine, fmt::format("{}:{}", path, number)))
            measured[row->name].push_back(row->value);
    return measured;
}

std::vector<Compared> compare(const Measurements& before, const Measurements& now) {
    std::vector<Compared> compared;
    for (const auto& [name, values] : now) {
        const auto earlier = before.find(name);
        if (earlier == before.end()) continue;
        Compared one{name, medianOf(earlier->second), medianOf(values), {}};
        if (one.before == one.now || one.before == 0 || one.now == 0) continue;
        if (values.size() > 1 && earlier->second.size() > 1)
            one.noise = std::hypot(spreadOf(values), spreadOf(earlier->second));
        compared.push_back(std::move(one));
    }
    return compared;
}

void print(const std::vector<Compared>& compared, std::ostream& out) {
    out << fmt::format("\n{:>12} {:>12} {:>7} {:>8}\n", "before", "now", "ratio", "noise");
    for (const Compared& one : compared)
        out << fmt::format("{:12.5g} {:12.5g} {:7.3f} {:>8} {}\n",
                           one.before,
                           one.now,
                           one.now / one.before,
                           one.noise ? fmt::format("±{:.1f} %", 100 * *one.noise) : "?",
                           one.name);
    out << "noise: half the spread of the repetitions of both; ?: a run with one repetition "
           "(--benchmark_repetitions=5)\n";
}

}  // namespace aquarama::bench
