// SPDX-License-Identifier: Apache-2.0
// How long the graphics card works on each stage of a frame (gl::Stage), by its own clock, and how
// long this process does.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace aquarama::bench {

// Milliseconds.
struct StageTime {
    double gpu = 0;
    double cpu = 0;  // of all threads, those of the driver too
};

// While it lives, stages of the current context are marked by timestamps. One at a time.
class StageClock {
  public:
    StageClock();
    ~StageClock();
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;

    // A frame: what is drawn between the two.
    void begin();
    // Waits for the card. Milliseconds by stage, without the stages inside; "other" is what is in
    // none. The sum is the whole frame.
    [[nodiscard]] std::map<std::string, StageTime> end();

    void enter(const char* stage);
    void leave();

  private:
    void mark();

    struct Mark {
        unsigned query = 0;
        std::string stage;  // that goes on from here
        double cpuMs = 0;   // since the process began
    };
    std::vector<unsigned> queries_;
    std::vector<Mark> marks_;
    std::vector<std::string> open_;
};

}  // namespace aquarama::bench
