// SPDX-License-Identifier: Apache-2.0
// What a frame of a wall gives a card to do, at its full size, without times.
#pragma once

#include <ostream>
#include <string>

#include "common/config/rig.h"
#include "tests/bench/gpu/call_counter.h"
#include "tests/bench/gpu/sea.h"

namespace aquarama::bench {

// The second frame of the sea on all channels: the first makes what is made once. Each channel has
// a scene of its own, and goes before the next comes.
[[nodiscard]] CallCounts countedWall(const Sea& sea,
                                     const config::Rig& rig,
                                     config::QualityTier quality,
                                     CallCounter& counter);

// The form in which counts are kept: a line for each kind of call.
inline constexpr const char* kCountsHead =
    "wall,stage,program,calls,vertices,primitives,fragments,samples,target_samples,pixel_bytes,"
    "computed,bytes";
void writeCounts(std::ostream& file, const std::string& wall, const CallCounts& counts);

}  // namespace aquarama::bench
