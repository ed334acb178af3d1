// SPDX-License-Identifier: Apache-2.0
// A line of times for each frame that was presented: frame,state_ns,ready_ns,present_ns.
#pragma once

#include <chrono>
#include <fstream>
#include <string>

#include "common/units/ids.h"

namespace aquarama::show {

// On CLOCK_MONOTONIC, which all processes of a machine share.
struct FrameTimes {
    std::chrono::nanoseconds state{};    // its state arrived
    std::chrono::nanoseconds ready{};    // its picture was finished
    std::chrono::nanoseconds present{};  // the swap had returned; without a display, the release
};

class Trace {
  public:
    // folder/name.csv, begun anew; an empty folder writes nothing. Throws Error where it cannot be
    // written.
    Trace(const std::string& folder, const std::string& name);
    void write(Frame frame, const FrameTimes& times);

  private:
    std::ofstream file_;
};

}  // namespace aquarama::show
