// SPDX-License-Identifier: Apache-2.0
// Control points that were recorded against those computed from nodal points (paper, section 3.1).
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/body/cage_tables.h"
#include "common/units/error.h"
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
    const body::FishBody body = test::scad();
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
    const body::FishBody body = test::scad();
    motion::Repertoire repertoire = withoutControlPoints(test::swaying(body, 0.1F));
    for (auto& point : repertoire.segments[2].nodes[5]) point[0] = 32767;
    EXPECT_THROW(static_cast<void>(recordedPoints(body, repertoire)), Error);
}

// Between samples, and between segments, to bend the cage by mixed nodal points is not to mix bent
// cages (eq. 13): the difference is the interpolation's, of the order of the square of a step.
TEST(ComputedControlPoints, areThoseOfEquation13ToAThousandthOfABodyLength) {
    const body::FishBody body = test::scad();
    const motion::Repertoire repertoire = test::swaying(body, 0.1F);
    const motion::ReconstructTables poses = motion::makeReconstructTables(repertoire);
    std::vector<motion::PresentedFish> school;
    for (int i = 0; i < 200; ++i) {
        motion::PresentedFish fish =
            test::fishAt({0.1F, 0, 0}, glm::quat(0.5F, 0.5F, 0.5F, 0.5F), 0.3F);
        fish.segment = static_cast<std::uint32_t>(i % motion::kActions);
        fish.phase = std::fmod(0.377F * static_cast<float>(i), 1.0F);
        school.push_back(fish);
    }
    std::vector<body::NodalPoints> nodes(school.size());
    std::vector<glm::vec3> computed(school.size() * body::kControlPoints);
    std::vector<glm::vec3> recorded(computed.size());
    motion::nodalPoints(poses, school, nodes);
    body::poseCages(
        body::makeCageTables(body), nodes, std::vector<float>(school.size(), 0.3F), computed);
    motion::controlPoints(poses, school, recorded);
    for (std::size_t i = 0; i < computed.size(); ++i)
        ASSERT_LT(glm::distance(computed[i], recorded[i]) / 0.3F, 1e-3F) << i;
}

}  // namespace
}  // namespace aquarama::surface
