// SPDX-License-Identifier: Apache-2.0
// From what hands hold to what the submarine is told, and when it is told.
#pragma once

#include <array>
#include <chrono>
#include <deque>
#include <mutex>
#include <optional>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/rig.h"
#include "common/units/units.h"
#include "common/wall/wall.h"
#include "common/wire/messages.h"
#include "render_node/gl/context.h"
#include "render_node/session/session.h"

namespace aquarama::show {

// W S, arrows up and down: ahead and back. A D: aside. Arrows left and right: turn. Page up and
// down: rise and sink. Home, End: nose up, down. The mouse with its right button turns and tilts by
// how far it is dragged. Gamepad: left stick ahead and aside, right stick turns and tilts, triggers
// sink and rise. What several say adds up.
[[nodiscard]] Steering steeringOf(const gl::Hands& hands);

// When a steering goes out: at once when it changes, thirty times a second at most, and now and
// then while something is held, so that what is lost is made good before the submarine takes the
// hand for gone.
class SteeringPace {
  public:
    [[nodiscard]] std::optional<Steering> due(const Steering& wanted, std::chrono::nanoseconds now);

  private:
    Steering said_;
    std::optional<std::chrono::nanoseconds> saidAt_;
};

// What keys and mouse of a window do: to the whole show through the master, and to what this window
// shows beside the world.

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
    void hold(const gl::Hands& hands, std::chrono::nanoseconds now);

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

// Where in the world a visitor points who points at a pixel of a channel.

class Pointing {
  public:
    Pointing(const config::Rig& rig, std::size_t channel)
        : screen_{rig.screen},
          channel_{rig.channels.at(channel)},
          mode_{wall::stereoOf(rig, channel).mode},
          sweetSpot_{rig.sweetSpotMetres} {}

    // Unit vector in the world, from the sweet spot through the point of the screen that the pixel
    // (of the display, continuous, from its top left corner) lights; nothing where it misses the
    // screen.
    [[nodiscard]] std::optional<glm::vec3> directionOf(glm::vec2 pixel, const wire::Eye& eye) const;
    // Where food falls that is dropped there: an arm's length before the submarine, under water.
    // World frame, metres.
    [[nodiscard]] std::optional<glm::vec3> pinchAt(glm::vec2 pixel, const wire::Eye& eye) const;
    [[nodiscard]] glm::vec2 middle() const { return glm::vec2(channel_.sizePixels) * 0.5F; }

  private:
    config::Screen screen_;
    config::Channel channel_;
    config::StereoMode mode_;
    glm::dvec3 sweetSpot_;  // wall frame
};

}  // namespace aquarama::show
