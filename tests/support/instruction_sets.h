// SPDX-License-Identifier: Apache-2.0
// Which instruction set vectorised functions may use.
#pragma once

#include <cstdint>

#include <hwy/highway.h>
#include <hwy/targets.h>

namespace aquarama::test {

// One of hwy::SupportedAndGeneratedTargets(); 0 allows all that the processor has.
inline void useOnly(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace aquarama::test
