// SPDX-License-Identifier: Apache-2.0
#include "calibration/solve/hall_option.h"

#include <algorithm>
#include <vector>

#include "calibration/hall/random_hall.h"
#include "common/base/log.h"
#include "common/cli/command_line.h"
#include "common/config/text_file.h"

namespace aquarama::solve {

config::Hall hallFrom(const std::string& text, const config::Rig& rig) {
    const std::string random = "random:";
    std::vector<std::string> names;
    for (const config::Channel& channel : rig.channels) names.push_back(channel.name);
    if (!text.starts_with(random))
        return config::parseHall(config::readTextFile(text), text, names);
    const std::string seed = text.substr(random.size());
    unsigned long number = 0;
    if (!CLI::detail::lexical_cast(seed, number) || number > cli::kMostSeed)
        throw Error("--simulate: \"" + seed + "\" is no seed; give a whole number, as in random:7");
    // A camera that is as fine as the panorama, about.
    constexpr double kFullPanorama = 4000;
    return hall::randomHall(rig,
                            static_cast<std::uint32_t>(number),
                            std::clamp(rig.panoramaPixels.x / kFullPanorama, 0.1, 1.0));
}

}  // namespace aquarama::solve
