// SPDX-License-Identifier: Apache-2.0
#include "capture/film/film_script.h"

#include <algorithm>
#include <cmath>

#include "common/base/units.h"

namespace aquarama::film {

namespace {

using report::Manoeuvre;

// A manoeuvre and how long it is shown. A turn and a fast start last their segment.
struct Scene {
    Manoeuvre manoeuvre;
    double seconds = 0;
};

constexpr Scene kScenes[]{
    // Rest, and what fins do there.
    {Manoeuvre::Brake, 1.2},
    {Manoeuvre::Hover, 2.5},
    {Manoeuvre::PivotLeft, 2.5},
    {Manoeuvre::Hover, 1},
    {Manoeuvre::PitchUp, 0.7},
    {Manoeuvre::Hover, 2},
    // Out of rest through the gaits.
    {Manoeuvre::ForwardSlow, 3.5},
    {Manoeuvre::ForwardMedium, 2.5},
    {Manoeuvre::ForwardFast, 2.5},
    {Manoeuvre::Brake, 1},
    {Manoeuvre::Hover, 1},
    {Manoeuvre::ForwardMedium, 2.5},
    // Curves and turns.
    {Manoeuvre::CurveLeft, 2.5},
    {Manoeuvre::CurveRight, 2.5},
    {Manoeuvre::ForwardMedium, 1.2},
    {Manoeuvre::TurnLeftGradual},
    {Manoeuvre::ForwardMedium, 1.2},
    {Manoeuvre::TurnRightGradual},
    {Manoeuvre::ForwardMedium, 1.2},
    {Manoeuvre::TurnLeftSharp},
    {Manoeuvre::ForwardMedium, 1.2},
    {Manoeuvre::TurnRightSharp},
    {Manoeuvre::ForwardMedium, 1.2},
    // Slopes.
    {Manoeuvre::Ascend, 3},
    {Manoeuvre::Balance, 2},
    {Manoeuvre::Descend, 3},
    {Manoeuvre::Balance, 2},
    // Ways to stop.
    {Manoeuvre::Glide, 1.5},
    {Manoeuvre::ForwardMedium, 1.5},
    {Manoeuvre::Brake, 1},
    {Manoeuvre::Retreat, 2.5},
    {Manoeuvre::Hover, 1.5},
    // Fast starts, from rest and from swimming.
    {Manoeuvre::StartLeftLarge},
    {Manoeuvre::ForwardFast, 0.8},
    {Manoeuvre::ForwardMedium, 1.5},
    {Manoeuvre::StartRightMiddle},
    {Manoeuvre::ForwardFast, 0.8},
    {Manoeuvre::ForwardMedium, 1.5},
    {Manoeuvre::StartLeftSmall},
    {Manoeuvre::ForwardFast, 0.8},
    {Manoeuvre::Brake, 1},
    {Manoeuvre::Hover, 1.5},
    {Manoeuvre::StartRightLarge},
    {Manoeuvre::ForwardFast, 1},
    {Manoeuvre::Glide, 1.5},
};

}  // namespace

report::Script filmScript(const motion::Repertoire& repertoire, double seconds) {
    report::Script script{report::runIn(repertoire)};
    for (const Scene& scene : kScenes) {
        report::ScriptCommand command = report::briefest(repertoire, scene.manoeuvre);
        if (!report::playsToEnd(scene.manoeuvre))
            command.ticks = std::max(
                command.ticks, static_cast<int>(std::lround(scene.seconds * kTicksPerSecond)));
        const int left =
            static_cast<int>(std::ceil(seconds * kTicksPerSecond)) - report::ticksOf(script);
        command.ticks = std::min(command.ticks, left);
        if (command.ticks <= 0) break;
        script.push_back(command);
    }
    return script;
}

}  // namespace aquarama::film
