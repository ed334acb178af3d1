// SPDX-License-Identifier: Apache-2.0
#include "capture/search.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <exception>
#include <fstream>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>
#include <sstream>
#include <string_view>
#include <tuple>
#include <utility>

#include <nlopt.hpp>

#include "capture/gait_trial.h"
#include "common/base/digest.h"
#include "common/base/hash.h"
#include "common/base/log.h"

namespace aquarama::capture {

namespace {

// The parameters.

// What the search may change. Not among them: the contraction of muscles, since swimming depends
// only on its product with the drives and turns need its value; the beat frequencies and the time
// scale, which belong to the species; the gain of medium swimming, to which the other gains are
// relative. One parameter scales the three kinds of stiffness together and keeps their ratios.
struct Parameter {
    double least, most;  // the range, in the units of config::Species; least > 0
    double (*get)(const config::Species&);
    void (*set)(config::Species&, double);
};

void setStiffness(config::Species& s, double stiffness) {
    const double factor = stiffness / s.tissue.stiffness;
    s.tissue.stiffness *= factor;
    s.tissue.crossStiffness *= factor;
    s.tissue.muscleStiffness *= factor;
}

// The order is part of the journal's format: a line lists the coordinates in it.
constexpr double kHalfBeat = std::numbers::pi;  // radians of the phase of the beat
constexpr std::array kParameters{
    Parameter{150, 1500, [](const config::Species& s) { return s.tissue.stiffness; }, setStiffness},
    Parameter{0.8,
              4,
              [](const config::Species& s) { return s.tissue.tailStiffening; },
              [](config::Species& s, double v) { s.tissue.tailStiffening = v; }},
    Parameter{0.2,
              12,
              [](const config::Species& s) { return s.tissue.damping; },
              [](config::Species& s, double v) { s.tissue.damping = v; }},
    Parameter{150,
              900,
              [](const config::Species& s) { return s.water.drag; },
              [](config::Species& s, double v) { s.water.drag = v; }},
    Parameter{0.1,
              1,
              [](const config::Species& s) { return s.water.frontFactor; },
              [](config::Species& s, double v) { s.water.frontFactor = v; }},
    Parameter{0.1,
              1,
              [](const config::Species& s) { return s.swim.middleDrive; },
              [](config::Species& s, double v) { s.swim.middleDrive = v; }},
    Parameter{0.2,
              1,
              [](const config::Species& s) { return s.swim.backDrive; },
              [](config::Species& s, double v) { s.swim.backDrive = v; }},
    Parameter{0.35 * kHalfBeat,
              kHalfBeat,
              [](const config::Species& s) { return s.swim.backLagRadians; },
              [](config::Species& s, double v) { s.swim.backLagRadians = v; }},
    Parameter{0.3,
              1.6,
              [](const config::Species& s) { return s.swim.slow.gain; },
              [](config::Species& s, double v) { s.swim.slow.gain = v; }},
    Parameter{0.3,
              1.6,
              [](const config::Species& s) { return s.swim.fast.gain; },
              [](config::Species& s, double v) { s.swim.fast.gain = v; }},
};

}  // namespace

SearchPoint pointOf(const config::Species& species) {
    SearchPoint point;
    for (const Parameter& p : kParameters)
        point.push_back(
            std::clamp(std::log(p.get(species) / p.least) / std::log(p.most / p.least), 0.0, 1.0));
    return point;
}

config::Species speciesAt(const SearchPoint& point, const config::Species& species) {
    assert(point.size() == kParameters.size());
    config::Species changed = species;
    for (std::size_t i = 0; i < kParameters.size(); ++i) {
        const Parameter& p = kParameters.at(i);
        p.set(changed, p.least * std::pow(p.most / p.least, std::clamp(point.at(i), 0.0, 1.0)));
    }
    return changed;
}

config::Species beginningOf(std::uint32_t start, const config::Species& species) {
    assert(start >= 1);
    if (start == 1) return species;
    SearchPoint point;
    for (std::uint32_t i = 0; i < kParameters.size(); ++i)
        point.push_back(static_cast<double>(unitOf(hashOf(start, i))));
    return speciesAt(point, species);
}

namespace {

namespace fs = std::filesystem;

// The journal.

constexpr std::size_t kFigures = 5;  // numbers in a line before the coordinates of the point

std::string lineOf(const SearchTrial& trial) {
    std::ostringstream line;
    line.precision(17);  // enough for each double to be read back exactly
    line << trial.miss << ' ' << trial.leastStrouhal << ' ' << trial.mostStrouhal << ' '
         << trial.leastStride << ' ' << trial.mostStride;
    for (const double coordinate : trial.point) line << ' ' << coordinate;
    return line.str();
}

// Nothing unless lineOf() writes exactly this line for the trial: so any damage is found.
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

// The text up to the last line end; empty when the file does not exist, or is a pipe.
std::string wholeLinesOf(const fs::path& path) {
    std::error_code none;
    if (!fs::is_regular_file(path, none)) return {};
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return text.substr(0, text.rfind('\n') + 1);
}

// The trials of a journal; `path` is for error messages. Throws Error, with the number of the line,
// when the first line is not `search` or a line is not a trial.
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
    assert(search.find('\n') == std::string::npos);
    const std::string before = wholeLinesOf(path_);
    if (!before.empty()) trials_ = parseTrials(before, search, path_);
    file_ = GrowingFile(path_, before.size());
    if (before.empty()) file_.append(search + '\n');
}

void SearchJournal::add(const SearchTrial& trial) {
    file_.append(lineOf(trial) + '\n');
    trials_.push_back(trial);
}

namespace {

// The optimisation.

// Raise it when a change of the simulation, the objective or the parameters changes the trials.
constexpr const char* kSearchVersion = "aquarama search 2";
constexpr double kSwims = 0.01;       // the goal: a miss by a tenth of one tolerance
constexpr double kFirstStep = 0.1;    // of the range of each parameter
constexpr double kDoesNotSwim = 1e6;  // the miss of a fish that finds no steady beat

// One trial. A fish that cannot be simulated there is a very bad trial, not an error.
SearchTrial tryAt(const SearchPoint& point, const config::Species& species) {
    SearchTrial trial{.point = point, .miss = kDoesNotSwim};
    try {
        const ForwardFigures gaits = quickFigures(speciesAt(point, species));
        const auto strouhal = [](const GaitFigures& gait) { return gait.swum.strouhal; };
        const auto stride = [](const GaitFigures& gait) { return gait.swum.strideBodyLengths; };
        trial.miss = missOf(gaits);
        trial.leastStrouhal = strouhal(std::ranges::min(gaits, {}, strouhal));
        trial.mostStrouhal = strouhal(std::ranges::max(gaits, {}, strouhal));
        trial.leastStride = stride(std::ranges::min(gaits, {}, stride));
        trial.mostStride = stride(std::ranges::max(gaits, {}, stride));
    } catch (const Error&) {
    }
    return trial;
}

// Makes trials in the order in which the optimiser asks for them; those that the journal holds are
// read from it. The optimiser is deterministic, so it asks for the same points again. Keeps
// references: the arguments must outlive it.
class TrialRun {
  public:
    TrialRun(const config::Species& species, SearchJournal& journal, const SearchProgress& progress)
        : species_(species), journal_(journal), progress_(progress) {}

