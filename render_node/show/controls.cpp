// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/controls.h"

#include <utility>

#include "render_node/context/context.h"

namespace aquarama {

void Controls::press(char key) {
    Overlays overlays = overlays_;
    switch (key) {
        case kEscapeKey:
        case 'q':
            if (std::exchange(quitAsked_, true)) session_.stop();
            session_.send(NodeInput::Quit);
            break;
        case ' ':
        case 'p':
            session_.send(NodeInput::TogglePause);
            break;
        case 'w':
            overlays.warpGrid = !overlays.warpGrid;
            break;
        case 'b':
            overlays.blendMask = !overlays.blendMask;
            break;
        case 'i':
            overlays.fishIds = !overlays.fishIds;
            break;
        case 'h':
            overlays.help = !overlays.help;
            break;
        default:
            break;
    }
    overlays_ = overlays;
}

}  // namespace aquarama
