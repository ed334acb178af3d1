// SPDX-License-Identifier: Apache-2.0
// What a channel draws for two eyes: the same as for one where they are one, and elsewhere with the
// parallax that the geometry asks for.
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/place/place.h"
#include "common/wall/scan_pattern.h"
#include "common/wall/wall.h"
#include "render_node/show/channel_picture.h"
#include "render_node/show/snapshot.h"
#include "tests/render_node/show/fake_session.h"
#include "tests/support/golden.h"

namespace aquarama::show {
namespace {

constexpr std::size_t kLeft = 0;
constexpr std::size_t kMiddle = 1;

// The desk at half its size, which is as good and drawn four times as fast.
session::Admission admissionInStereo(config::StereoMode mode,
                                     double separationMetres,
                                     config::PlaceKind place) {
    session::Admission admission = admissionTo(wire::Pattern::World);
    halvePictures(admission.rig);
    admission.rig.stereo = {.mode = mode, .eyeSeparationMetres = separationMetres};
    admission.scene.place = place;
    addScad(admission, 300);
    return admission;
}

// In the wall's frame; nose towards the viewer, so that both eyes see the same outline.
wire::StateFrame frameWithAFish(glm::vec3 wallPlace) {
    wire::StateFrame frame = frameNumber(1);
    frame.eye.positionMetres = place::kEyePosition;
    motion::MotionStates states;
    states.resize(1);
    motion::setBodyFrame(states, 0, {.position = place::kEyePosition + wallPlace});
    frame.after = {motion::recordOf(states, 0)};
    return frame;
}

class StereoPictureTest : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::makeOffscreenContext("mesa", {16, 16});
};

TEST_F(StereoPictureTest, eyesWithoutSeparationSeeThePictureOfOneToTheBit) {
    const auto taken = [](config::StereoMode mode) {
        const session::Admission admission = admissionInStereo(mode, 0, config::PlaceKind::OpenSea);
        auto picture =
            std::make_unique<ChannelPicture>(admission, kMiddle, config::QualityTier::Low);
        picture->drawScene(frameWithAFish({0.2F, 0.1F, -2}), {});
        return picture;
    };
    const auto mono =
        takePicture(*taken(config::StereoMode::Mono), PictureBits::Dithered8, Shown::Display);
    const auto two = taken(config::StereoMode::Interlaced);
    for (const Shown shown : {Shown::Display, Shown::LeftEye, Shown::RightEye})
        EXPECT_EQ(takePicture(*two, PictureBits::Dithered8, shown).rgb, mono.rgb)
            << static_cast<int>(shown);
}

// With all that a reef culls and thins out: nothing of the first eye's drawing may reach the
// second.
TEST_F(StereoPictureTest, theSecondEyeIsDrawnAsIfItWereTheFirst) {
    const session::Admission admission =
        admissionInStereo(config::StereoMode::Anaglyph, 0, config::PlaceKind::Reef);
    ChannelPicture picture(admission, kMiddle, config::QualityTier::Low);
    picture.drawScene(frameWithAFish({0.2F, 0.1F, -2}), {});
    EXPECT_EQ(takePicture(picture, PictureBits::Dithered8, Shown::LeftEye).rgb,
              takePicture(picture, PictureBits::Dithered8, Shown::RightEye).rgb);
}

// A camera without glasses measures it: both eyes show the same, in their own pixels.
TEST_F(StereoPictureTest, aScanIsTheSameToBothEyesAndBlackGoesBeforeIt) {
    const session::Admission admission =
        admissionInStereo(config::StereoMode::SideBySide, 0.06, config::PlaceKind::OpenSea);
    ChannelPicture picture(admission, kMiddle, config::QualityTier::Low);
    wire::StateFrame frame = emptySea();
    frame.show.pattern = wire::Pattern::Scan;
    frame.show.brightness = 0.25F;  // no fade dims what is measured
    frame.show.scan = config::ScanPattern{
        .kind = config::ScanPattern::Kind::PhaseColumns, .lit = 1U << kMiddle, .number = 5};
    picture.drawScene(frame, {.warpGrid = true, .help = true});
    const auto taken = [&](Shown shown, PictureBits bits) {
        return takePicture(picture, bits, shown);
    };
    const Picture left = taken(Shown::LeftEye, PictureBits::Dithered8);
    EXPECT_EQ(left.rgb, taken(Shown::RightEye, PictureBits::Dithered8).rgb);
    const Picture pair = taken(Shown::Display, PictureBits::Dithered8);
    const Picture deep = taken(Shown::LeftEye, PictureBits::Deep16);
    const glm::ivec2 size = left.sizePixels;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const auto at = [&](int column) {
                return static_cast<std::size_t>(3 * (y * size.x + column));
            };
            const glm::vec3 light = wall::scanLight(*frame.show.scan, kMiddle, size, {x, y});
            const auto code = std::lround(255 * srgbFromLinear(static_cast<double>(light.r)));
            ASSERT_EQ(left.rgb[at(x)], code) << x << ", " << y;
            ASSERT_EQ(deep.rgb[at(x)], 257 * code) << x << ", " << y;
            ASSERT_EQ(pair.rgb[at(x)], left.rgb[at(2 * (x % (size.x / 2)) + 1)]) << x << ", " << y;
        }
    frame.show.black = true;
    picture.drawScene(frame, {});
    EXPECT_THAT(taken(Shown::Display, PictureBits::Dithered8).rgb, testing::Each(0));
    frame = emptySea();
    picture.drawScene(frame, {});
    EXPECT_THAT(taken(Shown::LeftEye, PictureBits::Dithered8).rgb,
                testing::Contains(testing::Gt(0)));
}

