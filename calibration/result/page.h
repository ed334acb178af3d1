// SPDX-License-Identifier: Apache-2.0
// The page that tells a crew how good a calibration is: one file of HTML that needs no other.
#pragma once

#include <string>
#include <vector>

#include "calibration/geometry/solve.h"
#include "calibration/hall/true_hall.h"
#include "calibration/result/figures.h"
#include "calibration/scan/decode.h"

namespace aquarama::result {

// The contents of a page.
struct CalibrationPage {
    const Figures& figures;
    const geometry::Solved& solved;
    const std::vector<scan::CameraView>& views;
    const hall::TrueHall* truth = nullptr;  // of a simulation
    std::string wallFile = {};              // that was written; empty: none was
};

// The whole page. Takes seconds; uses all processors. Throws Error where the wall file cannot be
// read.
[[nodiscard]] std::string htmlOf(const CalibrationPage& page);

}  // namespace aquarama::result
