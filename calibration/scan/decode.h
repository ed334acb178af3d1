// SPDX-License-Identifier: Apache-2.0
// Decodes the pictures of a scan: finds, for each pixel of the camera, the channel that lights it,
// the place in that channel's picture, and its standard deviation.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "calibration/scan/pictures.h"
#include "common/base/picture.h"
#include "common/config/rig.h"

namespace aquarama::scan {

// One channel in the camera's picture. All arrays have a value for each of the camera's pixels, top
// row first.
struct ChannelView {
    // The place in the channel's picture (continuous; centres of pixels at +0.5); NaN where the
    // channel is not seen or not understood.
    std::vector<glm::vec2> place;
    // Its standard deviation, in pixels of the channel: by noise, without errors that neighbouring
    // pixels share.
    std::vector<glm::vec2> sigma;
    // Linear light of its white minus that of black; 1 is the camera's maximum.
    std::vector<float> light;
};

// A fault of a scan: the name of the cause, and what the user should do.
struct ScanFault {
    // One word for programs: over_exposed, under_exposed, dropped_frame, channel_not_seen,
    // ambient_light, auto_exposure, moved, blocked.
    std::string cause;
    std::string advice;   // a line: what, where, what to do
    bool refuses = true;  // false: it is a warning
};

// A picture of a level, reduced: the mean of 3 x 3 pixels in the middle of each square of
// CameraView::sampleStep pixels. Linear, in the picture's own exposure; NaN where a pixel is
// clipped.
struct SampledPicture {
    config::ScanPattern pattern;
    Light light;
    float scale = 1;  // brings it to the exposure of the first picture
};

// The view of one camera.
struct CameraView {
    glm::ivec2 sizePixels{};
    std::vector<ChannelView> channels;  // as the rig's; empty arrays where one was not scanned
    Light room;   // linear, where the outline of the screen is best seen; empty where there is none
    Light black;  // linear, all channels black; empty where there is none
    int sampleStep = 1;
    std::vector<SampledPicture> samples;
    double noise = 0;  // standard deviation of a linear value in the middle tones
    std::vector<ScanFault> faults;
};

// Decodes the pictures of the camera of this index. Reads each picture once, on a second thread
// while the one before is decoded. With three channels it takes some 150 bytes for each pixel of
// the camera, half of it for the result. The first fault is the cause; faults that follow from it
// are left out. Throws Error where a picture cannot be read or patterns are missing.
[[nodiscard]] CameraView decode(PictureSource& source,
                                std::uint32_t camera,
                                const config::Rig& rig);

// The index, in the planes of the view, of the pixel in the middle of a sample.
[[nodiscard]] std::size_t pixelOfSample(const CameraView& view, int x, int y);

// Linear light of a camera's codes.
[[nodiscard]] Light lightOf(const Picture& picture, config::ScanCamera::Response response);

}  // namespace aquarama::scan