// An upright string of crumbs of food, each at its distance: seen alike by both eyes, as no fish
// is, and so many, a little beside one another, that the pixels' grain is lost in the mean.
std::vector<glm::dvec3> crumbsAt(double distance, double azimuth) {
    std::vector<glm::dvec3> crumbs;
    for (int i = 0; i < 60; ++i) {
        const double turn = azimuth + 0.0005 * (7 * i % 13 - 6);
        crumbs.emplace_back(
            distance * std::sin(turn), distance * 0.008 * (i - 30), -distance * std::cos(turn));
    }
    return crumbs;
}

wire::StateFrame frameWith(const std::vector<glm::dvec3>& crumbs) {
    wire::StateFrame frame = emptySea();
    frame.foodOriginMetres = place::kEyePosition;
    for (const glm::dvec3& crumb : crumbs)
        frame.foodAfter.push_back(
            wire::foodRecord(wire::FoodRecord::Kind::Pellet, glm::vec3(crumb), 1));
    return frame;
}

// An open sea in which both eyes look for crumbs.
class Watched {
  public:
    explicit Watched(std::size_t channel)
        : admission_{admissionInStereo(
              config::StereoMode::SideBySide, 0.063, config::PlaceKind::OpenSea)},
          channel_{channel},
          picture_{admission_, channel, config::QualityTier::Low} {}

    // Column of an eye's picture: the mean of what the crumbs change.
    double columnOf(const std::vector<glm::dvec3>& crumbs, Shown shown) {
        const Light with = seen(frameWith(crumbs), shown);
        const Light without = seen(emptySea(), shown);
        double sum = 0;
        double total = 0;
        for (int y = 0; y < with.sizePixels.y; ++y)
            for (int x = 0; x < with.sizePixels.x; ++x) {
                const glm::dvec3 change = glm::abs(with.at(x, y) - without.at(x, y));
                const double share = change.x + change.y + change.z;
                sum += share * (x + 0.5);
                total += share;
            }
        EXPECT_GT(total, 0.1) << "the crumbs are not seen";
        return sum / total;
    }
    // By geometry alone: where the eye's lines to them meet the screen.
    [[nodiscard]] double askedColumn(const std::vector<glm::dvec3>& crumbs,
                                     wall::EyeSide side) const {
        const config::Rig& rig = admission_.rig;
        const glm::dvec3 eye = wall::eyePosition(rig, side);
        double sum = 0;
        for (const glm::dvec3& crumb : crumbs) {
            const auto lit = wall::makeSurface(rig)->hit({eye, crumb - eye}, 1).value();
            sum += wall::Wall(rig).channel(channel_).pixelOf(lit).value().x;
        }
        return sum / static_cast<double>(crumbs.size());
    }
    [[nodiscard]] const config::Rig& rig() const { return admission_.rig; }

