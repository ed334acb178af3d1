// SPDX-License-Identifier: Apache-2.0
// How good a calibration is, and whether it may be used.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calibration/geometry/solve.h"
#include "calibration/hall/true_hall.h"
#include "calibration/light/brightness.h"
#include "calibration/light/foresight.h"
#include "calibration/light/seams.h"
#include "common/formats/wall_file.h"

namespace aquarama::result {

enum class Judgement : std::uint8_t { Pass, Warn, Refuse };
[[nodiscard]] const char* nameOf(Judgement verdict);

// Errors of a wall in panorama pixels: between two channels that show one point, and between what
// a channel shows at a point and what belongs there.
struct WallErrors {
    std::vector<double> overlap, absolute;
};

// Of a wall file in a hall whose truth is known, at so many points of the screen.
[[nodiscard]] WallErrors errorsOf(const hall::TrueHall& truth,
                                  const config::Rig& rig,
                                  const formats::WallFile& file,
                                  std::size_t points);

struct Figures {
    Judgement verdict = Judgement::Refuse;
    std::string cause, advice;  // empty where it passes
    double overlapRms = 0, overlapP95 = 0, overlapMax = 0;
    // From the truth of a simulated hall; else how well the solve knows the whole picture's place.
    double absoluteRms = 0;
    bool isTrue = false;  // from ground truth
    std::size_t overlapPoints = 0;
    double outlineRms = 0, fitRms = 0;
    std::optional<light::BrightnessFigures> brightness =
        {};                                  // nothing: light and colour are not measured
    std::optional<light::Seams> seams = {};  // from ground truth
    // From the camera's pictures alone; what figures tell where there is no truth.
    std::optional<light::ForeseenSeams> foreseen = {};
    double seconds = 0;
    std::size_t pictures = 0;
    double peakMegabytes = 0;
};

// What the scan and the solve say of themselves; truth is no part of it.
[[nodiscard]] Figures judged(const std::vector<scan::CameraView>& views,
                             const geometry::Solved& solved);
// What evening the light costs; a warning where it could not be measured.
void setBrightness(Figures& figures, const std::optional<light::BrightnessFigures>& brightness);
// Seams that are foreseen; a warning where they can be seen.
void setForeseen(Figures& figures, const std::optional<light::ForeseenSeams>& seams);
// Sets the errors from the truth; the verdict stays.
void setTrue(Figures& figures, WallErrors errors);

// {"verdict": "pass", "cause": "", ...}; what was not measured, as how neighbours part on a wall
// where none overlap, is null.
[[nodiscard]] std::string jsonOf(const Figures& figures);

}  // namespace aquarama::result
