// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/progress_bar.h"

#include <iostream>
#include <utility>

#include <unistd.h>

namespace aquarama {

namespace {

constexpr int kCells = 40;

}  // namespace

ProgressBar::ProgressBar(std::string what)
    : what_(std::move(what)), isTerminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
    if (isTerminal_ && shown_ >= 0 && shown_ < 100) std::cerr << '\n';  // it was broken off
}

void ProgressBar::show(double share) {
    const int percent = static_cast<int>(share * 100 + 1e-6);
    if (percent == shown_) return;
    const bool isFirst = shown_ < 0;
    shown_ = percent;
    if (isTerminal_) {
        const auto filled = static_cast<std::size_t>(percent * kCells / 100);
        std::cerr << '\r' << what_ << " [" << std::string(filled, '#')
                  << std::string(kCells - filled, '.') << "] " << percent << " %";
        if (percent == 100) std::cerr << '\n';
        std::cerr.flush();
    } else if (isFirst || percent == 100) {
        std::cerr << what_ << (percent == 100 ? ": done\n" : " ...\n");
    }
}

}  // namespace aquarama
