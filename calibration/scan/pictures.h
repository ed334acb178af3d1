// SPDX-License-Identifier: Apache-2.0
// The pictures of a scan: which patterns are shown, and where the pictures of them come from.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "common/base/picture.h"
#include "common/config/rig.h"
#include "common/config/scan.h"

namespace aquarama::scan {

// The patterns of a whole scan by one camera, in their order: of the room, black, white of each
// channel, columns and rows but for one stripe pattern of each, colours and levels, black, those
// stripes. Channels that share no light of the screen, by the rig, show theirs together.
[[nodiscard]] std::vector<config::ScanPattern> sequenceOf(const config::Rig& rig);

// To see whether a projector has moved: black, white and dots of all channels, those that share no
// light together. `isNumbered`: with the pictures that tell which dot is which.
[[nodiscard]] std::vector<config::ScanPattern> dotSequenceOf(const config::Rig& rig,
                                                             bool isNumbered);

// What a camera has taken: a folder of files, or a simulated hall. For one thread.
class PictureSource {
  public:
    virtual ~PictureSource() = default;
    [[nodiscard]] virtual const config::Scan& scan() const = 0;
    // Of the picture of this index in the scan: codes as the camera gave them. Throws Error where
    // it cannot be read or has not the size of the others of its camera.
    [[nodiscard]] virtual Picture picture(std::size_t index) = 0;
};

// A folder with scan.txtpb, or with pictures alone, whose order by name is that of a sequence that
// is known by their number (sequenceOf(), or the Gray codes of OpenCV). Throws Error.
[[nodiscard]] std::unique_ptr<PictureSource> openFolder(const std::string& folder,
                                                        const config::Rig& rig);
// Writes all pictures, lossless, and scan.txtpb, which openFolder() reads. Throws Error.
void writeFolder(PictureSource& source, const std::string& folder, const config::Rig& rig);

}  // namespace aquarama::scan
