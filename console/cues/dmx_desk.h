// SPDX-License-Identifier: Apache-2.0
// A lighting desk: channels of a universe of DMX become orders.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/config/rig.h"
#include "console/cues/dmx_source.h"
#include "console/cues/osc_desk.h"

namespace aquarama::console {

// Opens a universe, as openUniverse() does.
using OpenUniverse = std::function<std::unique_ptr<DmxSource>(std::uint32_t universe)>;

// What the channels have when they are first heard changes nothing, so that a console that is
// started again does not light a wall that is closed; each change after that is an order, ten a
// second at most. Where nothing comes any more the wall stays as it is. Of the server's thread.
class DmxDesk {
  public:
    DmxDesk(config::DmxCues how, GiveOrder give, OpenUniverse open);

    // Ten times a second, at a time in seconds that never goes back.
    void tick(double now);
    // Why nothing comes; empty: it does, or may still.
    [[nodiscard]] const std::string& problem() const { return problem_; }

  private:
    void openAgain(double now);
    void take(const DmxFrame& frame);

    config::DmxCues how_;
    GiveOrder give_;
    OpenUniverse open_;
    std::unique_ptr<DmxSource> source_;  // null: not open
    double triedAt_ = -1e9;              // to open it
    double heardAt_ = 0;                 // of the last frame, or since it is open
    std::string problem_;
    // As they were last heard.
    std::optional<std::uint8_t> brightness_;
    std::optional<bool> black_;
};

}  // namespace aquarama::console
