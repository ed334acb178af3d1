// SPDX-License-Identifier: Apache-2.0
// What the driver has to say about our mistakes, and what we tell those who look into a frame.
#pragma once

namespace aquarama::gl {

// Writes the driver's errors and warnings to the log from now on, for the current context.
void logMessages();

// A stage of the frame, to the end of the scope: debuggers and profilers of graphics show it by its
// name, and tests/bench/gpu takes its time.
class Stage {
  public:
    explicit Stage(const char* name);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
};

}  // namespace aquarama::gl
