// SPDX-License-Identifier: Apache-2.0
// What a pixel's neighbours know: it settles doubts, and finds what is wrong.
#pragma once

#include "calibration/scan/axis_reader.h"

namespace aquarama::scan {

// Pixels of the channel between neighbouring ones of the camera: the median, across or down,
// whichever is more; 0 where nothing is seen.
[[nodiscard]] float stepOf(const ChannelView& view, int width);

// Gives pixels without a place along `axis` another reading near the median of their neighbours.
// `owned`: the channel's pixels.
void settleDoubts(ChannelView& view,
                  int axis,
                  int width,
                  const std::vector<std::size_t>& owned,
                  const AxisReader& reader,
                  WorkerPool& pool);

// Drops pixels that few neighbours agree with, or several do not: errors, and edges of depth, where
// a pixel sees two places at once.
void dropOutliers(ChannelView& view, int width, WorkerPool& pool);
// Then those by the border of the channel's picture, and within its tag.
void dropBorders(ChannelView& view, float step, glm::ivec2 channelPixels);
void dropTag(ChannelView& view, float step, glm::ivec2 cameraPixels, glm::ivec2 channelPixels);

}  // namespace aquarama::scan
