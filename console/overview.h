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

// `build`: of the console, against which those of the nodes are held.
[[nodiscard]] browser::Wall wallOf(const v1::StatusReply& status,
                                   std::uint64_t run,
                                   const std::string& build);

// What is wrong with a wall that was heard of at wall.heard_s; `now` as there.
[[nodiscard]] std::vector<Fault> faultsOf(const browser::Wall& wall, UnixSeconds now);

// What has changed between two looks at a wall, as an operator would say it.
[[nodiscard]] std::vector<std::string> changesOf(const browser::Wall& before,
                                                 const browser::Wall& after);

// Figures of the last ten minutes by the second, and of the last day by the minute (its largest).
class FigureRings {
  public:
    // Once a second.
    void add(const browser::Wall& wall);
    [[nodiscard]] browser::History history() const;

  private:
    struct Ring {
        std::deque<float> seconds, minutes;
        float largest = 0;  // of the minute under way
    };
    void add(const std::string& name, float value);

    std::map<std::string, Ring> rings_;
    int secondsOfMinute_ = 0;
};

// For Prometheus, text format 0.0.4.
[[nodiscard]] std::string metricsOf(const browser::Wall& wall, std::uint64_t cutOff);

// protobuf's JSON, numbers that are zero included.
[[nodiscard]] std::string jsonOf(const browser::ToBrowser& message);
// Empty where the text is malformed, has unknown fields, or exceeds a bound.
[[nodiscard]] std::optional<browser::FromBrowser> readBrowser(const std::string& text);

}  // namespace aquarama::console
