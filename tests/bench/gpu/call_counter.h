// SPDX-License-Identifier: Apache-2.0
// What the calls of a frame give a card to do, by the stage (gl::Stage) and the program that make
// them. Without times: on software OpenGL they tell what a card would have to do.
#pragma once

#include <array>
#include <compare>
#include <map>
#include <string>
#include <vector>

#include "tests/bench/gpu/shader_log.h"
#include "tests/bench/gpu/stage_clock.h"

namespace aquarama::bench {

struct CallKind {
    std::string stage;      // "other" where there is none
    std::string program;    // its label; "copy", "mipmaps" or "upload" where no program is used
    int targetSamples = 0;  // of a pixel that is drawn into, or copied; 0: there is none
    int pixelBytes = 0;     // of a sample: its colour, or its depth where there is no colour

    auto operator<=>(const CallKind&) const = default;
};

struct CallWork {
    std::uint64_t calls = 0;
    StageWork work;
    std::uint64_t samples = 0;  // that the depth test let through
    std::uint64_t bytes =
        0;  // that copies, mipmaps and uploads read and write; of draws they are not counted

    CallWork& operator+=(const CallWork& other);
};

using CallCounts = std::map<CallKind, CallWork>;

// While it lives, draws and dispatches of the current context are counted, and the log is told
// which program was used. One at a time, and not beside a StageClock.
class CallCounter {
  public:
    explicit CallCounter(ShaderLog& log);
    ~CallCounter();
    CallCounter(const CallCounter&) = delete;
    CallCounter& operator=(const CallCounter&) = delete;

    // Since the last call of it; waits for the card.
    [[nodiscard]] CallCounts take();

    // For the functions that stand in for those of OpenGL.
    void enter(const char* stage) { open_.emplace_back(stage); }
    void leave() { open_.pop_back(); }
    template <class Call>
    void count(const Call& call);
    void addBytes(const char* what, std::uint64_t bytes, int samples = 0);

  private:
    using Queries = std::array<unsigned, 5>;
    struct Counted {
        CallKind kind;
        Queries queries{};
    };

    [[nodiscard]] std::string stage() const { return open_.empty() ? "other" : open_.back(); }
    [[nodiscard]] Queries freeQueries();

    ShaderLog& log_;
    std::vector<std::string> open_;
    std::vector<Queries> queries_;  // the first counted_.size() are in use
    std::vector<Counted> counted_;
    CallCounts bytes_;
};

}  // namespace aquarama::bench