  private:
    Light seen(const wire::StateFrame& frame, Shown shown) {
        picture_.drawScene(frame, {});
        return lightOf(takePicture(picture_, PictureBits::Deep16, shown));
    }
    session::Admission admission_;
    std::size_t channel_;
    ChannelPicture picture_;
};

// Crossed before the screen, none on it, uncrossed behind; in the middle and at the side.
TEST_F(StereoPictureTest, whatIsSeenLiesAsFarApartAsItsDistanceAsks) {
    for (const std::size_t channel : {kMiddle, kLeft}) {
        Watched watched(channel);
        const double azimuth = channel == kMiddle ? 0.0 : -0.66;
        const double radius = watched.rig().screen.radiusMetres;
        for (const double distance : {1.3, radius, 5.0}) {
            const auto crumbs = crumbsAt(distance, azimuth);
            const double shown = watched.columnOf(crumbs, Shown::RightEye) -
                                 watched.columnOf(crumbs, Shown::LeftEye);
            const double asked = watched.askedColumn(crumbs, wall::EyeSide::Right) -
                                 watched.askedColumn(crumbs, wall::EyeSide::Left);
            EXPECT_NEAR(shown, asked, 0.15) << "channel " << channel << ", " << distance << " m";
        }
    }
}

TEST_F(StereoPictureTest, swappedEyesChangePlacesOnTheDisplayAlone) {
    const auto taken = [](bool swapped) {
        session::Admission admission =
            admissionInStereo(config::StereoMode::TopBottom, 0.063, config::PlaceKind::OpenSea);
        admission.rig.stereo.swapEyes = swapped;
        ChannelPicture picture(admission, kMiddle, config::QualityTier::Low);
        picture.drawScene(frameWithAFish({0, 0, -1.5}), {});
        return std::pair{takePicture(picture, PictureBits::Deep16, Shown::LeftEye).rgb,
                         takePicture(picture, PictureBits::Deep16, Shown::Display).rgb};
    };
    const auto [left, display] = taken(false);
    const auto [leftOfSwapped, swapped] = taken(true);
    EXPECT_EQ(left, leftOfSwapped);
    const auto half = static_cast<std::ptrdiff_t>(display.size() / 2);
    EXPECT_TRUE(std::equal(display.begin(), display.begin() + half, swapped.begin() + half));
    EXPECT_NE(display, swapped);
}

TEST_F(StereoPictureTest, aPairAndItsAnaglyphAreTheGoldenOnes) {
    ChannelPicture picture(
        admissionInStereo(config::StereoMode::Anaglyph, 0.063, config::PlaceKind::Reef),
        kMiddle,
        config::QualityTier::Low);
    picture.drawScene(frameWithAFish({0.15F, 0.05F, -1.2F}), {});
    using test::expectGolden;
    test::expectGolden(takePicture(picture, PictureBits::Dithered8, Shown::LeftEye),
                       "stereo/left_eye");
    test::expectGolden(takePicture(picture, PictureBits::Dithered8, Shown::RightEye),
                       "stereo/right_eye");
    test::expectGolden(takePicture(picture, PictureBits::Dithered8, Shown::Display),
                       "stereo/anaglyph");
}

}  // namespace
}  // namespace aquarama::show
