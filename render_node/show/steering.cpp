// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/steering.h"

#include <algorithm>
#include <cmath>

namespace aquarama::show {

namespace {

using std::chrono::milliseconds;

constexpr auto kBetweenChanges = milliseconds(33);
constexpr auto kBetweenRepeats = milliseconds(100);
static_assert(4 * kBetweenRepeats < kTicksOfAHand * milliseconds(1000) / 60);

constexpr float kDeadZone = 0.15F;      // of a stick that is not quite at rest
constexpr float kDragDeadZone = 0.02F;  // heights of the window
constexpr float kFullDrag = 0.35F;

// Nothing within the dead zone, then from 0, finer about the middle.
float shareOf(float deflection, float deadZone, float full) {
    const float beyond = (std::abs(deflection) - deadZone) / (full - deadZone);
    const float share = std::clamp(beyond, 0.0F, 1.0F);
    return std::copysign(share * share, deflection);
}

glm::vec2 stick(glm::vec2 place) {
    return {shareOf(place.x, kDeadZone, 1), shareOf(place.y, kDeadZone, 1)};
}

float between(const context::Hands& hands, context::HeldKey plus, context::HeldKey minus) {
    return (hands.holds(plus) ? 1.0F : 0.0F) - (hands.holds(minus) ? 1.0F : 0.0F);
}

std::int8_t axisOf(float share) {
    return static_cast<std::int8_t>(
        std::lround(std::clamp(share, -1.0F, 1.0F) * float{kFullSteering}));
}

}  // namespace

Steering steeringOf(const context::Hands& hands) {
    const glm::vec2 left = stick(hands.pad.leftStick);
    const glm::vec2 right = stick(hands.pad.rightStick);
    const glm::vec2 dragged = hands.drag.value_or(glm::vec2(0));
    const glm::vec2 drag{shareOf(dragged.x, kDragDeadZone, kFullDrag),
                         shareOf(dragged.y, kDragDeadZone, kFullDrag)};
    const float rise = shareOf(hands.pad.rightTrigger, kDeadZone, 1) -
                       shareOf(hands.pad.leftTrigger, kDeadZone, 1);
    return {
        .ahead = axisOf(between(hands, context::HeldKey::W, context::HeldKey::S) +
                        between(hands, context::HeldKey::Up, context::HeldKey::Down) + left.y),
        .aside = axisOf(between(hands, context::HeldKey::D, context::HeldKey::A) + left.x),
        .up = axisOf(between(hands, context::HeldKey::PageUp, context::HeldKey::PageDown) + rise),
        .turn = axisOf(between(hands, context::HeldKey::Left, context::HeldKey::Right) - drag.x -
                       right.x),
        .tilt = axisOf(between(hands, context::HeldKey::Home, context::HeldKey::End) + drag.y +
                       right.y)};
}

std::optional<Steering> SteeringPace::due(const Steering& wanted, std::chrono::nanoseconds now) {
    const bool changed = wanted != said_;
    const bool held = wanted != Steering{};
    if (!changed && !held) return std::nullopt;
    if (saidAt_ && now - *saidAt_ < (changed ? kBetweenChanges : kBetweenRepeats))
        return std::nullopt;
    said_ = wanted;
    saidAt_ = now;
    return wanted;
}

}  // namespace aquarama::show
