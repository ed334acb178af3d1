// SPDX-License-Identifier: Apache-2.0
// The commands of a program: their options are declared, and the chosen one is run.
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "common/cli/command_line.h"

namespace aquarama::cli {

// A command that was added, for the description of its options; both live as long as the
// CommandLine.
template <class Options>
struct AddedCommand {
    CLI::App& app;
    Options& options;
};

// Commands are added to a program's command line; then it runs the chosen one.
class CommandLine {
  public:
    explicit CommandLine(CLI::App& app) : app_{app} {}
    // Sets the heading, in the program's help, of the commands that are added next.
    void startGroup(std::string heading) { heading_ = std::move(heading); }
    // Adds a command. `run(options)` carries it out and returns the exit status, or nothing for 0.
    template <class Options, class Run>
    AddedCommand<Options> add(const std::string& name, const std::string& what, Run run) {
        const auto added = addTo<Options>(app_, name, what, std::move(run));
        added.app.group(heading_);
        return added;
    }
    // The help does not list this command.
    void hide(const std::string& name) { app_.get_subcommand(name)->group(""); }
    // Adds a command of the command `parent`.
    template <class Options, class Run>
    AddedCommand<Options> addTo(CLI::App& parent,
                                const std::string& name,
                                const std::string& what,
                                Run run) {
        auto options = std::make_shared<Options>();
        CLI::App& command = *parent.add_subcommand(name, what);
        command.callback([this, options, run = std::move(run)] {
            if (job_) return;  // by a nested command: CLI11 calls the innermost first
            job_ = [options, run] {
                if constexpr (std::is_void_v<std::invoke_result_t<Run, const Options&>>) {
                    run(*options);
                    return 0;
                } else {
                    return run(*options);
                }
            };
        });
        return {command, *options};
    }
    [[nodiscard]] bool isChosen() const { return job_ != nullptr; }
    // Runs the chosen command; returns the exit status. Throws CLI::RequiredError without one.
    [[nodiscard]] int runChosen() const {
        if (!job_) throw CLI::RequiredError("a command");
        return job_();
    }

  private:
    CLI::App& app_;
    std::string heading_ = "Subcommands";
    Job job_;
};

}  // namespace aquarama::cli
