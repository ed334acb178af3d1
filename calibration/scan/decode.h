// SPDX-License-Identifier: Apache-2.0
// From the pictures of a scan to what the camera sees: for each of its pixels, which place of which
// channel's picture lights it, and how well that is known.
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
    // Its standard deviation, in pixels of the channel: of the noise, without what is the same in
    // all of a neighbourhood.
    std::vector<glm::vec2> sigma;
    // Linear light of its white without that of black; 1 is the camera's most.
    std::vector<float> light;
};

// What is wrong with a scan, in words for a user: the name of a cause, and what to do.
struct ScanFault {
    // One word for programs: over_exposed, under_exposed, dropped_frame, channel_not_seen,
    // ambient_light, auto_exposure, moved, blocked.
    std::string cause;
    std::string advice;   // a line: what, where, what to do
    bool refuses = true;  // or a warning
};

// A picture of a level, thinned out: the mean of 3 x 3 pixels in the middle of each
// square of CameraView::sampleStep pixels. Linear, as the camera gave it; not a number where a
// pixel has the camera's most.
struct SampledPicture {
    config::ScanPattern pattern;
    Light light;
    float scale = 1;  // brings it to the exposure of the first picture
};

// All that one camera sees.
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

// Of the camera of this index in the scan. Reads each picture once, the next one while one is
// worked on by another thread, and keeps what an axis of one round adds up to: with three channels
// some 150 bytes for each of the camera's pixels, half of which is the result. The first fault is
// the cause; what it makes look wrong is left out. Throws Error where a picture cannot be read or
// patterns are missing.
[[nodiscard]] CameraView decode(PictureSource& source,
                                std::uint32_t camera,
                                const config::Rig& rig);

// The pixel in the middle of a sample of the view, as an index of its planes.
[[nodiscard]] std::size_t pixelOfSample(const CameraView& view, int x, int y);

// Linear light of a camera's codes.
[[nodiscard]] Light lightOf(const Picture& picture, config::ScanCamera::Response response);

}  // namespace aquarama::scan
