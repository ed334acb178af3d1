// SPDX-License-Identifier: Apache-2.0
// What keys and mouse of a window do: to the whole show through the master, and to what this window
// shows beside the world.
#pragma once

#include <array>
#include <chrono>
#include <deque>
#include <mutex>
#include <optional>
#include <string_view>

#include <glm/vec2.hpp>

#include "render_node/session/session.h"
#include "render_node/show/steering.h"

namespace aquarama::show {

struct Overlays {
    bool warpGrid = false;   // lines of equal azimuth and elevation, on the wall
    bool blendMask = false;  // this channel's share of white
    bool fishIds = false;
    bool mind = false;  // of the fish nearest to the pointer, or to the picture's middle
    bool help = false;
};

// One line a key, in capitals, as the overlay's font has them.
inline constexpr std::array<std::string_view, 14> kKeyHelp{
    "W S  UP DOWN     AHEAD, BACK",
    "A D              TO THE SIDE",
    "LEFT RIGHT       TURN",
    "PAGE UP, DOWN    RISE, SINK",
    "DRAG RIGHT       LOOK ABOUT, ALSO HOME, END",
    "C    CLICK       DROP FOOD",
    "P    SPACE       PAUSE",
    "F                FULLSCREEN",
    "G                GRID ON THE WALL",
    "B                BLEND MASK",
    "I                FISH IDS",
    "E                THE MIND OF A FISH",
    "H                THIS LIST",
    "Q    ESC         END THE SHOW",
};

// A place of a window, in pixels from its top left corner.
using WindowPlace = std::optional<glm::vec2>;

// Food that a visitor drops: where in the window, or before the middle of the picture.
struct Pinch {
    WindowPlace place;
};

class Controls {
  public:
    explicit Controls(session::Session& session) : session_{session} {}
    // On the main thread. A second q ends this node alone, for when there is no master to listen.
    void press(char key);
    void click(glm::vec2 place);
    void point(WindowPlace place);
    void hold(const context::Hands& hands, std::chrono::nanoseconds now);

    // From any thread.
    [[nodiscard]] Overlays overlays() const;
    [[nodiscard]] WindowPlace pointer() const;
    // Each once, oldest first: only who draws knows what the window shows there.
    [[nodiscard]] std::optional<Pinch> nextPinch();

  private:
    void drop(const Pinch& pinch);

    session::Session& session_;
    bool quitAsked_ = false;
    SteeringPace pace_;
    mutable std::mutex mutex_;  // over all below
    Overlays overlays_;
    WindowPlace pointer_;
    std::deque<Pinch> pinches_;
};

}  // namespace aquarama::show
