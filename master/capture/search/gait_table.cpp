// SPDX-License-Identifier: Apache-2.0
#include "master/capture/search/gait_table.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>

namespace aquarama {

namespace {

constexpr std::array kGaits{"slow", "medium", "fast"};

}  // namespace

std::string gaitTableHead() {
    return "| species | gait | beat, Hz | gain | speed, L/s | stride, L | tail, L | Strouhal | "
           "wavelength, "
           "L | nose, L |\n"
           "|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string gaitTableRows(const Species& species) {
    const std::array gaits{species.swim.slow, species.swim.medium, species.swim.fast};
    std::string name = species.name;
    std::ranges::replace(name, '_', ' ');
    std::ostringstream rows;
    rows << std::fixed << std::setprecision(2);
    for (std::size_t i = 0; i < kGaits.size(); ++i) {
        const GaitFigures g = steadyFigures(species, gaits.at(i));
        rows << "| " << (i == 0 ? name : "") << " | " << kGaits.at(i) << " | " << g.beatHertz
             << " | " << gaits.at(i).gain << " | " << g.swum.speedBodyLengths << " | "
             << g.swum.strideBodyLengths << " | " << std::setprecision(3) << g.swum.tailAmplitude
             << std::setprecision(2) << " | " << g.swum.strouhal << " | " << g.wave.wavelength
             << " | " << std::setprecision(3) << g.swum.noseAmplitude << std::setprecision(2)
             << " |\n";
    }
    return rows.str();
}

}  // namespace aquarama
