// SPDX-License-Identifier: Apache-2.0
#include "master/capture/search/search_journal.h"

#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include "common/units/error.h"

namespace aquarama::search {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFigures = 5;  // of a trial, before its point

std::string lineOf(const SearchTrial& trial) {
    std::ostringstream line;
    line.precision(17);  // each double comes back as it was
    line << trial.miss << ' ' << trial.leastStrouhal << ' ' << trial.mostStrouhal << ' '
         << trial.leastStride << ' ' << trial.mostStride;
    for (const double coordinate : trial.point) line << ' ' << coordinate;
    return line.str();
}

std::optional<SearchTrial> parseTrial(const std::string& line) {
    std::istringstream numbers(line);
    const std::vector<double> values{std::istream_iterator<double>(numbers), {}};
    if (!numbers.eof() || values.size() <= kFigures) return std::nullopt;
    SearchTrial trial{.point = {values.begin() + kFigures, values.end()},
                      .miss = values[0],
                      .leastStrouhal = values[1],
                      .mostStrouhal = values[2],
                      .leastStride = values[3],
                      .mostStride = values[4]};
    return lineOf(trial) == line ? std::optional(std::move(trial)) : std::nullopt;
}

// What is there up to the last line that was finished.
std::string wholeLinesOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return text.substr(0, text.rfind('\n') + 1);
}

std::vector<SearchTrial> parseTrials(const std::string& text,
                                     const std::string& search,
                                     const fs::path& path) {
    std::istringstream lines(text);
    std::string line;
    if (!std::getline(lines, line) || line != search)
        throw Error(path.string() +
                    ":1: the journal of another search; remove it, or write elsewhere with --out");
    std::vector<SearchTrial> trials;
    while (std::getline(lines, line)) {
        std::optional<SearchTrial> trial = parseTrial(line);
        if (!trial)
            throw Error(path.string() + ':' + std::to_string(trials.size() + 2) +
                        ": not a trial, the journal is damaged; remove this line and those after "
                        "it, or the file");
        trials.push_back(*std::move(trial));
    }
    return trials;
}

}  // namespace

SearchJournal::SearchJournal(fs::path path, const std::string& search) : path_(std::move(path)) {
    const std::string before = wholeLinesOf(path_);
    if (!before.empty()) {
        trials_ = parseTrials(before, search, path_);
        fs::resize_file(path_, before.size());
    }
    file_.open(path_, before.empty() ? std::ios::trunc : std::ios::app);
    if (before.empty()) file_ << search << '\n' << std::flush;
    if (!file_)
        throw Error(path_.string() + ": cannot be written; choose another folder with --out");
}

void SearchJournal::add(const SearchTrial& trial) {
    file_ << lineOf(trial) << '\n' << std::flush;
    if (!file_)
        throw Error(path_.string() + ": cannot be written; make space and search again to go on");
    trials_.push_back(trial);
}

}  // namespace aquarama::search
