// SPDX-License-Identifier: Apache-2.0
// The progress of a long job, on one line of a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

namespace aquarama::cli {

// Not synchronised: one thread at a time calls it. The line is written to stderr, and only where
// that is a terminal: a log has no use for it.
class Progress {
  public:
    // `what` names the job. `ofAll`: how many steps it has, for count(); 0 where that is not known.
    explicit Progress(std::string what, std::uint64_t ofAll = 0)
        : what_{std::move(what)}, ofAll_{ofAll} {}
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    Progress(Progress&&) = delete;
    Progress& operator=(Progress&&) = delete;

    // Shows a bar for a share from 0 to 1, and a note behind it. The bar stays when it is full.
    void show(double share, const std::string& note = "");
    // Shows how many steps are done, how many a second, and the time left. Without a terminal it
    // writes a line to standard output every ten seconds.
    void count(std::uint64_t done);
    // Removes the line of count().
    void end();

  private:
    using Clock = std::chrono::steady_clock;
    void draw(const std::string& line);
    [[nodiscard]] std::string counted(std::uint64_t done, Clock::time_point now) const;

    std::string what_;
    std::uint64_t ofAll_;
    bool isTerminal_ = isTerminal();
    bool isOpen_ = false;  // the terminal has a line that does not end
    std::string drawn_;
    Clock::time_point begun_ = Clock::now(), counted_ = begun_;

    static bool isTerminal();
};

}  // namespace aquarama::cli
