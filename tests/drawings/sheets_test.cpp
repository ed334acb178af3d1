// SPDX-License-Identifier: Apache-2.0
// Sheets, the pictures of visitors, and the geometry between them.
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drawings/catalogue.h"
#include "drawings/flatten.h"
#include "drawings/photo.h"
#include "drawings/refusal.h"
#include "drawings/tags.h"
#include "tests/drawings/sample_photos.h"
#include "tests/drawings/snapshot.h"
#include "tests/support/all_species.h"

namespace aquarama {
namespace {

using namespace drawings;

TEST(Sheets, aTagTellsSpeciesVersionAndCorner) {
    for (int id = 0; id < 576; ++id) {
        const auto code = codeOf(id);
        ASSERT_TRUE(code.has_value());
        EXPECT_EQ(idOf(*code), id);
    }
    EXPECT_FALSE(codeOf(576).has_value());
    EXPECT_FALSE(codeOf(-1).has_value());
    EXPECT_EQ(idOf({.species = 2, .version = 1, .corner = Corner::LowerRight}), 10);
}

// Printed sheets are read by the list of later versions.
TEST(Sheets, numbersOfSpeciesStay) {
    const Catalogue catalogue;
    ASSERT_GE(catalogue.names().size(), 17U);
    EXPECT_EQ(catalogue.names()[0], "clownfish");
    EXPECT_EQ(catalogue.names()[6], "blacktip_reef_shark");
    EXPECT_EQ(catalogue.names()[16], "trumpetfish");
    EXPECT_EQ(std::set(catalogue.names().begin(), catalogue.names().end()).size(),
              catalogue.names().size());
}

// The fish keeps clear of the tags, and the skin's rectangle holds it with a margin.
TEST(Sheets, theFishIsLargeAndKeepsClearOfTags) {
    Catalogue catalogue;
    for (const std::string& name : test::allSpeciesNames()) {
        const Sheet& sheet = catalogue.sheetOf(name);
        glm::vec2 least(1e9F), most(-1e9F);
        for (const Polyline& line : sheet.likeness.outline)
            for (const glm::vec2 texel : line) {
                const glm::dvec2 at = sheet.place.sheetAt(texel);
                least = glm::min(least, glm::vec2(at));
                most = glm::max(most, glm::vec2(at));
                EXPECT_GT(texel.x, 4) << name;
                EXPECT_GT(texel.y, 4) << name;
                EXPECT_LT(texel.x, 1020) << name;
                EXPECT_LT(texel.y, 508) << name;
                EXPECT_FALSE(std::abs(at.x) > 132 - 26 && std::abs(at.y) > 96 - 26) << name;
            }
        EXPECT_TRUE(most.x - least.x > 200 || most.y - least.y > 135) << name;
        EXPECT_LE(most.x - least.x, 264.1F) << name;
    }
}

TEST(Sheets, textsOfAllLanguagesAreThere) {
    std::size_t count = 0;
    for (const auto& file :
         std::filesystem::directory_iterator(AQUARAMA_SOURCE_DIR "/console/pages/texts")) {
        ++count;
        EXPECT_GT(lineIn(file.path().stem()).size(), 20U);
    }
    EXPECT_GE(count, 2U);
    EXPECT_THROW(static_cast<void>(lineIn("xx")), Error);
}

TEST(SideViews, texelsAndPlacesAreInverse) {
    const body::SideView view{{-1.1F, -0.3F}, {0.1F, 0.3F}};
    EXPECT_EQ(view.texelAt({-1.1F, 0.3F}), glm::vec2(0, 0));
    EXPECT_EQ(view.texelAt({0.1F, -0.3F}), glm::vec2(1024, 512));
    const glm::vec2 there = view.restAt(view.texelAt({-0.4F, 0.07F}));
    EXPECT_NEAR(there.x, -0.4F, 1e-5);
    EXPECT_NEAR(there.y, 0.07F, 1e-5);
}

TEST(Flattenings, findTheMapOfThreeTags) {
    const test::Circumstances how{.tiltDegrees = 45, .tiltTowardsDegrees = 70, .rollDegrees = 200};
    const test::Camera camera(how, kA4);
    std::vector<Correspondence> pairs;
    for (const auto corner : {Corner::UpperLeft, Corner::LowerRight, Corner::LowerLeft})
        for (const glm::dvec2 at : tagOn(corner)) pairs.push_back({at, camera.photoAt(at)});
    const Flattening flat = flatten(pairs);
    EXPECT_LT(flat.worstMillimetres, 1e-6);
    for (const glm::dvec2 at : {glm::dvec2{120, 90}, glm::dvec2{0, 0}, glm::dvec2{-130, 20}})
        EXPECT_LT(glm::distance(flat.photoAt(at), camera.photoAt(at)), 1e-6);
    EXPECT_LT(flat.pixelsPerMillimetre({0, 0}).x, flat.pixelsPerMillimetre({0, 0}).y);
}

RefusalReason reasonOf(std::span<const std::byte> bytes) {
    try {
        static_cast<void>(decodePhoto(bytes));
    } catch (const Refusal& refusal) {
        return refusal.reason();
    }
    ADD_FAILURE() << "the picture is read";
    return RefusalReason::NoSheet;
}

TEST(Photos, threeFormatsAreRead) {
    const Photo photo = test::gradient();
    const Photo jpeg = decodePhoto(test::jpegOf(photo, 95));
    EXPECT_EQ(jpeg.sizePixels, photo.sizePixels);
    EXPECT_NEAR(jpeg.rgb[3 * 1000], photo.rgb[3 * 1000], 12);
    EXPECT_EQ(decodePhoto(test::pngOf(photo)).rgb, photo.rgb);
    EXPECT_EQ(decodePhoto(test::webpOf(photo)).rgb, photo.rgb);
}

TEST(Photos, damagedAndLargeOnesAreRefused) {
    const std::vector<std::byte> jpeg = test::jpegOf(test::gradient(), 80);
    EXPECT_EQ(reasonOf({}), RefusalReason::NotAPicture);
    EXPECT_EQ(reasonOf(std::span(jpeg).first(jpeg.size() / 2)), RefusalReason::NotAPicture);
    EXPECT_EQ(reasonOf(std::vector<std::byte>(kMostPhotoBytes + 1)), RefusalReason::TooLarge);
    std::vector<std::byte> large = test::pngOf(test::gradient());
    large[18] = large[22] = std::byte{0x30};  // 12288 pixels each way
    EXPECT_EQ(reasonOf(large), RefusalReason::TooLarge);
}

}  // namespace
}  // namespace aquarama
