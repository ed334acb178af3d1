// SPDX-License-Identifier: Apache-2.0
// The joint problem of cameras, projectors and the screen's bumps, for the least squares of Ceres.
#pragma once

#include <memory>
#include <vector>

#include <glm/vec2.hpp>

#include "calibration/geometry/solved_hall.h"
#include "calibration/geometry/ties.h"

namespace aquarama::geometry {

// What is free: first where things stand, then what lenses do as well, at last the screen too.
enum class FreeParts : std::uint8_t { Poses, Lenses, Bumps };

// A problem that is built of the hall as it is so far; solving it moves the hall, which outlives
// it. `expected`: projectors as the rig has them; what is solved stays near them.
class JointProblem {
  public:
    JointProblem(SolvedHall& hall,
                 const std::vector<Device>& expected,
                 const std::vector<glm::ivec2>& cameraSizes);
    ~JointProblem();
    JointProblem(const JointProblem&) = delete;
    JointProblem& operator=(const JointProblem&) = delete;

    // Standard deviations, pixels of the channel and of the camera. A tie's own is added.
    void add(const Tie& tie, double sigma);
    void add(const OutlineTie& tie, double sigma);
    void solve(FreeParts stage, int mostSteps);

    // After the stage of bumps: how well the place in the panorama of what a camera sees is known,
    // as a standard deviation in its pixels, by the errors of the ties alone.
    [[nodiscard]] std::vector<double> uncertainty(std::size_t camera,
                                                  const std::vector<glm::dvec2>& seen);

  private:
    class Problem;
    std::unique_ptr<Problem> problem_;
};

}  // namespace aquarama::geometry
