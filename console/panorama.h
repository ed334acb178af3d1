// SPDX-License-Identifier: Apache-2.0
// How the pictures of the channels lie on the unrolled wall, for browsers that put them together.
#pragma once

#include <filesystem>
#include <future>
#include <string>
#include <vector>

#include "common/config/rig.h"
#include "console/console.pb.h"

namespace aquarama::console {

// Of each channel a mesh of points from common/wall's warp. Throws Error where the rig's wall
// cannot be made. Takes a part of a second.
[[nodiscard]] browser::Panorama panoramaOf(const config::Rig& rig);

// Made on a thread of its own, and anew when a calibration or what is set by hand has changed.
class PanoramaWatch {
  public:
    explicit PanoramaWatch(std::string rigPath) : rigPath_{std::move(rigPath)} {}
    // Once a second; never waits. True where there is another panorama than before.
    [[nodiscard]] bool update();
    // Without meshes until the first is made.
    [[nodiscard]] const browser::Panorama& panorama() const { return made_.panorama; }

  private:
    // From which state of which files it was made; and why it was not, if so.
    struct Made {
        std::vector<std::filesystem::path> files;
        std::vector<std::filesystem::file_time_type> times;
        browser::Panorama panorama;
        std::string problem;
    };
    [[nodiscard]] static Made make(const std::string& rigPath);

    std::string rigPath_;
    Made made_;
    std::future<Made> making_;
};

}  // namespace aquarama::console
