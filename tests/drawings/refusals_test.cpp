// SPDX-License-Identifier: Apache-2.0
// What is no drawing is refused, for the right reason, in one line. With AQUARAMA_SOAK in the
// environment 200 other pictures are tried, else one of each kind.
#include <cstdlib>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drawings/catalogue.h"
#include "drawings/read.h"
#include "drawings/refusal.h"
#include "tests/drawings/other_pictures.h"
#include "tests/drawings/snapshot.h"

namespace aquarama {
namespace {

using drawings::RefusalReason;
using test::TagFault;

class Refusals : public testing::Test {
  protected:
    // Why a picture is refused; nothing where it is not.
    std::optional<RefusalReason> reasonOf(const drawings::Photo& photo) {
        try {
            static_cast<void>(
                readDrawing(photo, [this](int number) { return catalogue_.sheetOf(number); }));
        } catch (const drawings::Refusal& refusal) {
            return refusal.reason();
        }
        return std::nullopt;
    }
    // Of a sheet that lies before the camera.
    std::optional<RefusalReason> reasonOf(const test::PaintedSheet& paper,
                                          const test::Circumstances& how = {}) {
        return reasonOf(photographed(paper, how, test::Camera(how, drawings::kA4)));
    }
    drawings::Catalogue catalogue_;
    const drawings::Sheet& sheet_ = catalogue_.sheetOf("clownfish");
    test::PaintedSheet paper_ = test::printed(sheet_, drawings::kA4);
};

TEST_F(Refusals, eachFaultOfTagsHasItsReason) {
    const auto reason = [this](TagFault fault) {
        return reasonOf(test::withFault(sheet_, paper_, fault, 1));
    };
    EXPECT_EQ(reasonOf(paper_), std::nullopt);
    EXPECT_EQ(reason(TagFault::OtherFamily), RefusalReason::NoSheet);
    EXPECT_EQ(reason(TagFault::RandomModules), RefusalReason::NoSheet);
    EXPECT_EQ(reason(TagFault::TwoOnly), RefusalReason::TooFewCorners);
    EXPECT_EQ(reason(TagFault::SeveralSpecies), RefusalReason::SeveralSheets);
    EXPECT_EQ(reason(TagFault::Exchanged), RefusalReason::NotFlat);
    EXPECT_EQ(reason(TagFault::OtherVersion), RefusalReason::OtherVersion);
    EXPECT_EQ(reason(TagFault::UnknownSpecies), RefusalReason::UnknownSpecies);
}

TEST_F(Refusals, whatCannotBeSeenIsSaid) {
    EXPECT_EQ(reasonOf(paper_, {.sizePixels = {900, 675}, .filling = 0.2}),
              RefusalReason::TooSmall);
    EXPECT_EQ(reasonOf(paper_, {.exposure = 0.01, .noise = 0}), RefusalReason::TooDark);
    // So near that the right end is outside, as is a tag.
    EXPECT_EQ(reasonOf(paper_, {.aside = 0.16}), RefusalReason::TooFewCorners);
}

TEST_F(Refusals, noOtherPictureIsLetThrough) {
    const std::uint32_t count = std::getenv("AQUARAMA_SOAK") != nullptr ? 200 : 12;
    for (std::uint32_t number = 0; number < count; ++number)
        EXPECT_NE(reasonOf(test::otherPicture(catalogue_, number)), std::nullopt) << number;
}

TEST(Reasons, eachHasALineThatSaysWhatToDo) {
    for (int reason = 0; reason <= static_cast<int>(RefusalReason::TooDark); ++reason) {
        const std::string line = drawings::lineOf(static_cast<RefusalReason>(reason));
        EXPECT_THAT(line, testing::HasSubstr("; "));
        EXPECT_EQ(line.find('\n'), std::string::npos);
    }
}

}  // namespace
}  // namespace aquarama
