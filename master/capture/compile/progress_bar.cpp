// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/progress_bar.h"

#include <iostream>
#include <utility>

#include <unistd.h>

namespace aquarama {

namespace {

constexpr int kCells = 40;
constexpr const char* kEraseRest = "\033[K";  // of the line

}  // namespace

ProgressBar::ProgressBar(std::string what)
    : what_(std::move(what)), isTerminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
    if (isTerminal_ && shown_ >= 0 && shown_ < 100) std::cerr << '\n';  // it was broken off
}

void ProgressBar::show(double share, const std::string& note) {
    const int percent = static_cast<int>(share * 100 + 1e-6);
    if (percent == shown_ && note == note_) return;
    const bool isFirst = shown_ < 0;
    const bool isLast = percent == 100 && shown_ < 100;
    shown_ = percent;
    note_ = note;
    if (isTerminal_) {
        const auto filled = static_cast<std::size_t>(percent * kCells / 100);
        std::cerr << '\r' << what_ << " [" << std::string(filled, '#')
                  << std::string(kCells - filled, '.') << "] " << percent << " %  " << note
                  << kEraseRest;
        if (isLast) std::cerr << '\n';
        std::cerr.flush();
    } else if (isFirst || isLast) {
        std::cerr << what_ << (isLast ? ": done\n" : " ...\n");
    }
}

}  // namespace aquarama
