// SPDX-License-Identifier: Apache-2.0
// `aquarama tour`: leads through a new hall, step by step.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "commands/commands.h"
#include "commands/tour_record.h"
#include "commands/tour_steps.h"
#include "common/ask/request_client.h"
#include "common/base/amounts.h"
#include "common/base/counted.h"
#include "common/base/dates.h"
#include "common/base/log.h"
#include "common/cli/command_line.h"
#include "common/cli/keyboard.h"
#include "common/cli/outputs.h"

namespace aquarama {

namespace {

struct TourOptions {
    std::string rig;
    std::string step;    // that is repeated; empty: all that are to be done
    std::string backup;  // folder; empty: as it was named before
    bool isList = false;
    bool isJson = false;
    std::string confirmed;  // the step whose finding is right; empty: none
    std::string found;      // that finding
};

// What somebody answers to a step.
enum class Answer : std::uint8_t { Yes, Next, Leave };

// Answers by keys of the terminal, or by lines of another input. A signal, Ctrl-C and the end of
// the input mean to leave.
class Answers {
  public:
    // Returns when there is an answer.
    Answer await() {
        while (!isOver_) {
            if (pending_.empty() && !keyboard_.read(pending_, kBetweenLooks)) break;
            if (pending_.empty()) continue;
            const char key = std::exchange(pending_, pending_.substr(1))[0];
            if (key == '\n' || key == '\r') return Answer::Yes;
            if (key == 'q' || key == kInterrupt) break;
            if (key != 'n') continue;
            if (pending_.starts_with('\n')) pending_.erase(0, 1);
            return Answer::Next;
        }
        return Answer::Leave;
    }

  private:
    static constexpr auto kBetweenLooks = std::chrono::milliseconds(200);
    static constexpr char kInterrupt = '\x03';  // Ctrl-C

    cli::Keyboard keyboard_;
    std::string pending_;  // keys that were not looked at yet
    std::atomic<bool> isOver_ = false;
    cli::SignalWatch signals_{[this] { isOver_ = true; }};  // the last: it uses the others
};

void showPattern(const std::string& rigPath, v1::WantedShow::Shown shown) {
    v1::Order order;
    order.mutable_show()->set_pattern(shown);
    const ask::AskedMaster asked{.rig = rigPath, .address = {}, .key = {}};
    asked.connect().carryOut(std::move(order), [](const std::string&) {});
}

// The grid on the wall, as long as this object lives; then the world.
class GridOnWall {
  public:
    // Throws Error where the show refuses it.
    explicit GridOnWall(std::string rigPath) : rigPath_{std::move(rigPath)} {
        showPattern(rigPath_, v1::WantedShow::GRID);
    }
    ~GridOnWall() {
        try {
            showPattern(rigPath_, v1::WantedShow::WORLD);
        } catch (const Error& problem) {
            logWarning("{}; the wall may show the grid: aquarama set {} pattern world",
                       problem.what(),
                       rigPath_);
        }
    }
    GridOnWall(const GridOnWall&) = delete;
    GridOnWall& operator=(const GridOnWall&) = delete;

  private:
    std::string rigPath_;
};

// The tour of one hall. What it finds is on the disk after each look at a step.
class Tour {
  public:
    explicit Tour(const TourOptions& options)
        : rig_{options.rig}, file_{tourFileOf(options.rig)}, record_{readTour(file_)} {
        if (options.backup.empty()) return;
        update([&](TourRecord& record) {
            record.backupFolder = std::filesystem::absolute(options.backup).string();
            record.backupWrittenAt = 0;
        });
    }

    // The hall as it is now.
    [[nodiscard]] TourView look() const { return lookAround(rig_, record_); }

    // Prints a line for each step. Returns whether all are done.
    [[nodiscard]] bool list(const TourView& view) const {
        std::size_t count = 0;
        for (const TourStep& step : tourSteps()) {
            const StepFinding finding = findingOf(step, view);
            count += finding.state == StepState::Done ? 1 : 0;
            sayLine(step, finding);
        }
        cli::say(fmt::format("{} of {} done, {} so far",
                             count,
                             counted(tourSteps().size(), "step"),
                             durationOf(secondsInAll())));
        return count == tourSteps().size();
    }

    // The same for a program. It counts as a look at the first step that is to be done.
    [[nodiscard]] bool listForProgram(const TourView& view) {
        nlohmann::json steps = nlohmann::json::array();
        bool isAhead = false;  // something before is to be done
        for (const TourStep& step : tourSteps()) {
            const StepFinding finding = findingOf(step, view);
            const bool isDone = finding.state == StepState::Done;
            if (!isAhead) note(step, view, isDone);
            isAhead = isAhead || !isDone;
            steps.push_back({{"name", step.name},
                             {"state", nameOf(finding.state)},
                             {"found", finding.what},
                             {"todo", finding.todo},
                             {"seconds", record_.steps[step.name].seconds}});
        }
        cli::say(nlohmann::json{{"steps", steps}, {"seconds", secondsInAll()}}.dump());
        return !isAhead;
    }

    // Somebody in the hall says that a finding is right. Throws Error where the step has found
    // something else by now, or needs nobody.
    void confirm(const std::string& name, const std::string& found) {
        const auto step = std::ranges::find(tourSteps(), name, &TourStep::name);
        const StepFinding finding = findingOf(*step, look());
        if (finding.state != StepState::ToConfirm || finding.what != found)
            throw Error(name + ": has found by now: " + finding.what + "; look again");
        update([&](TourRecord& record) {
            record.steps[name].confirmed = found;
            noteLook(record.steps[name], systemSeconds(), true);
        });
    }

