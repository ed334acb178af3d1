// SPDX-License-Identifier: Apache-2.0
// The checks of a scan, each with small copies made by hand.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/scan/dropped_frames.h"
#include "calibration/scan/movement.h"
#include "calibration/scan/room_light.h"

namespace aquarama::scan {
namespace {

using Kind = config::ScanPattern::Kind;
using testing::ElementsAre;
using testing::IsEmpty;

// Two channels side by side before a camera whose small copies have its own pixels.
class Scanned {
  public:
    static constexpr int kColumns = 96, kRows = 40;

    Scanned() {
        for (const char* name : {"left", "right"}) {
            config::Channel& channel = rig_.channels.emplace_back();
            channel.name = name;
            channel.sizePixels = {480, 400};
        }
        view_.sizePixels = small_.sizePixels = {kColumns, kRows};
        view_.channels.resize(2);
        for (std::size_t c = 0; c < 2; ++c) {
            view_.channels[c].light = whiteOf(c, 0);
            for (int i = 0; i < kColumns * kRows; ++i) {
                const bool isLit = view_.channels[c].light[static_cast<std::size_t>(i)] > 0;
                const glm::vec2 place(10 * (i % (kColumns / 2)), 10 * (i / kColumns));
                view_.channels[c].place.push_back(isLit ? place : glm::vec2(NAN));
            }
        }
        add({.light = glm::vec3(0)}, black(0.02F));
    }

    // White of a channel whose picture lies `shift` columns to the right; darker towards its sides.
    static Plane whiteOf(std::size_t channel, double shift) {
        Plane light;
        for (int i = 0; i < kColumns * kRows; ++i) {
            const int x = i % kColumns;
            const double half = kColumns / 2.0;
            const double across = (x + 0.5 - shift) / half - static_cast<double>(channel);
            const bool isLit = across > 0 && across < 1;
            const double bright = (0.5 + 0.1 * std::sin(i / kColumns / 4.0)) *
                                  std::pow(std::sin(std::numbers::pi * across), 2);
            light.push_back(isLit ? static_cast<float>(bright) : 0);
        }
        return light;
    }
    static Plane black(float light) { return Plane(std::size_t{kColumns} * kRows, light); }
    // A picture of so much of a white, on top of a level of black.
    static Plane lit(const Plane& white, float share, float black = 0.02F) {
        Plane light;
        for (const float value : white) light.push_back(black + share * value);
        return light;
    }

    void add(const config::ScanPattern& pattern, Plane light) {
        small_.pictures.push_back({scan_.pictures.size(), std::move(light)});
        scan_.pictures.push_back({.file = "", .pattern = pattern});
    }
    template <class Check>
    [[nodiscard]] std::vector<std::string> causesOf(const Check& check) {
        const Evidence evidence{
            .scan = scan_, .rig = rig_, .view = view_, .small = small_, .channels = notes};
        FaultList faults(evidence);
        check(evidence, SmallChannels(evidence), faults);
        std::vector<std::string> causes;
        for (const ScanFault& fault : faults.all()) causes.push_back(fault.cause);
        return causes;
    }

    std::vector<ChannelNotes> notes{{.step = 10}, {.step = 10}};

  private:
    config::Rig rig_;
    config::Scan scan_{.rig = "", .cameras = {{}}, .pictures = {}};
    CameraView view_;
    SmallPictures small_;
};

TEST(FaultListTest, KeepsOneFaultOfEachAdviceAndKnowsWhetherOneRefuses) {
    static_cast<void>(Scanned().causesOf([](const auto&, const auto&, FaultList& faults) {
        faults.add("moved", "fasten it", false);
        faults.add("moved", "fasten it", false);
        EXPECT_EQ(faults.all().size(), 1U);
        EXPECT_FALSE(faults.refuses());
        faults.add("moved", "fasten the camera");
        EXPECT_EQ(faults.all().size(), 2U);
        EXPECT_TRUE(faults.refuses());
        EXPECT_EQ(faults.channelName(1), "right");
        EXPECT_EQ(faults.pictureName(0), "picture 1");
    }));
}

TEST(SmallChannelsTest, KnowsWhatIsSeenAndAddsLight) {
    static_cast<void>(
        Scanned().causesOf([](const Evidence&, const SmallChannels& channels, FaultList&) {
            ASSERT_EQ(channels.size(), 2U);
            EXPECT_TRUE(channels[0].isSeen());
            EXPECT_NEAR(double{channels.mostLight()}, 0.6, 0.05);
            EXPECT_EQ(channels.lightAt(0, 0b10), 0.0F);
            EXPECT_EQ(channels.lightAt(0, 0b11), channels[0].light[0]);
        }));
}

TEST(DroppedFramesTest, ARepeatedPictureIsNamedAndAnotherIsNot) {
    Scanned scanned;
    const Plane half = Scanned::lit(Scanned::whiteOf(0, 0), 0.5F);
    const Plane dark = Scanned::black(0.02F);
    scanned.add({.kind = Kind::GrayColumns, .lit = 1}, half);
    scanned.add({.kind = Kind::GrayColumns, .step = 1, .lit = 1}, dark);
    EXPECT_THAT(scanned.causesOf(findRepeats), IsEmpty());
    scanned.add({.kind = Kind::GrayColumns, .step = 2, .lit = 1}, dark);
    EXPECT_THAT(scanned.causesOf(findRepeats), ElementsAre("dropped_frame"));
}

TEST(MovementTest, ALevelThatLiesElsewhereIsNamed) {
    const auto left = [](const Evidence& evidence, const SmallChannels& channels, auto& faults) {
        findMovement(evidence, channels, 0, faults);
    };
    Scanned still;
    still.add({.light = glm::vec3(0.8F), .lit = 1}, Scanned::lit(Scanned::whiteOf(0, 0), 0.8F));
    EXPECT_THAT(still.causesOf(left), IsEmpty());
    Scanned moved;  // by 2 pixels of the channel
    moved.add({.light = glm::vec3(0.8F), .lit = 1}, Scanned::lit(Scanned::whiteOf(0, 0.2), 0.8F));
    EXPECT_THAT(moved.causesOf(left), ElementsAre("moved"));
    Scanned shifted;
    shifted.notes[0].shift = -1;
    EXPECT_THAT(shifted.causesOf(left), ElementsAre("moved"));
}

TEST(RoomLightTest, ALaterBlackMustBeTheFirst) {
    Scanned scanned;
    scanned.add({.light = glm::vec3(0)}, Scanned::black(0.025F));
    EXPECT_THAT(scanned.causesOf(findBlackDrift), IsEmpty());
    scanned.add({.light = glm::vec3(0)}, Scanned::black(0.05F));
    EXPECT_THAT(scanned.causesOf(findBlackDrift), ElementsAre("ambient_light"));
}

TEST(RoomLightTest, AnExposureThatChangesAndALampAreToldApart) {
    const config::ScanPattern phase{.kind = Kind::PhaseColumns, .lit = 1};
    const Plane white = Scanned::whiteOf(0, 0);
    Scanned good, exposed, lamp;
    good.add(phase, Scanned::lit(white, 0.5F));
    EXPECT_THAT(good.causesOf(findLightDrift), IsEmpty());
    exposed.add(phase, Scanned::lit(white, 0.35F));
    EXPECT_THAT(exposed.causesOf(findLightDrift), ElementsAre("auto_exposure"));
    lamp.add(phase, Scanned::lit(white, 0.5F, 0.12F));
    EXPECT_THAT(lamp.causesOf(findLightDrift), ElementsAre("ambient_light"));
}

}  // namespace
}  // namespace aquarama::scan
