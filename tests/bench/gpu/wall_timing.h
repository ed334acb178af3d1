// SPDX-License-Identifier: Apache-2.0
// All channels of a wall, drawn in turn by one process on one card, and what their frames cost.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "common/base/picture.h"
#include "common/config/rig.h"
#include "render_node/gl/handle.h"
#include "render_node/show/channel_picture.h"
#include "tests/bench/gpu/sea.h"
#include "tests/bench/gpu/stage_clock.h"

namespace aquarama::bench {

// So many frames, fewer when they take longer.
struct Patience {
    std::size_t leastFrames = 32;
    std::size_t mostFrames = 240;
    double seconds = 5;
};

// Milliseconds, of each frame.
struct FrameTimes {
    std::vector<double> wall;  // from the first call until the card has finished
    double cpu = 0;            // of all threads of the process, a frame in the mean
};

// A frame in the median.
using StageTimes = std::map<std::string, StageTime>;

// Each channel has its own scene, as each node has. Owns GL objects of the current context.
class DrawnWall {
  public:
    DrawnWall(const Sea& sea, const config::Rig& rig, config::QualityTier quality);

    [[nodiscard]] FrameTimes timeFrames(const Patience& patience);
    // Without pixels: with the rasterizer off, which leaves computation and vertices.
    [[nodiscard]] StageTimes timeStages(const Patience& patience, Clocked clocked, bool withPixels);
    // What each channel projects of the first frame, as light.
    [[nodiscard]] std::vector<Light> lights();

  private:
    void draw(const wire::StateFrame& frame);

    const Sea& sea_;
    std::deque<show::ChannelPicture> channels_;
    std::deque<gl::Target> targets_;
};

// Of samples: `share` of them are not greater.
[[nodiscard]] double percentile(std::vector<double> samples, double share);

}  // namespace aquarama::bench
