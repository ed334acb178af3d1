// SPDX-License-Identifier: Apache-2.0
// A reef that is repeated is the same everywhere; each rock and each site has a name of its own.
#include "common/place/reefs.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace aquarama::place {
namespace {

// Three side by side and two behind one another, each 14.8 by 12.2 m.
PlaceKey sixReefs() {
    PlaceKey place{.seed = 4, .settled = {{14.8F, -5.75F, -9.7F}, {22.2F, 2.45F, 12.2F}}};
    place.reefs = {3, 2};
    place.sites = {{.kind = config::SiteKind::Hole, .number = 6},
                   {.kind = config::SiteKind::Turf, .number = 5}};
    return place;
}

TEST(Reefs, TheFirstIsThatOfASingleOne) {
    const Region first = firstReefOf(sixReefs()).settled;
    EXPECT_NEAR(first.centre.x, 0, 1e-5);
    EXPECT_NEAR(first.centre.z, -3.6, 1e-5);
    EXPECT_NEAR(first.halfExtent.x, 7.4, 1e-5);
    EXPECT_NEAR(first.halfExtent.z, 6.1, 1e-5);
}

TEST(Reefs, HaveSandRocksAndSitesAtTheSamePlaces) {
    const PlaceKey place = sixReefs();
    const std::vector<Site> sites = sitesOf(place);
    ASSERT_EQ(sites.size(), 66U);
    const std::vector<Rock> rocks = rocksOf(place);
    const std::size_t own = rocks.size() / reefsOf(place);
    for (std::size_t reef = 0; reef < reefsOf(place); ++reef) {
        const glm::vec3 offset = reefOffset(place, reef);
        for (std::size_t i = 0; i < own; ++i)
            EXPECT_LT(lengthOf(rocks[reef * own + i].centre - rocks[i].centre - offset), 1e-4F);
        for (std::size_t i = 0; i < sites.size(); i += reefsOf(place))
            EXPECT_LT(lengthOf(sites[i + reef].place - sites[i].place - offset), 1e-4F);
        EXPECT_NEAR(
            floorHeight(place, {1 + offset.x, offset.z - 5}), floorHeight(place, {1, -5}), 1e-4F);
    }
}

TEST(Reefs, EachRockHasANameOfItsOwnThatItsSitesTell) {
    const PlaceKey place = sixReefs();
    std::set<std::uint32_t> names;
    for (const Rock& rock : rocksOf(place)) EXPECT_TRUE(names.insert(rock.seed).second);
    for (const Site& site : sitesOf(place)) EXPECT_TRUE(names.contains(site.rockSeed));
}

}  // namespace
}  // namespace aquarama::place
