// SPDX-License-Identifier: Apache-2.0
// What the keys of a window do: to the whole show through the master, and to what this window
// shows beside the world.
#pragma once

#include <array>
#include <atomic>
#include <string_view>

#include "render_node/session/session.h"

namespace aquarama {

struct Overlays {
    bool warpGrid = false;   // lines of equal azimuth and elevation, on the wall
    bool blendMask = false;  // this channel's share of white
    bool fishIds = false;
    bool help = false;
};

// One line a key; capitals and digits only, as the overlay's font has them.
inline constexpr std::array<std::string_view, 7> kKeyHelp{
    "Q  ESC    END THE SHOW",
    "P  SPACE  PAUSE",
    "F         FULLSCREEN",
    "W         GRID ON THE WALL",
    "B         BLEND MASK",
    "I         FISH IDS",
    "H         THIS LIST",
};

class Controls {
  public:
    explicit Controls(Session& session) : session_{session} {}
    // On the main thread. A second q ends this node alone, for when there is no master to listen.
    void press(char key);
    [[nodiscard]] Overlays overlays() const { return overlays_; }  // from any thread

  private:
    Session& session_;
    std::atomic<Overlays> overlays_{Overlays{}};
    bool quitAsked_ = false;
};

}  // namespace aquarama
