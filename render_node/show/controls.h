// SPDX-License-Identifier: Apache-2.0
// A visitor's input at a window: steering of the submarine, keys that change the show or the
// window, food at the pointer.
#pragma once

#include <array>
#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/base/wall_hands.h"
#include "common/config/rig.h"
#include "common/net/clock.h"
#include "common/wall/wall.h"
#include "common/wire/state_codec.h"
#include "render_node/gl/context.h"
#include "render_node/session/session.h"

namespace aquarama::show {

// The steering that keys, mouse and gamepad ask of the submarine, -kFullSteering to kFullSteering
// on each axis. W S, arrows up and down: ahead and back. A D: sideways. Arrows left and right:
// turn. Page up and down: rise and sink. Home, End: nose up, down. Dragging with the right mouse
// button turns and tilts in proportion to the distance. Gamepad: left stick ahead and sideways,
// right stick turns and tilts, triggers sink and rise. Where several act on one axis, their values
// are added.
[[nodiscard]] Steering steeringOf(const gl::Hands& hands);

// Decides when a state is sent: at once when it changes, but at most thirty times a second, and
// repeatedly while it is not at rest, State{}. The repetition replaces lost messages before the
// master takes the silence for rest. Used by one thread.
template <class State>
class StatePace {
  public:
    // The state to send now; empty where nothing is due. now: of a monotonic clock, never earlier
    // than at the call before.
    [[nodiscard]] std::optional<State> due(const State& wanted, net::Moment now);

  private:
    State said_{};
    std::optional<net::Moment> saidAt_;
};
// Of a steering.
using SteeringPace = StatePace<Steering>;

// Keys and mouse of a window act on the whole show, through the master, and on what this window
// shows over the world.

// What this window shows over the world; each is switched by a key.
struct Overlays {
    // Lines of equal azimuth and elevation, on the wall.
    bool warpGrid = false;
    // This channel's share of white light, in place of the scene.
    bool blendMask = false;
    bool fishIds = false;
    // The mind of the fish nearest to the pointer, or to the middle of the picture.
    bool mind = false;
    bool help = false;
    // A key was pressed that would end the show, which the rig does not allow.
    bool endRefused = false;
};

// The text that a window shows for some seconds after such a key.
inline constexpr std::string_view kEndHint = "THE SHOW IS ENDED FROM THE CONSOLE, NOT BY THIS KEY";

// The text of the help overlay: one line for each key, in capitals, which are all that the font
// has.
inline constexpr std::array<std::string_view, 14> kKeyHelp{
    "W S  UP DOWN     AHEAD, BACK",
    "A D              TO THE SIDE",
    "LEFT RIGHT       TURN",
    "PAGE UP, DOWN    RISE, SINK",
    "DRAG RIGHT       LOOK ABOUT, ALSO HOME, END",
    "C    CLICK       DROP FOOD",
    "P    SPACE       FREEZE",
    "F                FULLSCREEN",
    "G                GRID ON THE WALL",
    "B                BLEND MASK",
    "I                FISH IDS",
    "E                THE MIND OF A FISH",
    "H                THIS LIST",
    "Q    ESC         END THE SHOW",
};

// A place in a window, pixels from its top left corner; empty where there is none.
using WindowPlace = std::optional<glm::vec2>;

// Food that a visitor drops: at a place of the window, or at the middle of the picture where the
// place is empty.
struct Pinch {
    WindowPlace place;
};

// Collects input on the main thread and hands it to the drawing thread. The session must outlive
// it.
class Controls {
  public:
    // endsShow: whether q and Esc end the show, as the rig says. A second q ends this node alone,
    // in case no master listens.
    Controls(session::Session& session, bool endsShow) : session_{session}, endsShow_{endsShow} {}
    // Called on the main thread.
    void press(char key);
    void click(glm::vec2 place);
    // Where the pointer is now.
    void point(WindowPlace place, net::Moment now);
    // Sends the steering that the hands ask for, when it is due.
    void hold(const gl::Hands& hands, net::Moment now);

    // What the wall shows: a key that changes it asks for the other value. May be called by any
    // thread.
    void show(const wire::Show& shown);

    // May be called by any thread.
    [[nodiscard]] Overlays overlays() const;
    [[nodiscard]] WindowPlace pointer() const;
    // Where the pointer is held before the wall: not where it has rested for a while, as one does
    // that nobody holds.
    [[nodiscard]] WindowPlace heldPointer(net::Moment now) const;
    // The next pinch of food that waits, oldest first; each is returned once. The drawing thread
    // takes them, as it knows which part of the world the window shows.
    [[nodiscard]] std::optional<Pinch> nextPinch();

  private:
    void drop(const Pinch& pinch);
    void end();

    session::Session& session_;
    bool endsShow_;
    bool quitAsked_ = false;
    SteeringPace pace_;
    std::atomic<bool> frozen_ = false;
    // Guards all members below. Those above belong to the main thread.
    mutable std::mutex mutex_;
    Overlays overlays_;
    net::Moment hintUntil_{};
    WindowPlace pointer_;
    net::Moment pointerMoved_{};
    std::deque<Pinch> pinches_;
};

// From a pixel of a channel to a direction and a place in the world.

// The geometry of one channel. Immutable.
class Pointing {
  public:
    // channel: index in rig.channels.
    // wall: of this rig; null: made here.
    Pointing(const config::Rig& rig,
             std::size_t channel,
             std::shared_ptr<const wall::Wall> wall = nullptr)
        : wall_{wall ? std::move(wall) : std::make_shared<const wall::Wall>(rig)},
          channel_{channel},
          sizePixels_{rig.channels.at(channel).sizePixels},
          mode_{wall::stereoOf(rig, channel).mode},
          sweetSpot_{rig.sweetSpotMetres} {}

    // Unit vector in the world, from the sweet spot through the point of the screen that the pixel
    // lights; empty where it misses the screen. pixel: of the display, continuous, from its top
    // left corner.
    [[nodiscard]] std::optional<glm::vec3> directionOf(glm::vec2 pixel, const wire::Eye& eye) const;
    // The place where food enters the world when it is dropped at this pixel: some metres before
    // the viewer, always under water. World frame, metres.
    [[nodiscard]] std::optional<glm::vec3> pinchAt(glm::vec2 pixel, const wire::Eye& eye) const;
    // The point of the screen that this pixel lights, from the sweet spot in the axes of the wall
    // frame, metres.
    [[nodiscard]] std::optional<glm::vec3> handAt(glm::vec2 pixel) const;
    // The middle of the channel's picture, pixels.
    [[nodiscard]] glm::vec2 middle() const { return glm::vec2(sizePixels_) * 0.5F; }

  private:
    std::shared_ptr<const wall::Wall> wall_;
    std::size_t channel_;
    glm::ivec2 sizePixels_;
    config::StereoMode mode_;
    // Wall frame, metres.
    glm::dvec3 sweetSpot_;
};

}  // namespace aquarama::show
