// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/controls.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "common/wall/wall.h"
#include "render_node/gl/context.h"
#include "render_node/show/projection.h"

namespace aquarama::show {

namespace {

// Largest number of pinches that wait for a frame; more are dropped.
constexpr std::size_t kMostPinches = 8;

// How long a pointer that does not move counts as a hand.
constexpr std::chrono::seconds kHeldPointer{20};

// How long a window shows why a key did nothing.
constexpr std::chrono::seconds kHint{4};

// The overlay that a key switches; null for other keys.
bool* overlayOf(char key, Overlays& overlays) {
    switch (key) {
        case 'g':
            return &overlays.warpGrid;
        case 'b':
            return &overlays.blendMask;
        case 'i':
            return &overlays.fishIds;
        case 'e':
            return &overlays.mind;
        case 'h':
            return &overlays.help;
        default:
            return nullptr;
    }
}

}  // namespace

void Controls::press(char key) {
    switch (key) {
        case gl::kEscapeKey:
        case 'q':
            return end();
        case ' ':
        case 'p':
            return session_.freeze(!frozen_);
        case 'c':
            return drop({});
        default:
            break;
    }
    const std::lock_guard lock(mutex_);
    if (bool* overlay = overlayOf(key, overlays_)) *overlay = !*overlay;
}

void Controls::end() {
    if (!endsShow_) {
        const std::lock_guard lock(mutex_);
        hintUntil_ = net::monotonicNow() + kHint;
        return;
    }
    if (std::exchange(quitAsked_, true)) session_.stop();
    session_.quit();
}

void Controls::click(glm::vec2 place) {
    drop({place});
}

void Controls::point(WindowPlace place, net::Moment now) {
    const std::lock_guard lock(mutex_);
    if (place != pointer_) pointerMoved_ = now;
    pointer_ = place;
}

void Controls::hold(const gl::Hands& hands, net::Moment now) {
    if (const auto steering = pace_.due(steeringOf(hands), now)) session_.steer(*steering);
}

void Controls::drop(const Pinch& pinch) {
    const std::lock_guard lock(mutex_);
    if (pinches_.size() < kMostPinches) pinches_.push_back(pinch);
}

Overlays Controls::overlays() const {
    const std::lock_guard lock(mutex_);
    Overlays shown = overlays_;
    shown.endRefused = net::monotonicNow() < hintUntil_;
    return shown;
}

void Controls::show(const wire::Show& shown) {
    frozen_ = shown.frozen;
}

WindowPlace Controls::pointer() const {
    const std::lock_guard lock(mutex_);
    return pointer_;
}

WindowPlace Controls::heldPointer(net::Moment now) const {
    const std::lock_guard lock(mutex_);
    return now - pointerMoved_ < kHeldPointer ? pointer_ : std::nullopt;
}

std::optional<Pinch> Controls::nextPinch() {
    const std::lock_guard lock(mutex_);
    if (pinches_.empty()) return std::nullopt;
    const Pinch first = pinches_.front();
    pinches_.pop_front();
    return first;
}

namespace {

using std::chrono::milliseconds;

// Least time between two messages: after a change, and while the same steering is held. Three
// repetitions may be lost before the submarine takes the silence for released hands.
constexpr auto kBetweenChanges = milliseconds(33);
constexpr auto kBetweenRepeats = milliseconds(100);
static_assert(4 * kBetweenRepeats < kTicksOfAHand * milliseconds(1000) / 60);

// Deflection of a stick that still counts as rest.
constexpr float kDeadZone = 0.15F;
// Length of a drag that counts as rest, and of one that gives full steering, window heights.
constexpr float kDragDeadZone = 0.02F;
constexpr float kFullDrag = 0.35F;

// 0 within the dead zone, then rising from 0 with the square of the distance, so that small
// corrections are fine; keeps the sign.
float shareOf(float deflection, float deadZone, float full) {
    const float beyond = (std::abs(deflection) - deadZone) / (full - deadZone);
    const float share = std::clamp(beyond, 0.0F, 1.0F);
    return std::copysign(share * share, deflection);
}

glm::vec2 stick(glm::vec2 place) {
    return {shareOf(place.x, kDeadZone, 1), shareOf(place.y, kDeadZone, 1)};
}

// +1, 0 or -1 for a pair of opposite keys.
float between(const gl::Hands& hands, gl::HeldKey plus, gl::HeldKey minus) {
    return (hands.holds(plus) ? 1.0F : 0.0F) - (hands.holds(minus) ? 1.0F : 0.0F);
}

// Rounds a share, limited to -1 .. 1, to the whole numbers of Steering.
std::int8_t axisOf(float share) {
    return static_cast<std::int8_t>(
        std::lround(std::clamp(share, -1.0F, 1.0F) * float{kFullSteering}));
}

}  // namespace

Steering steeringOf(const gl::Hands& hands) {
    const glm::vec2 left = stick(hands.pad.leftStick);
    const glm::vec2 right = stick(hands.pad.rightStick);
    const glm::vec2 dragged = hands.drag.value_or(glm::vec2(0));
    const glm::vec2 drag{shareOf(dragged.x, kDragDeadZone, kFullDrag),
                         shareOf(dragged.y, kDragDeadZone, kFullDrag)};
    const float rise = shareOf(hands.pad.rightTrigger, kDeadZone, 1) -
                       shareOf(hands.pad.leftTrigger, kDeadZone, 1);
    return {
        .ahead = axisOf(between(hands, gl::HeldKey::W, gl::HeldKey::S) +
                        between(hands, gl::HeldKey::Up, gl::HeldKey::Down) + left.y),
        .aside = axisOf(between(hands, gl::HeldKey::D, gl::HeldKey::A) + left.x),
        .up = axisOf(between(hands, gl::HeldKey::PageUp, gl::HeldKey::PageDown) + rise),
        .turn = axisOf(between(hands, gl::HeldKey::Left, gl::HeldKey::Right) - drag.x - right.x),
        .tilt = axisOf(between(hands, gl::HeldKey::Home, gl::HeldKey::End) + drag.y + right.y)};
}

template <class State>
std::optional<State> StatePace<State>::due(const State& wanted, net::Moment now) {
    assert(!saidAt_ || now >= *saidAt_);
    const bool changed = wanted != said_;
    const bool held = wanted != State{};
    if (!changed && !held) return std::nullopt;
    if (saidAt_ && now - *saidAt_ < (changed ? kBetweenChanges : kBetweenRepeats))
        return std::nullopt;
    said_ = wanted;
    saidAt_ = now;
    return wanted;
}

template class StatePace<Steering>;
template class StatePace<WallHands>;

namespace {

// Distance from the viewer at which food is dropped, so that it is well in view.
constexpr float kArmMetres = 2.5F;
// Least depth at which food is dropped, so that it is never dropped into the air.
constexpr float kLeastDepthMetres = 0.25F;

}  // namespace

std::optional<glm::vec3> Pointing::directionOf(glm::vec2 pixel, const wire::Eye& eye) const {
    const glm::vec2 own = pixelOfEye(mode_, sizePixels_, pixel);
    const auto point = wall_->channel(channel_).pointOf(glm::dvec2(own), 0);
    if (!point) return std::nullopt;
    return eye.worldFromWall * glm::vec3(glm::normalize(*point - sweetSpot_));
}

std::optional<glm::vec3> Pointing::handAt(glm::vec2 pixel) const {
    const glm::vec2 own = pixelOfEye(mode_, sizePixels_, pixel);
    const auto point = wall_->channel(channel_).pointOf(glm::dvec2(own), 0);
    if (!point) return std::nullopt;
    return glm::vec3(*point - sweetSpot_);
}

std::optional<glm::vec3> Pointing::pinchAt(glm::vec2 pixel, const wire::Eye& eye) const {
    const auto direction = directionOf(pixel, eye);
    if (!direction) return std::nullopt;
    const glm::vec3 viewer = eye.positionMetres + eye.worldFromWall * glm::vec3(sweetSpot_);
    glm::vec3 place = viewer + *direction * kArmMetres;
    place.y = std::min(place.y, -kLeastDepthMetres);
    return place;
}

}  // namespace aquarama::show
