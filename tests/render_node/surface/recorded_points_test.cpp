// SPDX-License-Identifier: Apache-2.0
// Control points that were recorded against those computed from nodal points (paper, section 3.1).
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "render_node/surface/fish_tables.h"
#include "tests/render_node/surface/test_fish.h"

namespace aquarama::surface {
namespace {

motion::Repertoire withoutControlPoints(motion::Repertoire repertoire) {
    for (motion::ActionSegment& segment : repertoire.segments) segment.controlPoints.clear();
    return repertoire;
}

// A ten-thousandth of a body length: nodal points are stored in 16 bits too.
TEST(RecordedPoints, areTheSameWhenComputedFromNodalPoints) {
    const body::FishBody body = test::scadBody();
    const motion::Repertoire repertoire = test::swaying(body, 0.1F);
    const auto recorded = recordedPoints(body, repertoire);
    const auto computed = recordedPoints(body, withoutControlPoints(repertoire));
    ASSERT_EQ(computed.size(), recorded.size());
    for (std::size_t i = 0; i < recorded.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            ASSERT_NEAR(computed[i].at(axis) * motion::kPoseUnit,
                        recorded[i].at(axis) * motion::kPoseUnit,
                        1e-4F);
}

TEST(RecordedPoints, refuseANodalPoseThatCannotBeAFish) {
    const body::FishBody body = test::scadBody();
    motion::Repertoire repertoire = withoutControlPoints(test::swaying(body, 0.1F));
    for (auto& point : repertoire.segments[2].nodes[5]) point[0] = 32767;
    EXPECT_THROW(static_cast<void>(recordedPoints(body, repertoire)), Error);
}

}  // namespace
}  // namespace aquarama::surface