    // Goes through all steps that are not done, in their order, until somebody leaves. `view`: the
    // hall at the beginning.
    void walk(TourView view) {
        Answers answers;
        for (const TourStep& step : tourSteps()) {
            if (findingOf(step, view).state == StepState::Done) {
                note(step, view, true);
                continue;
            }
            if (work(step, answers) == Answer::Leave) return;
            view = look();
        }
    }

    // One step anew. Returns whether it is done.
    bool repeat(const std::string& name) {
        Answers answers;
        const auto step = std::ranges::find(tourSteps(), name, &TourStep::name);
        update([&](TourRecord& record) { record.steps[name] = {}; });
        work(*step, answers);
        return record_.steps[name].doneAt > 0;
    }

  private:
    // Asks until the step is done, or somebody wants to go on or leave. Yes: it is done.
    Answer work(const TourStep& step, Answers& answers) {
        cli::say(fmt::format("\n{}: {}", step.name, step.aim));
        for (;;) {
            const TourView view = look();
            const StepFinding finding = findingOf(step, view);
            note(step, view, finding.state == StepState::Done);
            sayFinding(step, finding);
            if (finding.state == StepState::Done) return Answer::Yes;
            const Answer answer = ask(step, finding, answers);
            update([&](TourRecord& record) {
                if (answer == Answer::Yes && finding.state == StepState::ToConfirm)
                    record.steps[step.name].confirmed = finding.what;
                if (answer == Answer::Next) record.steps[step.name].lookedAt = 0;
            });
            if (answer != Answer::Yes) return answer;
        }
    }

    Answer ask(const TourStep& step, const StepFinding& finding, Answers& answers) const {
        if (!step.showsGrid || finding.state != StepState::ToConfirm) return answers.await();
        const GridOnWall grid(rig_);
        return answers.await();
    }

    // Changes what is on the disk now: the console may look at the same hall.
    void update(const std::function<void(TourRecord&)>& change) {
        record_ = readTour(file_);
        change(record_);
        keepTour(file_, record_);
    }

    void note(const TourStep& step, const TourView& view, bool isDone) {
        update([&](TourRecord& record) {
            record.backupWrittenAt = std::max(record.backupWrittenAt, view.backup.writtenAt);
            noteLook(record.steps[step.name], systemSeconds(), isDone);
        });
    }

    // "[x] 3 channels      2 min  left on left-pc"
    void sayLine(const TourStep& step, const StepFinding& finding) const {
        const auto kept = record_.steps.find(step.name);
        const StepRecord record = kept == record_.steps.end() ? StepRecord{} : kept->second;
        const auto number = &step - tourSteps().data() + 1;
        cli::say(fmt::format("[{}] {} {:<11} {:>7}  {}",
                             finding.state == StepState::Done ? 'x' : ' ',
                             number,
                             step.name,
                             record.lookedAt > 0 ? durationOf(record.seconds) : "",
                             finding.what));
    }

    void sayFinding(const TourStep& step, const StepFinding& finding) {
        cli::say("  found  " + finding.what);
        if (finding.state == StepState::Done)
            return cli::say("  done   after " + durationOf(record_.steps[step.name].seconds));
        cli::say("  to do  " + finding.todo);
        cli::say(std::string("  Enter: ") +
                 (finding.state == StepState::ToConfirm ? "it is right" : "look again") +
                 "; n: the next step; q: leave, and go on another time");
    }

    [[nodiscard]] double secondsInAll() const {
        double sum = 0;
        for (const auto& [name, step] : record_.steps) sum += step.seconds;
        return sum;
    }

    std::string rig_;
    std::filesystem::path file_;
    TourRecord record_;
};

// Exit status 1 where something is to be done.
int tour(const TourOptions& options) {
    Tour tour(options);
    if (!options.confirmed.empty()) {
        tour.confirm(options.confirmed, options.found);
        return 0;
    }
    if (options.isJson) return tour.listForProgram(tour.look()) ? 0 : 1;
    if (options.isList) return tour.list(tour.look()) ? 0 : 1;
    cli::holdSignals();
    if (!options.step.empty()) return tour.repeat(options.step) ? 0 : 1;
    TourView view = tour.look();
    if (tour.list(view)) return 0;
    tour.walk(std::move(view));
    cli::say("");
    return tour.list(tour.look()) ? 0 : 1;
}

std::vector<std::string> namesOfSteps() {
    std::vector<std::string> names;
    for (const TourStep& step : tourSteps()) names.emplace_back(step.name);
    return names;
}

}  // namespace

void addTour(CommandLine& line) {
    const auto [command, options] = line.add<TourOptions>(
        "tour", "lead through a new hall: screen, machines, doctor, calibration ...", tour);
    command.add_option("RIG", options.rig, "the rig of the hall")->required();
    CLI::Option* step = command.add_option("--step", options.step, "repeat this one alone")
                            ->check(CLI::IsMember(namesOfSteps()));
    command.add_option(
        "--backup", options.backup, "folder for a copy of the hall, on a stick; is remembered");
    command.add_flag("--list", options.isList, "print all steps, and end")->excludes(step);
    command.add_flag("--json", options.isJson, "the same for a program")->excludes(step);
    CLI::Option* found =
        command.add_option("--found", options.found, "what the step that is confirmed has found");
    CLI::Option* confirmed =
        command.add_option("--confirm", options.confirmed, "the finding of this step is right")
            ->check(CLI::IsMember(namesOfSteps()))
            ->needs(found);
    found->needs(confirmed);
    command.footer(
        "Each step says what it found and what to do. q leaves; the next call goes on at the first "
        "step that is not done.\nThe exit status is 1 while something is to be done.");
}

}  // namespace aquarama
