// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/controls.h"

#include <utility>

#include "render_node/context/context.h"

namespace aquarama::show {

namespace {

constexpr std::size_t kMostPinches = 8;  // that wait for a frame

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
        case context::kEscapeKey:
        case 'q':
            if (std::exchange(quitAsked_, true)) session_.stop();
            return session_.send(session::NodeInput::Quit);
        case ' ':
        case 'p':
            return session_.send(session::NodeInput::TogglePause);
        case 'c':
            return drop({});
        default:
            break;
    }
    const std::lock_guard lock(mutex_);
    if (bool* overlay = overlayOf(key, overlays_)) *overlay = !*overlay;
}

void Controls::click(glm::vec2 place) {
    drop({place});
}

void Controls::point(WindowPlace place) {
    const std::lock_guard lock(mutex_);
    pointer_ = place;
}

void Controls::hold(const context::Hands& hands, std::chrono::nanoseconds now) {
    if (const auto steering = pace_.due(steeringOf(hands), now)) session_.steer(*steering);
}

void Controls::drop(const Pinch& pinch) {
    const std::lock_guard lock(mutex_);
    if (pinches_.size() < kMostPinches) pinches_.push_back(pinch);
}

Overlays Controls::overlays() const {
    const std::lock_guard lock(mutex_);
    return overlays_;
}

WindowPlace Controls::pointer() const {
    const std::lock_guard lock(mutex_);
    return pointer_;
}

std::optional<Pinch> Controls::nextPinch() {
    const std::lock_guard lock(mutex_);
    if (pinches_.empty()) return std::nullopt;
    const Pinch first = pinches_.front();
    pinches_.pop_front();
    return first;
}

}  // namespace aquarama::show
