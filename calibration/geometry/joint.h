// SPDX-License-Identifier: Apache-2.0
// Solves for cameras, projectors and the bumps of the screen together, by least squares (Ceres).
#pragma once

#include <memory>
#include <vector>

#include <glm/vec2.hpp>

#include "calibration/geometry/solved_hall.h"
#include "calibration/geometry/ties.h"

namespace aquarama::geometry {

// The parameters that are free: the poses; the poses and lenses; or these and the screen's bumps.
enum class FreeParts : std::uint8_t { Poses, Lenses, Bumps };

// A problem that starts from the hall as it is. solve() changes the hall, which outlives the
// problem. `expected`: the projectors as the rig has them; the solution stays near them.
class JointProblem {
  public:
    JointProblem(SolvedHall& hall,
                 const std::vector<Device>& expected,
                 const std::vector<glm::ivec2>& cameraSizes);
    ~JointProblem();
    JointProblem(const JointProblem&) = delete;
    JointProblem& operator=(const JointProblem&) = delete;

    // `sigma`: a standard deviation beside the tie's own; pixels of the channel, or of the camera
    // for the outline.
    void add(const Tie& tie, double sigma);
    void add(const OutlineTie& tie, double sigma);
    void solve(FreeParts stage, int mostSteps);

    // The standard deviation of the panorama place of each camera pixel in `seen`, in panorama
    // pixels, by the errors of the ties alone. Call it after the stage of bumps.
    [[nodiscard]] std::vector<double> uncertainty(std::size_t camera,
                                                  const std::vector<glm::dvec2>& seen);

  private:
    class Problem;
    std::unique_ptr<Problem> problem_;
};

}  // namespace aquarama::geometry
