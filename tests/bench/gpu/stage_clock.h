// SPDX-License-Identifier: Apache-2.0
// How long the graphics card works on each stage of a frame (gl::Stage), by its own clock, and how
// long this process does.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace aquarama::bench {

// What a stage gave the card to do, as pipeline statistics have it.
struct StageWork {
    std::uint64_t vertices = 0;    // invocations of vertex shaders
    std::uint64_t primitives = 0;  // triangles and points that clipping left
    std::uint64_t fragments = 0;   // invocations of fragment shaders
    std::uint64_t computed = 0;    // invocations of compute shaders

    StageWork& operator+=(const StageWork& other);
};

// Milliseconds.
struct StageTime {
    double gpu = 0;
    double cpu = 0;  // of all threads, those of the driver too
    StageWork work;
};

// How a stage ends. Software draws after it has answered what the time is, so it is made to finish
// each stage, which takes a little longer than a frame that is finished once.
enum class Clocked : std::uint8_t { Queued, Finished };

// While it lives, stages of the current context are marked by timestamps. One at a time.
class StageClock {
  public:
    explicit StageClock(Clocked clocked);
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
    void endCounting() const;

    struct Mark {
        // Of the time here, and of what is drawn from here to the next mark.
        std::array<unsigned, 5> queries{};
        std::string stage;  // that goes on from here
        double cpuMs = 0;   // since the process began
    };
    Clocked clocked_;
    std::vector<std::array<unsigned, 5>> queries_;
    std::vector<Mark> marks_;
    std::vector<std::string> open_;
};

}  // namespace aquarama::bench