    double missAt(const SearchPoint& point) {
        assert(made_ <= journal_.trials().size());
        if (made_ == journal_.trials().size()) journal_.add(tryAt(point, species_));
        const SearchTrial& trial = journal_.trials()[made_++];
        if (trial.point != point)
            throw Error("trial " + std::to_string(made_) +
                        " of the journal is not what this program tries; remove the journal to "
                        "begin anew");
        if (made_ == 1 || trial.miss < best_.miss) best_ = trial;
        progress_(made_, best_);
        return trial.miss;
    }
    [[nodiscard]] const SearchTrial& best() const { return best_; }

  private:
    const config::Species& species_;
    SearchJournal& journal_;
    const SearchProgress& progress_;
    std::size_t made_ = 0;
    SearchTrial best_;
};

}  // namespace

std::string searchName(const std::string& speciesText) {
    return std::string(kSearchVersion) + ' ' + toHex(digestOf(speciesText));
}

SearchTrial searchGaits(const config::Species& species,
                        std::size_t mostTrials,
                        SearchJournal& journal,
                        const SearchProgress& progress) {
    assert(mostTrials >= 1);
    assert(progress);
    TrialRun run(species, journal, progress);
    SearchPoint point = pointOf(species);
    // Subplex, a variant of the Nelder-Mead method: it needs no gradient.
    nlopt::opt optimiser(nlopt::LN_SBPLX, static_cast<unsigned>(point.size()));
    optimiser.set_lower_bounds(0.0);
    optimiser.set_upper_bounds(1.0);
    optimiser.set_initial_step(kFirstStep);
    optimiser.set_maxeval(static_cast<int>(mostTrials));
    optimiser.set_stopval(kSwims);

    // NLopt lets only its own exceptions through. Any other is kept here and thrown again below.
    struct Evaluation {
        TrialRun& run;
        std::exception_ptr failure;
    } evaluation{run, {}};
    const auto evaluate = [](const SearchPoint& at, SearchPoint& /*gradient*/, void* data) {
        auto& e = *static_cast<Evaluation*>(data);
        try {
            return e.run.missAt(at);
        } catch (...) {
            e.failure = std::current_exception();
            throw nlopt::forced_stop();
        }
    };
    optimiser.set_min_objective(evaluate, &evaluation);
    try {
        double miss = 0;
        optimiser.optimize(point, miss);
    } catch (const nlopt::forced_stop&) {
        std::rethrow_exception(evaluation.failure);
    } catch (const nlopt::roundoff_limited&) {
        // Rounding stopped the optimiser: the best trial so far is the result.
    }
    return run.best();
}

namespace {

constexpr std::size_t kEnd = std::string_view::npos;

// Whether a character is part of a name or a number.
bool isWord(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-' ||
           c == '+';
}

// Reads the tokens of protobuf's text format that matter here: words (names and numbers) and
// braces. It skips comments, strings and all other characters. Strings have no escapes in species
// files.
class TextWalk {
  public:
    explicit TextWalk(std::string_view text) : text_(text) {}

