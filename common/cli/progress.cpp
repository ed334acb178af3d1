// SPDX-License-Identifier: Apache-2.0
#include "common/cli/progress.h"

#include <algorithm>
#include <cassert>
#include <iostream>

#include <fmt/format.h>
#include <unistd.h>

#include "common/cli/outputs.h"

namespace aquarama::cli {

bool Progress::isTerminal() {
    return isatty(STDERR_FILENO) != 0;
}

// A job that did not end leaves its line; the next message begins on a line of its own.
Progress::~Progress() {
    if (isOpen_) std::cerr << '\n';
}

void Progress::draw(const std::string& line) {
    if (line == drawn_) return;
    std::cerr << '\r' << line << "\x1b[K" << std::flush;
    drawn_ = line;
    isOpen_ = true;
}

void Progress::show(double share, const std::string& note) {
    constexpr int kCells = 40;  // between the brackets
    assert(share >= 0);
    assert(share <= 1);
    if (!isTerminal_) return;
    // The small term keeps rounding from showing 99 % for a share of 1.
    const int percent = static_cast<int>(share * 100 + 1e-6);
    const auto filled = static_cast<std::size_t>(percent * kCells / 100);
    draw(fmt::format(
        "{} [{:.<{}}] {} %  {}", what_, std::string(filled, '#'), kCells, percent, note));
    if (percent < 100) return;
    if (isOpen_) std::cerr << std::endl;
    isOpen_ = false;
}

void Progress::count(std::uint64_t done) {
    using namespace std::chrono_literals;
    const auto now = Clock::now();
    if (now - counted_ < (isTerminal_ ? 250ms : 10s)) return;
    counted_ = now;
    if (isTerminal_)
        draw(counted(done, now));
    else
        say(counted(done, now));
}

std::string Progress::counted(std::uint64_t done, Clock::time_point now) const {
    const double rate =
        static_cast<double>(done) / std::chrono::duration<double>(now - begun_).count();
    const std::string pace = rate < 1 && done > 0 ? fmt::format("{:.0f} s each", 1 / rate)
                                                  : fmt::format("{:.1f} a second", rate);
    if (ofAll_ == 0) return fmt::format("{} {}, {}", what_, done, pace);
    return fmt::format("{} {} of {}, {}, {:.0f} s left",
                       what_,
                       done,
                       ofAll_,
                       pace,
                       static_cast<double>(ofAll_ - std::min(done, ofAll_)) / rate);
}

void Progress::end() {
    if (isOpen_) std::cerr << "\r\x1b[K" << std::flush;
    isOpen_ = false;
}

}  // namespace aquarama::cli
