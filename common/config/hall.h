// SPDX-License-Identifier: Apache-2.0
// A simulated hall: the true screen, projectors and camera, which differ from the crew's rig.
// Frames are the rig's. hall.proto explains each value.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/base/brown_lens.h"
#include "common/config/rig.h"
#include "common/config/scan.h"

namespace aquarama::config {

// A dent away from the audience; its place is on the unrolled screen.
struct HallDent {
    glm::dvec2 place{0.5};
    double radiusMetres = 0, depthMetres = 0;
};

// The differences of the true screen from the rig's.
struct HallScreen {
    double radiusFactor = 1, sizeFactor = 1, tiltRadians = 0;
    double bumpMetres = 0, bumpDistanceMetres = 1.5;
    std::uint32_t bumpSeed = 0;
    std::vector<HallDent> dents = {};
    double albedo = 1;
    bool bounces = false;
    std::vector<double> marksOffMetres = {};  // of each strip of tape, along the edge
};

// The errors of a lens.
struct HallLens {
    BrownLens<double> distortion = {};
    double vignetting = 0;  // the share of light that the corners lack
};

// The differences of a channel's true projector from the rig's.
struct HallProjector {
    glm::dvec3 movedMetres{};
    glm::dvec3 turnedRadians{};  // yaw, pitch, roll
    double focalFactor = 1;
    glm::dvec2 shiftPixels{};
    HallLens lens = {};
    glm::dvec2 keystone{};
    std::optional<glm::dvec3> gamma = {};
    double toe = 0, knee = 0;
    glm::dmat3 primaries{1.0};  // linear Rec. 709 from its own colours
    double black = 0, brightness = 1;
};

// The camera of a hall.
struct HallCamera {
    glm::dvec3 positionMetres{}, lookAtMetres{0, 0, -1};
    double rollRadians = 0;
    glm::ivec2 sizePixels{};
    double focalPixels = 0;
    glm::dvec2 principalPixels{};
    HallLens lens = {};
    double blurPixels = 0;
    ScanCamera::Response response = ScanCamera::Response::Srgb;
    double responseBend = 0;
    int bits = 8;
    double exposure = 1, fullWell = 0, readNoise = 0;
};

// Faults during a scan. Channels are indices in the rig, pictures indices in the scan.
struct HallFaults {
    // Something that stands before the camera.
    struct Block {
        glm::dvec2 place{0.5}, radius{};
    };
    // A projector that is pushed during the scan.
    struct Move {
        std::size_t channel = 0, fromPicture = 0;
        glm::dvec2 yawPitchRadians{};
    };
    // A lamp that is switched on during the scan.
    struct Lamp {
        glm::dvec2 place{0.5};
        double radiusMetres = 0, light = 0;
        std::size_t fromPicture = 0;
    };
    // A projector that shows another picture mode than the rig says.
    struct Mode {
        std::size_t channel = 0;
        glm::ivec2 sizePixels{};
    };
    std::optional<Block> blocked = {};
    std::optional<Move> moved = {};
    std::optional<std::array<std::size_t, 2>> swapped = {};
    std::optional<Lamp> lamp = {};
    std::optional<std::size_t> latePicture = {};
    bool autoExposure = false;
    std::optional<Mode> mode = {};
    bool flatScreen = false;
};

// A whole hall.
struct Hall {
    HallScreen screen = {};
    std::vector<HallProjector> projectors = {};  // one for each channel of the rig, in its order
    HallCamera camera = {};
    double darkLight = 0, roomLight = 0.3;
    HallFaults faults = {};
};

// `channels` are the names of the rig's. Throws Error with file:line:column.
[[nodiscard]] Hall parseHall(const std::string& text,
                             const std::string& source,
                             const std::vector<std::string>& channels);

}  // namespace aquarama::config
