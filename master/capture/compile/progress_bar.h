// SPDX-License-Identifier: Apache-2.0
// Shows the progress of one job on stderr: a bar on a terminal, a plain line elsewhere.
#pragma once

#include <string>

namespace aquarama {

class ProgressBar {
  public:
    explicit ProgressBar(std::string what);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ProgressBar(ProgressBar&&) = delete;
    ProgressBar& operator=(ProgressBar&&) = delete;
    void show(double share);  // 0 to 1

  private:
    std::string what_;
    bool isTerminal_;
    int shown_ = -1;  // per cent
};

}  // namespace aquarama
