// SPDX-License-Identifier: Apache-2.0
// The directions of travel of many fish, which the behaviour reads at every tick.
#pragma once

#include <cstddef>

#include <glm/vec3.hpp>

#include "common/motion/motion_state.h"
#include "common/motion/motor.h"

namespace aquarama::motion {

// The output columns of meanHeadings(), unit vectors in the world frame; owned by the caller.
// Element 0 belongs to the first fish of the call, and each column has room for all.
struct HeadingColumns {
    float *x, *y, *z;
};

// The x axis of meanRotation() of fish [first, last); the same bits on any instruction set. Reads
// the states only: ranges may run on several threads.
void meanHeadings(const MotorTables& tables,
                  const MotionStates& states,
                  std::size_t first,
                  std::size_t last,
                  const HeadingColumns& headings);
// The same for one fish, in plain C++: the reference for tests of meanHeadings().
[[nodiscard]] glm::vec3 meanHeadingReference(const MotorTables& tables,
                                             const MotionStates& states,
                                             std::size_t fish);

// The rotation from the cycle-mean frame to the body frame at the phase of a fish: how far the tail
// beat has turned the body. In a warp it is interpolated between those of the two segments and not
// normalised.
[[nodiscard]] Quaternion swayOf(const MotorTables& tables,
                                const MotionStates& states,
                                std::size_t fish);

}  // namespace aquarama::motion
