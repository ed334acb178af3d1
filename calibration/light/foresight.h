// SPDX-License-Identifier: Apache-2.0
// Predicts the seams of a wall from the camera's own pictures, as a real hall has no known truth.
#pragma once

#include <vector>

#include "calibration/light/photometry.h"
#include "calibration/scan/decode.h"
#include "common/formats/wall_file.h"

namespace aquarama::light {

// The largest steps of even light of 2, 18 and 100 %, as shares: along bands, the whites that the
// camera saw are compared with those for which the masks were made. Measured as Seams are.
struct ForeseenSeams {
    double grey2 = 0, grey18 = 0, grey100 = 0;
};
// `lights`: the measurements that `file` was made from. Each channel of the file has masks and
// colour.
[[nodiscard]] ForeseenSeams foreseenSeams(const std::vector<ChannelLight>& lights,
                                          const formats::WallFile& file,
                                          scan::CameraView seen);

}  // namespace aquarama::light
