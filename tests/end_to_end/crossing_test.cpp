// SPDX-License-Identifier: Apache-2.0
// A fish crosses from one channel to the next: on the simulated screen, wherever both projectors
// light it, it has one shape, one shade, one level of detail and one net of caustics. Also when one
// of the nodes was started a moment ago.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "calibration/compose/compose.h"
#include "common/place/place.h"
#include "common/wall/wall.h"
#include "render_node/show/channel_picture.h"
#include "tests/render_node/show/fake_session.h"

namespace aquarama {
namespace {

constexpr std::size_t kLeft = 0, kMiddle = 1;
constexpr config::QualityTier kQuality = config::QualityTier::High;

session::Admission admissionToTheSea() {
    session::Admission admission = show::admissionTo(wire::Pattern::World);
    admission.rig = wall::shippedRig("touring");  // its overlaps are wide
    constexpr int kSmaller = 5;
    admission.rig.panoramaPixels /= kSmaller;
    for (config::Channel& channel : admission.rig.channels) {
        channel.sizePixels /= kSmaller;
        channel.projector.focalPixels /= kSmaller;
        channel.projector.principalPixels /= kSmaller;
    }
    admission.school = {{.id = 17, .lengthMillimetres = 400}};
    admission.cast = {
        {.file = "bigeye_scad.txtpb",
         .text = show::fileText(AQUARAMA_SOURCE_DIR "/config/species/bigeye_scad.txtpb"),
         .repertoire = motion::encodeRepertoire(test::swaying(test::scadBody(), 0.05F)),
         .fish = 1}};
    return admission;
}

// The scene that a channel alone shows on the unrolled screen, freed of its blend.
class Projected {
  public:
    Projected(const config::Rig& rig, std::size_t channel, show::ChannelPicture& picture)
        : rig_{rig}, wall_{rig}, channel_{channel} {
        const gl::Target target(GL_RGBA16, picture.sizePixels());
        picture.project(target.framebuffer(), show::Encoding::Plain, show::Overlays{});
        const auto pixels = gl::readRgb<std::uint16_t>(target);
        for (const config::Channel& other : rig.channels)
            lights_.push_back(darkness(other.sizePixels));
        lights_[channel] = lightOf({picture.sizePixels(), 16, {pixels.begin(), pixels.end()}});
        panorama_ = compose::composePanorama(rig, lights_);
    }
    [[nodiscard]] double weight(glm::ivec2 at) const {
        const glm::dvec2 place = (glm::dvec2(at) + 0.5) / glm::dvec2(rig_.panoramaPixels);
        return wall_.weight(channel_, wall_.screen().at(place).value());
    }
    // sRGB codes: what the eye weighs alike.
    [[nodiscard]] double code(glm::ivec2 at) const {
        const double light = static_cast<double>(panorama_.at(at.x, at.y).g) / weight(at);
        return 255 * srgbFromLinear(std::clamp(light, 0.0, 1.0));
    }

