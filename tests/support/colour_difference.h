// SPDX-License-Identifier: Apache-2.0
// How different two colours look: CIEDE2000 (Sharma, Wu and Dalal 2005).
#pragma once

#include <glm/vec3.hpp>

namespace aquarama::test {

[[nodiscard]] double ciede2000(glm::dvec3 labA, glm::dvec3 labB);
// Of linear Rec. 709, whose white is (1, 1, 1); what is outside the gamut counts as it is.
[[nodiscard]] glm::dvec3 labOf(glm::dvec3 rgb);

}  // namespace aquarama::test
