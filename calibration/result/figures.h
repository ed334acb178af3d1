// SPDX-License-Identifier: Apache-2.0
// Judges a calibration: its errors, and whether it may be used.
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

// What becomes of a calibration, and its word.
enum class Judgement : std::uint8_t { Pass, Warn, Refuse };
[[nodiscard]] const char* nameOf(Judgement judgement);

// Whether a calibration may be used, and the first of its worst faults.
struct CalibrationVerdict {
    Judgement judgement = Judgement::Pass;
    std::string cause, advice;  // empty where it passes
};

// Errors of a wall in panorama pixels: between two channels that show one point, and between the
// place that a channel shows at a point and the right one.
struct WallErrors {
    std::vector<double> overlap, absolute;
};

// The errors of a wall file in a simulated hall, at this number of points of the screen.
[[nodiscard]] WallErrors errorsOf(const hall::TrueHall& truth,
                                  const config::Rig& rig,
                                  const formats::WallFile& file,
                                  std::size_t points);

// The errors of a wall file by the truth of a simulated hall.
struct TrueFigures {
    geometry::OverlapFigures overlap;
    double absoluteRms = 0;  // of the picture's place, panorama pixels
    light::Seams seams;
};
[[nodiscard]] TrueFigures trueFigures(const WallErrors& errors, const light::Seams& seams);

// All that is known about a calibration.
struct Figures {
    CalibrationVerdict verdict;
    geometry::SolveFigures solve;
    // Of the light by the camera's pictures; nothing where it was not measured.
    std::optional<light::BrightnessFigures> brightness = {};
    std::optional<light::ForeseenSeams> foreseen = {};
    std::optional<TrueFigures> truth = {};  // in a simulated hall
    double seconds = 0;
    std::size_t pictures = 0;
    double peakMegabytes = 0;

    // By the truth where it is known, else by the solve.
    [[nodiscard]] const geometry::OverlapFigures& overlap() const {
        return truth ? truth->overlap : solve.overlap;
    }
    // The error of the picture's place by the truth where it is known, else the error to expect.
    [[nodiscard]] double absoluteRms() const {
        return truth ? truth->absoluteRms : solve.absoluteSigma;
    }
};

// By the scan and the solve alone; the truth is not used.
[[nodiscard]] CalibrationVerdict judged(const std::vector<scan::CameraView>& views,
                                        const geometry::Solved& solved);
// With a warning where light was not measured or seams will be visible.
[[nodiscard]] CalibrationVerdict judgedLight(
    CalibrationVerdict verdict,
    const std::optional<light::BrightnessFigures>& brightness,
    const std::optional<light::ForeseenSeams>& seams);

// {"verdict": "pass", "cause": "", ...}; null for what was not measured, such as the overlap of a
// wall without overlaps.
[[nodiscard]] std::string jsonOf(const Figures& figures);

}  // namespace aquarama::result
