// SPDX-License-Identifier: Apache-2.0
// Projectors and cameras of simulated halls are moved by known amounts between two nights.
#include "calibration/drift/drift.h"

#include <cmath>
#include <cstdlib>
#include <map>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/hall/random_hall.h"
#include "calibration/hall/simulated_camera.h"
#include "calibration/hall/true_hall.h"
#include "common/base/log.h"
#include "common/base/units.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::drift {
namespace {

constexpr double kScale = 0.25;

// A hall and its dots as they were learned.
class Night {
  public:
    explicit Night(std::uint32_t seed)
        : rig(hall::randomRig(seed, kScale)), hall(hall::randomHall(rig, seed, kScale)) {
        const hall::TrueHall truth(rig, hall);
        hall::SimulatedCamera camera(truth, scan::dotSequenceOf(rig, true), seed);
        reference = {.learned = "2026-11-24T21:03:01Z",
                     .cameraPixels = hall.camera.sizePixels,
                     .dots = numberedDots(camera, rig)};
    }
    [[nodiscard]] WallDrift after(const config::Hall& now) const {
        const hall::TrueHall truth(rig, now);
        hall::SimulatedCamera camera(truth, scan::dotSequenceOf(rig, false), 77);
        return driftOf(reference, foundAgain(camera, reference.dots), rig);
    }
    // By how much a channel's dots moved, in its own pixels, root mean square.
    [[nodiscard]] double trueShift(const config::Hall& now, std::size_t channel) const {
        const hall::TrueHall before(rig, hall), after(rig, now);
        const glm::ivec2 size = rig.channels[channel].sizePixels;
        double squares = 0;
        int count = 0;
        for (int dot = 0; dot < wall::kScanDotCount; ++dot) {
            const glm::dvec2 pixel = wall::scanDotPlace(dot, size);
            const auto point = after.pointOf(channel, pixel);
            const auto was = point ? before.pixelOf(channel, *point) : std::nullopt;
            if (!was) continue;
            squares += glm::dot(*was - pixel, *was - pixel);
            ++count;
        }
        return std::sqrt(squares / count);
    }

    config::Rig rig;
    config::Hall hall;
    Reference reference;
};

const Night& nightOf(std::uint32_t seed) {
    static std::map<std::uint32_t, Night> nights;
    return nights.try_emplace(seed, seed).first->second;
}

class DriftOfHall : public testing::TestWithParam<std::uint32_t> {
  protected:
    // Each channel's shift is measured, and blamed on nobody else.
    void expectShifts(const config::Hall& now, const std::string& what) const {
        const WallDrift drift = night.after(now);
        ASSERT_FALSE(drift.isCameraLost) << what;
        for (std::size_t i = 0; i < drift.channels.size(); ++i) {
            const double truth = night.trueShift(now, i);
            const ChannelDrift& channel = drift.channels[i];
            std::printf("%s, channel %zu: %.3f px, in truth %.3f, of %zu dots; camera %.2f\n",
                        what.c_str(),
                        i,
                        channel.shift,
                        truth,
                        channel.dots,
                        drift.cameraPixels);
            EXPECT_NEAR(channel.shift, truth, 0.1) << what << ", channel " << i;
            EXPECT_NE(channel.verdict, DriftVerdict::NotSeen) << what << ", channel " << i;
            if (truth > 0.6) {
                EXPECT_EQ(channel.verdict, DriftVerdict::Moved) << what << ", channel " << i;
            }
            if (truth < 0.4) {
                EXPECT_EQ(channel.verdict, DriftVerdict::InPlace) << what << ", channel " << i;
            }
        }
    }
    [[nodiscard]] config::Hall turned(std::size_t channel,
                                      double yaw,
                                      double pitch,
                                      double roll) const {
        config::Hall now = night.hall;
        const double focal = night.rig.channels[channel].projector.focalPixels.x;
        now.projectors[channel].turnedRadians += glm::dvec3(yaw, pitch, roll) / focal;
        return now;
    }
    [[nodiscard]] config::Hall nudged(config::Hall now, glm::dvec3 pixels) const {
        config::HallCamera& camera = now.camera;
        const double far = glm::distance(camera.positionMetres, camera.lookAtMetres);
        camera.lookAtMetres += far / camera.focalPixels * glm::dvec3(pixels.x, pixels.y, 0);
        camera.rollRadians += pixels.z / camera.focalPixels;
        return now;
    }

    const Night& night = nightOf(GetParam());
};
std::vector<std::uint32_t> seeds() {
    if (std::getenv("AQUARAMA_SOAK") == nullptr) return {1, 5};
    return {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
}
INSTANTIATE_TEST_SUITE_P(Seeds, DriftOfHall, testing::ValuesIn(seeds()));

TEST_P(DriftOfHall, isNoneWhereNothingMoved) {
    expectShifts(night.hall, "nothing");
}

TEST_P(DriftOfHall, isThatOfTheProjectorThatWasTurned) {
    expectShifts(turned(0, 0.3, 0, 0), "0.3 px of yaw");
    expectShifts(turned(1, 1.5, -0.9, 0.8), "yaw, pitch and roll");
}

TEST_P(DriftOfHall, isNotBlamedOnProjectorsWhereTheCameraWasNudged) {
    expectShifts(nudged(night.hall, {1.7, -1.2, 1.5}), "camera");
}

TEST_P(DriftOfHall, isToldFromTheCamerasWhereBothMoved) {
    expectShifts(nudged(turned(1, -1.5, 0.4, 0), {-1.5, 0.9, -1}), "camera and projector");
}

TEST(Drift, ofAHiddenChannelIsNotSeen) {
    const Night& night = nightOf(5);
    std::vector<SeenDot> found = night.reference.dots;
    std::erase_if(found, [](const SeenDot& dot) { return dot.channel == 1 && dot.dot > 3; });
    const WallDrift drift = driftOf(night.reference, found, night.rig);
    EXPECT_EQ(drift.channels[1].verdict, DriftVerdict::NotSeen);
    EXPECT_EQ(drift.channels[0].verdict, DriftVerdict::InPlace);
    EXPECT_THAT(lineOf(night.rig.channels[1], drift.channels[1]),
                testing::HasSubstr("dots are found"));
}

TEST(Drift, referencesAreReadAsTheyWereWritten) {
    const Night& night = nightOf(5);
    const std::string text = textOf(night.reference, night.rig);
    const Reference read = parseReference(text, "hall.drift.json", night.rig);
    ASSERT_EQ(read.dots.size(), night.reference.dots.size());
    for (std::size_t i = 0; i < read.dots.size(); ++i) {
        EXPECT_EQ(read.dots[i].place, night.reference.dots[i].place);
        EXPECT_EQ(read.dots[i].channel, night.reference.dots[i].channel);
        EXPECT_EQ(read.dots[i].dot, night.reference.dots[i].dot);
    }
    for (std::size_t length = 0; length + 2 < text.size(); length += 101)
        EXPECT_THROW((void)parseReference(text.substr(0, length), "cut", night.rig), Error);
    config::Rig other = night.rig;
    other.channels[0].name = "another";
    EXPECT_THROW((void)parseReference(text, "hall.drift.json", other), Error);
}

}  // namespace
}  // namespace aquarama::drift
