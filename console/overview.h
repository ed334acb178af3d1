// SPDX-License-Identifier: Apache-2.0
// What browsers are told of the wall, from what the master says of it: pure functions and rings.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "common/wire/messages.h"
#include "console/access.h"
#include "console/alerts.h"
#include "console/console.pb.h"

namespace aquarama::console {

// A wall whose master has just answered, with the cause for each node. `run`: of that master.
[[nodiscard]] browser::Wall wallOf(const v1::StatusReply& status, std::uint64_t run);

// Whether the master answers and all nodes are in step.
[[nodiscard]] bool isInStep(const browser::Wall& wall);

// What is wrong with a wall that was heard of at wall.heard_s; `now` as there. `build`: of the
// console; a node of another build is a fault.
[[nodiscard]] std::vector<Fault> faultsOf(const browser::Wall& wall,
                                          const std::string& build,
                                          UnixSeconds now);
// What is wrong with projectors, as far as they tell: of what is unknown nothing is said.
[[nodiscard]] std::vector<Fault> faultsOf(const browser::ProjectorList& projectors);

// What has changed between two looks at a wall, as an operator would say it.
[[nodiscard]] std::vector<std::string> changesOf(const browser::Wall& before,
                                                 const browser::Wall& after);

// The faders of a wall, as the list of events has them: where they have come to rest.
class FaderWatch {
  public:
    // A line for each that rests elsewhere than was last told. `now`: seconds of a clock that never
    // goes back.
    std::vector<std::string> update(const browser::Wall& wall, double now);

  private:
    // Shares, 0 to 1.
    struct Values {
        float brightness = 1, colour = 0;
        friend bool operator==(const Values&, const Values&) = default;
    };

    std::uint64_t run_ = 0;  // of the master; 0: none was heard
    std::string scene_;
    Values seen_, told_;
    double movedAt_ = 0;
};

// Figures of the last ten minutes by tenths of a second, and of the last day by the minute (its
// largest).
class FigureRings {
  public:
    // Ten times a second.
    void add(const browser::Wall& wall);
    // All of them, or what is newer than a second.
    [[nodiscard]] browser::History history() const;
    [[nodiscard]] browser::History lastSecond() const;

  private:
    struct Ring {
        std::deque<std::uint16_t> tenths, minutes;  // as Series.values has them
        std::uint16_t largest = 0;                  // of the minute under way
    };
    void add(const std::string& name, float ms, bool isHeard);
    [[nodiscard]] browser::History newest(std::size_t tenths, std::size_t minutes) const;

    std::map<std::string, Ring> rings_;
    std::uint32_t tenths_ = 0;  // since the start
};

// What projectors have come to, as the list of events has it: what holds for a while.
class ProjectorBook {
  public:
    // A line, name and what, for each that is otherwise than was last told.
    std::vector<std::pair<std::string, std::string>> update(const browser::ProjectorList& list,
                                                            UnixSeconds now);

  private:
    struct Page {
        std::string told, seen;
        UnixSeconds since = 0;  // it is as it was seen
    };
    [[nodiscard]] bool isNews(const browser::ProjectorState& one, UnixSeconds now);

    std::map<std::string, Page> pages_;  // by name
};

// protobuf's JSON, numbers that are zero included.
[[nodiscard]] std::string jsonOf(const browser::ToBrowser& message);
// Empty where the text is malformed, has unknown fields, or exceeds a bound.
[[nodiscard]] std::optional<browser::FromBrowser> readBrowser(const std::string& text);
// The same of an order, which names neither a number nor a run unless it wants to.
[[nodiscard]] std::optional<v1::Order> readOrder(const std::string& text);

}  // namespace aquarama::console
