// SPDX-License-Identifier: Apache-2.0
// Seams that a wall will have, by the camera's own pictures: a real hall has no truth beside it.
#pragma once

#include <vector>

#include "calibration/light/photometry.h"
#include "calibration/scan/decode.h"
#include "common/formats/wall_file.h"

namespace aquarama::light {

// The largest step that even light of 2, 18 and 100 % will have, as shares, foreseen from the
// camera's pictures: along bands, the whites of the channels as they were seen
// there against those that the finished masks were made for. Measured as Seams are.
struct ForeseenSeams {
    double grey2 = 0, grey18 = 0, grey100 = 0;
};
// `lights`: what the file was made of; each of its channels has masks and colour.
[[nodiscard]] ForeseenSeams foreseenSeams(const std::vector<ChannelLight>& lights,
                                          const formats::WallFile& file,
                                          scan::CameraView seen);

}  // namespace aquarama::light
