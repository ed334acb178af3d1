// SPDX-License-Identifier: Apache-2.0
// The patterns of a scan, and the sources of its pictures.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "common/base/picture.h"
#include "common/config/rig.h"
#include "common/config/scan.h"

namespace aquarama::scan {

// The patterns of a whole scan by one camera, in order: the lit room, black, white of each channel,
// all but one of the stripes and phases of columns and rows, colours and levels, black, the stripes
// left out. Channels that share no light of the screen, by the rig, show their patterns together.
[[nodiscard]] std::vector<config::ScanPattern> sequenceOf(const config::Rig& rig);

// The patterns that show whether a projector has moved: black, white and dots of all channels;
// those that share no light show them together. `isNumbered`: with the patterns that number the
// dots.
[[nodiscard]] std::vector<config::ScanPattern> dotSequenceOf(const config::Rig& rig,
                                                             bool isNumbered);

// A source of the pictures of a scan: a folder of files, or a simulated hall. For one thread.
class PictureSource {
  public:
    virtual ~PictureSource() = default;
    // What the pictures show.
    [[nodiscard]] virtual const config::Scan& scan() const = 0;
    // The picture of this index in the scan, in the codes of the camera. Throws Error where it
    // cannot be read or has another size than the others of its camera.
    [[nodiscard]] virtual Picture picture(std::size_t index) = 0;
};

// Opens a folder with scan.txtpb. A folder with pictures alone must have all pictures of a sequence
// (sequenceOf(), or the Gray codes of OpenCV), in the order of their names. Throws Error.
[[nodiscard]] std::unique_ptr<PictureSource> openFolder(const std::string& folder,
                                                        const config::Rig& rig);
// Writes all pictures, lossless, and scan.txtpb, which openFolder() reads. Throws Error.
void writeFolder(PictureSource& source, const std::string& folder, const config::Rig& rig);

}  // namespace aquarama::scan
