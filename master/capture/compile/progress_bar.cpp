// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/progress_bar.h"

#include <iostream>
#include <utility>

#include <unistd.h>

namespace aquarama::capture {

namespace {

constexpr int kCells = 40;
constexpr const char* kEraseRest = "\033[K";  // of the line

}  // namespace

ProgressBar::ProgressBar(std::string what)
    : what_(std::move(what)), isTerminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
    if (shown_ >= 0 && shown_ < 100) std::cerr << '\n';  // it was broken off
}

void ProgressBar::show(double share, const std::string& note) {
    const int percent = static_cast<int>(share * 100 + 1e-6);
    if (!isTerminal_ || (percent == shown_ && note == note_)) return;
    const bool isLast = percent == 100 && shown_ < 100;
    shown_ = percent;
    note_ = note;
    const auto filled = static_cast<std::size_t>(percent * kCells / 100);
    std::cerr << '\r' << what_ << " [" << std::string(filled, '#')
              << std::string(kCells - filled, '.') << "] " << percent << " %  " << note
              << kEraseRest;
    if (isLast) std::cerr << '\n';
    std::cerr.flush();
}

}  // namespace aquarama::capture
