// SPDX-License-Identifier: Apache-2.0
// What a visitor enters at a window: keys, clicks, a drag, and what is held at a moment.
#pragma once

#include <deque>
#include <optional>

#include <glm/vec2.hpp>

#include "render_node/gl/context.h"
#include "render_node/gl/placed_window.h"

namespace aquarama::gl {

// Used by the main thread. The window must outlive it.
class WindowInput {
  public:
    explicit WindowInput(const PlacedWindow& window) : window_{window} {}

    // A key of GLFW was pressed. Keys that Context::nextKey() does not name are ignored.
    void press(int key);
    // The left mouse button was pressed. Sixteen clicks are kept, later ones are dropped: nobody
    // takes them while the window draws nothing yet.
    void click();
    // The right mouse button was pressed, or released.
    void drag(bool begins);

    // As the functions of Context of these names.
    [[nodiscard]] std::optional<char> nextKey();
    [[nodiscard]] std::optional<glm::vec2> nextClick();
    [[nodiscard]] Hands hands() const;

  private:
    const PlacedWindow& window_;
    std::deque<char> keys_;
    std::deque<glm::vec2> clicks_;
    // Where the right button was pressed; empty while it is up.
    std::optional<glm::vec2> dragFrom_;
};

}  // namespace aquarama::gl
