// SPDX-License-Identifier: Apache-2.0
// Shows the progress of one job as a bar on a terminal. Elsewhere nothing: stderr is for errors.
#pragma once

#include <string>

namespace aquarama::capture {

class ProgressBar {
  public:
    explicit ProgressBar(std::string what);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ProgressBar(ProgressBar&&) = delete;
    ProgressBar& operator=(ProgressBar&&) = delete;
    // 0 to 1, and on a terminal a note behind the bar.
    void show(double share, const std::string& note = "");

  private:
    std::string what_;
    bool isTerminal_;
    int shown_ = -1;  // per cent
    std::string note_;
};

}  // namespace aquarama::capture