    // The next word, "{" or "}"; empty at the end.
    std::string_view next() {
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '#')
                skipTo('\n');
            else if (c == '"') {
                ++at_;
                skipTo('"');
            } else if (c == '{' || c == '}')
                return text_.substr(at_++, 1);
            else if (isWord(c))
                return word();
        }
        return {};
    }
    // The place in the text just after the last token.
    [[nodiscard]] std::size_t position() const { return at_; }

  private:
    void skipTo(char end) {
        at_ = text_.find(end, at_);
        if (at_ == kEnd) at_ = text_.size();
    }
    std::string_view word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && isWord(text_[at_])) ++at_;
        return text_.substr(begin, at_ - begin);
    }

    std::string_view text_;  // must outlive the walk
    std::size_t at_ = 0;
};

std::string written(double value) {
    std::ostringstream number;
    number.precision(4);
    number << value;
    return number.str();
}

}  // namespace

std::string withNumber(const std::string& text,
                       const std::vector<std::string>& field,
                       double value) {
    assert(!field.empty());
    TextWalk walk(text);
    // The names of the open messages, and at the end the last word read: where it equals `field`,
    // the next token is the value.
    std::vector<std::string> path{""};
    for (std::string_view token = walk.next(); !token.empty(); token = walk.next()) {
        if (token == "{")
            path.emplace_back();
        else if (token == "}") {
            if (path.size() > 1) path.pop_back();
        } else
            path.back() = token;
        if (path != field) continue;
        const std::string_view old = walk.next();
        return std::string(text).replace(walk.position() - old.size(), old.size(), written(value));
    }
    throw Error(
        "the species file has no field " +
        std::accumulate(field.begin() + 1,
                        field.end(),
                        field.front(),
                        [](const std::string& a, const std::string& b) { return a + '.' + b; }));
}

std::string withGaitsOf(const config::Species& species, std::string text) {
    const auto& [tissue, water, swim] = std::tie(species.tissue, species.water, species.swim);
    const auto set = [&](const std::vector<std::string>& field, double value) {
        text = withNumber(text, field, value);
    };
    set({"tissue", "stiffness"}, tissue.stiffness);
    set({"tissue", "cross_stiffness"}, tissue.crossStiffness);
    set({"tissue", "muscle_stiffness"}, tissue.muscleStiffness);
    set({"tissue", "tail_stiffening"}, tissue.tailStiffening);
    set({"tissue", "damping"}, tissue.damping);
    set({"water", "drag"}, water.drag);
    set({"water", "front_factor"}, water.frontFactor);
    set({"swim", "middle_drive"}, swim.middleDrive);
    set({"swim", "back_drive"}, swim.backDrive);
    set({"swim", "back_lag_deg"}, swim.backLagRadians * 180 / std::numbers::pi);
    set({"swim", "slow", "gain"}, swim.slow.gain);
    set({"swim", "fast", "gain"}, swim.fast.gain);
    set({"turn", "gradual", "strength"}, species.turn.gradual.strength);
    set({"turn", "sharp", "strength"}, species.turn.sharp.strength);
    return text;
}

}  // namespace aquarama::capture
