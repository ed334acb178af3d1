// SPDX-License-Identifier: Apache-2.0
// How a show that fails says why in one line: its processes tell the supervisor instead of stderr,
// and the supervisor prints what was said first. Everything else that they write passes unhindered.
#pragma once

#include <string>
#include <vector>

namespace aquarama::cli {

// The supervisor's end. Every child that is started while it exists tells it.
class Causes {
  public:
    Causes();  // throws Error where there can be no pipe
    ~Causes();
    Causes(const Causes&) = delete;
    Causes& operator=(const Causes&) = delete;
    // What was said since the last call, the first first.
    [[nodiscard]] std::vector<std::string> heard() const;

  private:
    int reading_ = -1;
    int writing_ = -1;
};

// A child's end. False where no supervisor waits for it.
[[nodiscard]] bool tellSupervisor(const std::string& line);

}  // namespace aquarama::cli
