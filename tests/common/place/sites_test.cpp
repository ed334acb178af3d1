// SPDX-License-Identifier: Apache-2.0
// Heads stand where a scene wants them and move nothing else; sites lie on boulders, each kind
// where it belongs.
#include "common/place/sites.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace aquarama::place {
namespace {

PlaceKey plain(std::uint32_t seed) {
    return {.seed = seed, .settled = {{0, -5.75F, -3.6F}, {7.4F, 2.45F, 6.1F}}};
}

PlaceKey withHeads(std::uint32_t seed) {
    PlaceKey place = plain(seed);
    place.heads = {{.xz = {-2.4F, -2.9F}, .radiusMetres = 0.8F, .heightMetres = 1.7F},
                   {.xz = {2.6F, -2.9F}, .radiusMetres = 0.8F, .heightMetres = 0.5F}};
    return place;
}

PlaceKey settled(std::uint32_t seed) {
    PlaceKey place = withHeads(seed);
    for (const config::SiteKind kind : {config::SiteKind::Anemone,
                                        config::SiteKind::Branching,
                                        config::SiteKind::Ledge,
                                        config::SiteKind::Hole,
                                        config::SiteKind::Turf,
                                        config::SiteKind::Cleaning})
        place.sites.push_back({.kind = kind, .number = 8});
    return place;
}

TEST(Heads, haveTheirCrownAtTheWantedHeightAndMoveNothingElse) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        const PlaceKey place = withHeads(seed);
        const std::vector<Rock> before = rocksOf(plain(seed));
        const std::vector<Rock> rocks = rocksOf(place);
        ASSERT_GT(rocks.size(), before.size());
        for (std::size_t i = 0; i < before.size(); ++i) {
            ASSERT_EQ(rocks[i].centre, before[i].centre);
            ASSERT_EQ(rocks[i].seed, before[i].seed);
        }
        for (const config::Head& head : place.heads) {
            float crown = -100;
            for (std::size_t i = before.size(); i < rocks.size(); ++i) {
                const glm::vec2 from{rocks[i].centre.x - head.xz.x, rocks[i].centre.z - head.xz.y};
                if (from.x * from.x + from.y * from.y < 1)
                    crown = std::max(crown, rocks[i].centre.y + rocks[i].radiusMetres);
            }
            EXPECT_NEAR(crown - floorHeight(place, head.xz), head.heightMetres, 0.08F)
                << "seed " << seed;
        }
    }
}

TEST(Sites, areNoneWithoutGroupsOrInTheOpenSea) {
    EXPECT_TRUE(sitesOf(withHeads(1)).empty());
    PlaceKey sea = settled(1);
    sea.kind = config::PlaceKind::OpenSea;
    EXPECT_TRUE(sitesOf(sea).empty());
}

TEST(Sites, lieOnTheirBoulderClearOfSandAndOfOtherBoulders) {
    for (std::uint32_t seed = 0; seed < 6; ++seed) {
        const PlaceKey place = settled(seed);
        const std::vector<Rock> rocks = rocksOf(place);
        const std::vector<Site> sites = sitesOf(place);
        ASSERT_GE(sites.size(), 40U) << "of 48";
        for (const Site& site : sites) {
            const auto host = std::ranges::find(rocks, site.rockSeed, &Rock::seed);
            ASSERT_NE(host, rocks.end());
            EXPECT_NEAR(lengthOf(site.place - host->centre), 0.85F * host->radiusMetres, 1e-3F);
            EXPECT_NEAR(lengthOf(site.normal), 1, 1e-5F);
            EXPECT_GT(site.place.y, floorHeight(place, {site.place.x, site.place.z}) + 0.1F);
            for (const Rock& rock : rocks)
                if (rock.seed != site.rockSeed) {
                    EXPECT_GT(lengthOf(site.place - rock.centre), 0.9F * rock.radiusMetres);
                }
            for (const Site& other : sites)
                if (&other != &site) {
                    EXPECT_GT(lengthOf(site.place - other.place), 0.25F);
                }
        }
    }
}

TEST(Sites, eachKindIsWhereItBelongs) {
    for (const Site& site : sitesOf(settled(1))) switch (site.kind) {
            case config::SiteKind::Anemone:
            case config::SiteKind::Branching:
                EXPECT_GT(site.normal.y, 0.4F);
                break;
            case config::SiteKind::Ledge:
                EXPECT_LT(std::abs(site.normal.y), 0.3F);
                break;
            case config::SiteKind::Cleaning:
                EXPECT_GT(site.normal.y, 0.75F) << "on a crown";
                break;
            case config::SiteKind::Hole:
            case config::SiteKind::Turf:
                EXPECT_GT(site.normal.y, -0.2F);
                break;
        }
}

TEST(Sites, ofTurfAreWhereFishGraze) {
    PlaceKey place = withHeads(1);
    place.sites = {{.kind = config::SiteKind::Turf, .number = 40}};
    const std::vector<Site> sites = sitesOf(place);
    EXPECT_GT(sites.size(), 20U);
    for (const Site& site : sites) EXPECT_TRUE(isGrazed(place.settled, site.place));
    // The borders are 1.1 m wide, the bottom 0.3 m.
    const Region water{{0, 0, 0}, {4, 2, 4}};
    EXPECT_TRUE(isGrazed(water, {2.8F, -1.6F, 2.8F}));
    EXPECT_FALSE(isGrazed(water, {3, 0, 0}));
    EXPECT_FALSE(isGrazed(water, {0, -1.8F, 0}));
    EXPECT_FALSE(isGrazed(water, {0, 1, 0}));
}

TEST(Sites, wantedAtAPlaceLieOnTheBoulderThere) {
    PlaceKey place = withHeads(3);
    place.sites = {{.kind = config::SiteKind::Anemone, .xz = glm::vec2{-2.4F, -2.9F}}};
    const std::vector<Site> sites = sitesOf(place);
    ASSERT_EQ(sites.size(), 1U);
    EXPECT_NEAR(sites[0].place.x, -2.4F, 0.5F);
    EXPECT_NEAR(sites[0].place.z, -2.9F, 0.5F);
    EXPECT_GT(sites[0].place.y, floorHeight(place, {-2.4F, -2.9F}) + 1.1F) << "near its crown";
}

TEST(Sites, areTheSameAtEveryCallAndOthersWithAnotherSeed) {
    const auto places = [](std::uint32_t seed) {
        std::vector<float> x;
        for (const Site& site : sitesOf(settled(seed))) x.push_back(site.place.x);
        return x;
    };
    EXPECT_EQ(places(4), places(4));
    EXPECT_NE(places(4), places(5));
}

}  // namespace
}  // namespace aquarama::place
