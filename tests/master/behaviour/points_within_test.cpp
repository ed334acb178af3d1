// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/points_within.h"

#include <bit>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "common/place/place.h"
#include "master/behaviour/grids.h"
#include "tests/master/behaviour/scattered_school.h"

namespace aquarama::behaviour {
namespace {

const place::Region kPointsWater{{1, -6, -5}, {4, 3, 5}};
using Found = std::vector<std::tuple<std::uint32_t, std::uint32_t>>;  // who, how far to the bit

Found byPlainCode(const SpatialGrid& grid, glm::vec3 place, float reachSquared) {
    Found found;
    for (std::size_t slot = 0; slot < grid.size(); ++slot) {
        const glm::vec3 offset = glm::vec3{grid.x()[slot], grid.y()[slot], grid.z()[slot]} - place;
        if (place::dot(offset, offset) <= reachSquared)
            found.emplace_back(grid.index()[slot],
                               std::bit_cast<std::uint32_t>(place::dot(offset, offset)));
    }
    return found;
}

Found byVectors(const SpatialGrid& grid, glm::vec3 place, float reachSquared) {
    Found found;
    visitPointsWithin(
        grid, place, reachSquared, [&](std::uint32_t index, glm::vec3 offset, float squared) {
            EXPECT_EQ(squared, place::dot(offset, offset));
            found.emplace_back(index, std::bit_cast<std::uint32_t>(squared));
        });
    return found;
}

// From within the water, at its border and out of it; from nobody to more than are taken at once.
TEST(PointsWithin, areThoseOfPlainCodeToTheBit) {
    const fish::FishView view = scatteredSchool(4, 3000, kPointsWater);
    Grids grids(kPointsWater, view.size(), 0);
    const std::vector<fish::SpeciesParameters> speciesParameters(1);
    grids.rebuild(view, {}, speciesParameters);
    std::size_t most = 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        for (const float reach : {0.0F, 0.1F, 0.7F, 2.5F, 20.0F})
            for (const glm::vec3 place : {view.position(7),
                                          kPointsWater.centre + kPointsWater.halfExtent,
                                          kPointsWater.centre - 1.2F * kPointsWater.halfExtent}) {
                const Found found = byVectors(grids.fish, place, reach * reach);
                EXPECT_EQ(found, byPlainCode(grids.fish, place, reach * reach)) << reach;
                most = std::max(most, found.size());
            }
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GT(most, PointsWithin::kRoom);
}

}  // namespace
}  // namespace aquarama::behaviour