  private:
    const config::Rig& rig_;
    wall::Wall wall_;
    std::size_t channel_;
    std::vector<Light> lights_;
    Light panorama_;
};

// Of the means of a block of pixels, which both channels must light well.
std::optional<double> blockDifference(const Projected& one,
                                      const Projected& other,
                                      glm::ivec2 corner,
                                      int side) {
    constexpr double kLeastWeight = 0.15;
    double sum = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const glm::ivec2 at = corner + glm::ivec2(x, y);
            if (std::min(one.weight(at), other.weight(at)) < kLeastWeight) return std::nullopt;
            sum += one.code(at) - other.code(at);
        }
    return std::abs(sum) / (side * side);
}

class Crossing : public testing::Test {
  protected:
    static wire::StateFrame frameWithFish(glm::vec3 place, float azimuth) {
        wire::StateFrame frame = show::frameNumber(300);
        frame.eye.positionMetres = place::kEyePosition;
        motion::MotionStates states;
        states.resize(1);
        motion::setBodyFrame(
            states,
            0,
            {.position = place, .rotation = glm::angleAxis(-azimuth, glm::vec3(0, 1, 0))});
        frame.after = {motion::recordOf(states, 0)};
        return frame;
    }
    // The azimuths at the eye's height that both channels light well.
    [[nodiscard]] std::vector<float> overlap() const {
        std::vector<float> azimuths;
        const wall::Wall wall(admission_.rig);
        for (int i = 0; i < 4000; ++i) {
            const glm::dvec3 point = wall.screen().at({i / 4000.0, 0.5}).value();
            if (std::min(wall.weight(kLeft, point), wall.weight(kMiddle, point)) > 0.2)
                azimuths.push_back(static_cast<float>(std::atan2(point.x, -point.z)));
        }
        return azimuths;
    }
    static Projected shown(const config::Rig& rig,
                           std::size_t channel,
                           show::ChannelPicture& picture,
                           const wire::StateFrame& frame) {
        picture.drawScene(frame, show::Overlays{});
        return {rig, channel, picture};
    }

    std::unique_ptr<gl::Context> context_ = gl::makeOffscreenContext("auto", {480, 360});
    session::Admission admission_ = admissionToTheSea();
    show::ChannelPicture left_{admission_, kLeft, kQuality};
    show::ChannelPicture middle_{admission_, kMiddle, kQuality};
};

TEST_F(Crossing, bothProjectorsShowTheSameFish) {
    const config::Rig& rig = admission_.rig;
    const std::vector<float> azimuths = overlap();
    ASSERT_GT(azimuths.size(), 20U);
    // Nearer and nearer, through the levels of detail.
    const std::vector<float> ranges{9.0F, 5.0F, 3.0F, 1.8F, 1.2F};
    constexpr int kBlock = 10;  // both sample the scene on grids of their own: single pixels differ
    double worst = 0;
    int blocks = 0;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const float azimuth = azimuths[(i + 1) * azimuths.size() / (ranges.size() + 1)];
        const glm::vec3 direction(std::sin(azimuth), 0.0F, -std::cos(azimuth));
        const wire::StateFrame frame =
            frameWithFish(place::kEyePosition + ranges[i] * direction, azimuth);
        const Projected one = shown(rig, kLeft, left_, frame);
        const Projected other = shown(rig, kMiddle, middle_, frame);
        for (int y = 0; y + kBlock <= rig.panoramaPixels.y; y += kBlock)
            for (int x = 0; x + kBlock <= rig.panoramaPixels.x; x += kBlock) {
                const auto difference = blockDifference(one, other, {x, y}, kBlock);
                if (!difference) continue;
                worst = std::max(worst, *difference);
                ++blocks;
            }
    }
    RecordProperty("worst_codes", std::to_string(worst));
    EXPECT_GT(blocks, 100);
    EXPECT_LT(worst, 2.0);
}

TEST_F(Crossing, aNodeThatHasJustStartedDrawsWhatAVeteranDraws) {
    const float azimuth = overlap().front();
    const glm::vec3 direction(std::sin(azimuth), 0.0F, -std::cos(azimuth));
    for (int i = 0; i < 3; ++i)
        middle_.drawScene(
            frameWithFish(place::kEyePosition + (4.0F - static_cast<float>(i)) * direction, 0.0F),
            show::Overlays{});
    const wire::StateFrame frame = frameWithFish(place::kEyePosition + 2.0F * direction, azimuth);
    const auto pixelsOf = [&](show::ChannelPicture& picture) {
        picture.drawScene(frame, show::Overlays{});
        const gl::Target target(GL_RGBA16, picture.sizePixels());
        picture.project(target.framebuffer(), show::Encoding::Plain, show::Overlays{});
        return gl::readRgb<std::uint16_t>(target);
    };
    show::ChannelPicture started{admission_, kMiddle, kQuality};
    EXPECT_EQ(pixelsOf(started), pixelsOf(middle_));
}

}  // namespace
}  // namespace aquarama
