// SPDX-License-Identifier: Apache-2.0
#include "master/capture/search/search_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace aquarama::search {

namespace {

// Contraction is none of them: swimming knows only its product with the drives, and turns need it.
// Stiffness counts all three kinds together, whose ratios a species keeps; its frequencies and time
// scale are its own, and gains are relative to medium swimming.
struct Parameter {
    double least, most;
    double (*get)(const config::Species&);
    void (*set)(config::Species&, double);
};

void setStiffness(config::Species& s, double stiffness) {
    const double factor = stiffness / s.tissue.stiffness;
    s.tissue.stiffness *= factor;
    s.tissue.crossStiffness *= factor;
    s.tissue.muscleStiffness *= factor;
}

constexpr double kHalfBeat = std::numbers::pi;
constexpr std::array kParameters{
    Parameter{150, 1500, [](const config::Species& s) { return s.tissue.stiffness; }, setStiffness},
    Parameter{0.8,
              4,
              [](const config::Species& s) { return s.tissue.tailStiffening; },
              [](config::Species& s, double v) { s.tissue.tailStiffening = v; }},
    Parameter{0.2,
              8,
              [](const config::Species& s) { return s.tissue.damping; },
              [](config::Species& s, double v) { s.tissue.damping = v; }},
    Parameter{150,
              900,
              [](const config::Species& s) { return s.water.drag; },
              [](config::Species& s, double v) { s.water.drag = v; }},
    Parameter{0.1,
              0.7,
              [](const config::Species& s) { return s.water.frontFactor; },
              [](config::Species& s, double v) { s.water.frontFactor = v; }},
    Parameter{0.1,
              1,
              [](const config::Species& s) { return s.swim.middleDrive; },
              [](config::Species& s, double v) { s.swim.middleDrive = v; }},
    Parameter{0.2,
              1,
              [](const config::Species& s) { return s.swim.backDrive; },
              [](config::Species& s, double v) { s.swim.backDrive = v; }},
    Parameter{0.35 * kHalfBeat,
              kHalfBeat,
              [](const config::Species& s) { return s.swim.backLagRadians; },
              [](config::Species& s, double v) { s.swim.backLagRadians = v; }},
    Parameter{0.3,
              1.6,
              [](const config::Species& s) { return s.swim.slow.gain; },
              [](config::Species& s, double v) { s.swim.slow.gain = v; }},
    Parameter{0.3,
              1.6,
              [](const config::Species& s) { return s.swim.fast.gain; },
              [](config::Species& s, double v) { s.swim.fast.gain = v; }},
};

}  // namespace

SearchPoint pointOf(const config::Species& species) {
    SearchPoint point;
    for (const Parameter& p : kParameters)
        point.push_back(
            std::clamp(std::log(p.get(species) / p.least) / std::log(p.most / p.least), 0.0, 1.0));
    return point;
}

config::Species speciesAt(const SearchPoint& point, const config::Species& species) {
    config::Species changed = species;
    for (std::size_t i = 0; i < kParameters.size(); ++i) {
        const Parameter& p = kParameters.at(i);
        p.set(changed, p.least * std::pow(p.most / p.least, std::clamp(point.at(i), 0.0, 1.0)));
    }
    return changed;
}

}  // namespace aquarama::search
