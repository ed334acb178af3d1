// SPDX-License-Identifier: Apache-2.0
// Finds whether a projector has moved since its dots were learned, and how far, apart from small
// movements of the camera.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "calibration/drift/dots.h"
#include "common/config/rig.h"

namespace aquarama::drift {

// The dots that were learned right after a calibration.
struct Reference {
    std::string learned;  // when: "2026-11-24T21:03:01Z"
    glm::ivec2 cameraPixels{};
    std::vector<SeenDot> dots;
};

// To and from JSON. Throws Error with `source` where the text is no reference or of another rig.
[[nodiscard]] std::string textOf(const Reference& reference, const config::Rig& rig);
[[nodiscard]] Reference parseReference(const std::string& text,
                                       const std::string& source,
                                       const config::Rig& rig);

// NotSeen: too few of the dots were found again.
enum class DriftVerdict : std::uint8_t { InPlace, Moved, NotSeen };

// Pixels of the channel's own picture.
struct ChannelDrift {
    DriftVerdict verdict = DriftVerdict::NotSeen;
    double shift = 0;  // of its dots, root mean square
    // Movement to the right and down, clockwise turn and growth; the last two at the picture's
    // sides.
    double right = 0, down = 0, turn = 0, zoom = 0;
    std::size_t dots = 0;
};

// The result for a whole wall; `channels` are in the order of the rig's.
struct WallDrift {
    double cameraPixels = 0;    // by which the camera's picture moved, in the mean
    bool isCameraLost = false;  // it moved too far to tell anything of projectors
    std::vector<ChannelDrift> channels;
};

// A channel that has moved farther must be calibrated again.
inline constexpr double kMostDriftPixels = 0.5;

// `now`: the result of foundAgain(). With one channel alone, a movement of the camera counts as
// that of its projector.
[[nodiscard]] WallDrift driftOf(const Reference& reference,
                                const std::vector<SeenDot>& now,
                                const config::Rig& rig);

// One line for the terminal, without a line break.
[[nodiscard]] std::string lineOf(const config::Channel& channel, const ChannelDrift& drift);
// JSON for other programs.
[[nodiscard]] std::string jsonOf(const WallDrift& drift,
                                 const std::string& looked,  // when, as Reference::learned
                                 const Reference& reference,
                                 const config::Rig& rig);

}  // namespace aquarama::drift
