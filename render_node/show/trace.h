// SPDX-License-Identifier: Apache-2.0
// A file of the times of each frame that a node has shown.
#pragma once

#include <string>

#include "common/base/output_file.h"
#include "common/base/units.h"
#include "common/net/clock.h"

namespace aquarama::show {

// The times of one frame. All processes of a machine share their clock.
struct FrameTimes {
    // When its state arrived.
    net::Moment state{};
    // When its picture was finished.
    net::Moment ready{};
    // When the swap had returned; without a display, when the frame was released.
    net::Moment present{};
};

// Writes a line for each frame that was presented: frame,state_ns,ready_ns,present_ns.
class Trace {
  public:
    // Creates folder/name.csv, or empties it; an empty folder means that nothing is written. Throws
    // Error where it cannot be written.
    Trace(const std::string& folder, const std::string& name);
    // Appends a line, which a reader sees at once. A disk that is full ends the trace, not the
    // show.
    void write(Frame frame, const FrameTimes& times);
    // Throws Error where a line could not be written.
    void close() { file_.close(); }

  private:
    GrowingFile file_;
};

}  // namespace aquarama::show
