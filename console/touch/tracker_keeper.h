// SPDX-License-Identifier: Apache-2.0
// The tracker of a rig as the console hears it: as soon as its port can be had, and not while
// `aquarama touch` asks for that.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "common/base/wall_hands.h"
#include "common/config/rig.h"
#include "console/cues/touch_listener.h"

namespace aquarama::console {

// Of the server's thread.
class TrackerKeeper {
  public:
    // Of a rig and its file.
    TrackerKeeper(config::Rig rig, std::string rigFile)
        : rig_{std::move(rig)}, rigFile_{std::move(rigFile)} {}

    // Each second, as a network card may come late: listens, or lends the port, after which it
    // takes the corners that the rig's file then has.
    void everySecond();

    // Ten times a second: what the master is told, where there is something to say.
    [[nodiscard]] std::optional<WallHands> tick();

    // Why the tracker is not heard; empty where it is, or the rig has none.
    [[nodiscard]] const std::string& problem() const { return problem_; }

  private:
    void lend();

    config::Rig rig_;
    std::string rigFile_;
    std::optional<TouchListener> tracker_;
    std::string problem_;
    bool isLent_ = false;
};

}  // namespace aquarama::console
