// SPDX-License-Identifier: Apache-2.0
// Where fish head, of many at a time.
#pragma once

#include <cstddef>

#include <glm/vec3.hpp>

#include "common/motion/motion_state.h"
#include "common/motion/motor.h"

namespace aquarama::motion {

struct HeadingColumns {  // unit vectors, world frame; of the first fish asked for at 0
    float *x, *y, *z;
};

// The x axis of meanRotation() of fish [first, last); the same bits on any instruction set.
void meanHeadings(const MotorTables& tables,
                  const MotionStates& states,
                  std::size_t first,
                  std::size_t last,
                  const HeadingColumns& headings);
// The same of one fish by plain code.
[[nodiscard]] glm::vec3 meanHeadingReference(const MotorTables& tables,
                                             const MotionStates& states,
                                             std::size_t fish);

// The cycle-mean frame as its body frame sees it, in a warp between that of two segments.
[[nodiscard]] Quaternion swayOf(const MotorTables& tables,
                                const MotionStates& states,
                                std::size_t fish);

}  // namespace aquarama::motion
