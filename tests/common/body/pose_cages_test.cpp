// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include "common/body/cage_tables.h"
#include "common/config/species.h"

namespace aquarama::body {
namespace {

const FishBody& scad() {
    static const FishBody body =
        makeBody(config::readSpecies(AQUARAMA_SOURCE_DIR "/config/species/bigeye_scad.txtpb"));
    return body;
}

// Bent and twisted, of unit length.
NodalPoints swimming(std::mt19937& random) {
    std::normal_distribution<float> normal;
    const float bend = 0.2F * normal(random);
    const float twist = 0.3F * normal(random);
    const auto turn =
        glm::normalize(glm::quat(normal(random), normal(random), normal(random), normal(random)));
    NodalPoints nodes = scad().restNodes;
    for (glm::vec3& node : nodes) {
        const float s = node.x;
        node = glm::angleAxis(twist * s, glm::vec3(1, 0, 0)) * node;
        node = turn * (node + glm::vec3(0, 0, bend * s * s));
    }
    return nodes;
}

TEST(PoseCages, everyInstructionSetPosesFishOfAnyLengthAsTheReferenceDoes) {
    std::mt19937 random(3);
    std::vector<NodalPoints> ofUnitLength(40);
    for (NodalPoints& nodes : ofUnitLength) nodes = swimming(random);
    std::vector<NodalPoints> grown = ofUnitLength;
    std::vector<float> lengths(grown.size());
    for (std::size_t fish = 0; fish < grown.size(); ++fish) {
        lengths[fish] = 0.05F * static_cast<float>(fish + 1);
        for (glm::vec3& node : grown[fish]) node *= lengths[fish];
    }
    const CageTables tables = makeCageTables(scad());
    std::vector<glm::vec3> expected(kControlPoints);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        std::vector<glm::vec3> points(grown.size() * kControlPoints, glm::vec3(NAN));
        poseCages(tables, grown, lengths, points);
        for (std::size_t fish = 0; fish < grown.size(); ++fish) {
            poseCage(scad(), ofUnitLength[fish], expected);
            for (std::size_t i = 0; i < kControlPoints; ++i) {
                const glm::vec3 point = points[fish * kControlPoints + i] / lengths[fish];
                ASSERT_LT(glm::distance(point, expected[i]), 1e-5F)
                    << hwy::TargetName(target) << ", fish " << fish << ", point " << i;
            }
        }
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace
}  // namespace aquarama::body
