// SPDX-License-Identifier: Apache-2.0
#include "master/capture/search/gait_table.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <vector>

#include "master/capture/compile/turn.h"
#include "master/capture/search/gait_trial.h"

namespace aquarama::search {

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr std::array kGaits{"slow", "medium", "fast"};

std::string plainName(const config::Species& species) {
    std::string name = species.name;
    std::ranges::replace(name, '_', ' ');
    return name;
}

}  // namespace

std::string gaitTableHead() {
    return "| species | gait | beat, Hz | gain | speed, L/s | stride, L | tail, L | Strouhal | "
           "wavelength, "
           "L | nose, L |\n"
           "|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string gaitTableRows(const config::Species& species) {
    const std::array gaits{species.swim.slow, species.swim.medium, species.swim.fast};
    std::ostringstream rows;
    rows << std::fixed << std::setprecision(2);
    for (std::size_t i = 0; i < kGaits.size(); ++i) {
        const GaitFigures g = steadyFigures(species, gaits.at(i));
        rows << "| " << (i == 0 ? plainName(species) : "") << " | " << kGaits.at(i) << " | "
             << g.beatHertz << " | " << gaits.at(i).gain << " | " << g.swum.speedBodyLengths
             << " | " << g.swum.strideBodyLengths << " | " << std::setprecision(3)
             << g.swum.tailAmplitude << std::setprecision(2) << " | " << g.swum.strouhal << " | "
             << g.wave.wavelength << " | " << std::setprecision(3) << g.swum.noseAmplitude
             << std::setprecision(2) << " |\n";
    }
    return rows.str();
}

std::string turnTableHead() {
    return "| species | gradual, from slow | from medium | from fast | sharp, from slow | from "
           "medium | "
           "from fast |\n|---|---|---|---|---|---|---|\n";
}

std::string turnTableRow(const config::Species& species) {
    std::ostringstream row;
    row << std::fixed << std::setprecision(0) << "| " << plainName(species) << " |";
    const std::vector<capture::TurnSpread> spreads = capture::surveyTurns(species);
    for (const motion::Action turn :
         {motion::Action::TurnLeftGradual, motion::Action::TurnLeftSharp})
        for (const capture::TurnSpread& spread : spreads)
            if (spread.turn == turn)
                row << ' ' << spread.least() * kDegrees << "–" << spread.most() * kDegrees << " |";
    return row.str() + '\n';
}

}  // namespace aquarama::search
