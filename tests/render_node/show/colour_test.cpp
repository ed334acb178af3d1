// SPDX-License-Identifier: Apache-2.0
// The colour of a channel: what the last pass sends to a projector with its own primaries and
// response, against closed forms.
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "common/formats/mpcdi.h"
#include "common/wall/pattern.h"
#include "render_node/gl/context.h"
#include "render_node/gl/handle.h"
#include "render_node/show/channel_picture.h"
#include "render_node/show/projection.h"
#include "render_node/show/snapshot.h"
#include "tests/render_node/show/fake_session.h"

namespace aquarama::show {
namespace {

constexpr glm::ivec2 kStripSize(512, 16);
constexpr std::uint32_t kColouredChannel = 5;

// A projector's response and the codes that undo it.
struct Curve {
    const char* name;
    std::function<double(double)> light, code;
};

double straight(double at) {
    return at;
}

// A power up to a knee; above it the curve goes on straight to 1, as that of a lamp that is driven
// to its end.
Curve powerWithKnee(const char* name, double gamma, double knee, double lightAtKnee) {
    const auto light = [=](double code) {
        return code <= knee ? lightAtKnee * std::pow(code / knee, gamma)
                            : lightAtKnee + (1 - lightAtKnee) * (code - knee) / (1 - knee);
    };
    const auto code = [=](double wanted) {
        return wanted <= lightAtKnee
                   ? knee * std::pow(wanted / lightAtKnee, 1 / gamma)
                   : knee + (1 - knee) * (wanted - lightAtKnee) / (1 - lightAtKnee);
    };
    return {name, light, code};
}

std::vector<float> sampled(const Curve& curve, int count) {
    std::vector<float> response;
    for (int i = 0; i < count; ++i)
        response.push_back(static_cast<float>(curve.light(i / (count - 1.0))));
    response.back() = 1;
    return response;
}

formats::ChannelColour colourOf(const glm::mat3& mix, const std::vector<float>& response) {
    return {.mix = mix, .response = {response, response, response}};
}

// A picture of columns: each shows the column of the scene at its place.
class ColourTest : public testing::Test {
  protected:
    static ProjectionMap columns() {
        ProjectionMap map{.sizePixels = kStripSize, .placeAndWeight = {}};
        for (int y = 0; y < kStripSize.y; ++y)
            for (int x = 0; x < kStripSize.x; ++x)
                map.placeAndWeight.emplace_back(
                    (static_cast<float>(x) + 0.5F) / kStripSize.x, 0.5F, 1, 0);
        return map;
    }
    // Light of each column; of half floats, so that they are shown as they are.
    void show(const std::function<glm::vec3(int)>& lightOfColumn) {
        std::vector<glm::vec3> light;
        for (int y = 0; y < kStripSize.y; ++y)
            for (int x = 0; x < kStripSize.x; ++x) light.push_back(lightOfColumn(x));
        glTextureSubImage2D(
            scene_.texture(), 0, 0, 0, kStripSize.x, kStripSize.y, GL_RGB, GL_FLOAT, light.data());
        light_ = gl::readRgb<float>(scene_);
    }
    // Fine steps near black, and some light over full white.
    void showGreyRamp() {
        show([](int x) {
            const float root = static_cast<float>(x) * 1.05F / (kStripSize.x - 1);
            return glm::vec3(root * root);
        });
    }
    [[nodiscard]] glm::dvec3 lightAt(std::size_t pixel) const {
        const glm::dvec3 light(light_[3 * pixel], light_[3 * pixel + 1], light_[3 * pixel + 2]);
        return glm::clamp(light, 0.0, 1.0);
    }
    template <class Sample>
    std::vector<Sample> project(const formats::ChannelColour& colour, float brightness = 1) {
        const bool isDeep = sizeof(Sample) == 2;
        const gl::Target target(isDeep ? GL_RGBA16 : GL_RGBA8, kStripSize);
        const ProjectorCodes codes(colour);
        Projection(map_, kColouredChannel)
            .draw({.sceneTexture = scene_.texture(),
                   .framebuffer = target.framebuffer(),
                   .frame = {},
                   .encoding = isDeep ? Encoding::Plain : Encoding::Dithered8,
                   .brightness = brightness,
                   .codes = &codes});
        return gl::readRgb<Sample>(target);
    }

    std::unique_ptr<gl::Context> context_ = gl::makeOffscreenContext("auto", {16, 16});
    ProjectionMap map_ = columns();
    gl::Target scene_{GL_RGBA16F, kStripSize};
    std::vector<float> light_;
};

class ColourOf : public ColourTest, public testing::WithParamInterface<Curve> {};
INSTANTIATE_TEST_SUITE_P(Responses,
                         ColourOf,
                         testing::Values(powerWithKnee("power20", 2.0, 1, 1),
                                         powerWithKnee("power24", 2.4, 1, 1),
                                         powerWithKnee("power20WithAKnee", 2.0, 0.7, 0.8),
                                         powerWithKnee("power24WithAKnee", 2.4, 0.85, 0.6),
                                         Curve{"straight", straight, straight}),
                         [](const testing::TestParamInfo<Curve>& curve) {
                             return curve.param.name;
                         });

// The codes that the projector's curve turns back into the light, within half a code of 8 bits: and
// of a finely sampled response within a twentieth.
TEST_P(ColourOf, codesGiveBackTheLightOfAGreyRamp) {
    showGreyRamp();
    for (const auto& [samples, most] : {std::pair{256, 0.5}, std::pair{1024, 0.12}}) {
        const std::vector<float> response = sampled(GetParam(), samples);
        const auto pixels = project<std::uint16_t>(colourOf(glm::mat3(1), response));
        for (std::size_t i = 0; i < pixels.size() / 3; ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                const double light = lightAt(i).x;
                const double code = pixels[3 * i + c] / 65535.0;
                ASSERT_NEAR(255 * code, 255 * GetParam().code(light), most) << light;
                ASSERT_NEAR(255 * code, 255 * formats::codeFor(response, light), 0.05) << light;
            }
    }
}

TEST_P(ColourOf, theDitherIsRightInTheMeanOfCodes) {
    const std::vector<float> response = sampled(GetParam(), 1024);
    for (const double code : {0.0, 0.7, 10.5, 200.25, 254.8, 255.0}) {
        show([&](int) { return glm::vec3(static_cast<float>(GetParam().light(code / 255))); });
        const auto pixels = project<std::uint8_t>(colourOf(glm::mat3(1), response));
        const double wanted = 255 * formats::codeFor(response, lightAt(0).x);
        double sum = 0;
        for (const std::uint8_t pixel : pixels) {
            ASSERT_NEAR(pixel, wanted, 1.5);
            sum += pixel;
        }
        const auto count = static_cast<double>(pixels.size());
        EXPECT_NEAR(sum / count, wanted, 0.05 + 4 * 0.5 / std::sqrt(count)) << "code " << code;
    }
}

TEST_P(ColourOf, blackStaysBlackAndWhiteWhite) {
    const formats::ChannelColour colour = colourOf(glm::mat3(1), sampled(GetParam(), 300));
    show([](int) { return glm::vec3(0); });
    for (const std::uint8_t code : project<std::uint8_t>(colour)) ASSERT_EQ(code, 0);
    show([](int) { return glm::vec3(1.5F); });
    for (const std::uint8_t code : project<std::uint8_t>(colour)) ASSERT_EQ(code, 255);
    for (const std::uint16_t code : project<std::uint16_t>(colour, 0)) ASSERT_EQ(code, 0);
}

// Primaries of a projector beside those of the wall: some light is beyond it, and clipped.
const glm::mat3 kMix(0.71F, 0.03F, -0.02F, 0.21F, 0.93F, 0.11F, 0.06F, -0.05F, 1.07F);

TEST_F(ColourTest, theMixIsExactAndClipped) {
    show([](int x) {
        const auto wave = [x](float k) {
            return 0.5F + 0.6F * std::sin(k * static_cast<float>(x));
        };
        return glm::vec3(wave(0.013F), wave(0.031F), wave(0.0071F));
    });
    for (const float brightness : {1.0F, 0.25F}) {
        const auto pixels = project<std::uint16_t>(colourOf(kMix, {0, 1}), brightness);
        for (std::size_t i = 0; i < pixels.size() / 3; ++i) {
            const glm::dvec3 raw(light_[3 * i], light_[3 * i + 1], light_[3 * i + 2]);
            const glm::dvec3 shown = glm::clamp(double{brightness} * raw, 0.0, 1.0);
            const glm::dvec3 own = glm::clamp(glm::dmat3(kMix) * shown, 0.0, 1.0);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(pixels[3 * i + static_cast<std::size_t>(c)], 65535 * own[c], 1)
                    << i << ' ' << c;
        }
    }
}

TEST_F(ColourTest, eachOfTheThreeHasItsOwnResponse) {
    showGreyRamp();
    const formats::ChannelColour colour{.mix = glm::mat3(1),
                                        .response = {{{0, 1}, {0, 0.2F, 1}, {0, 0, 0.5F, 1, 1}}}};
    const auto pixels = project<std::uint16_t>(colour);
    for (std::size_t i = 0; i < pixels.size() / 3; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            // Where a response is flat codes of the same light differ: so the light is compared.
            const double light = lightAt(i).x;
            ASSERT_NEAR(formats::lightFor(colour.response[c], pixels[3 * i + c] / 65535.0),
                        light,
                        3e-5 + 5e-4 * std::sqrt(light));
        }
}

// The same codes for a pair as for each eye alone.
TEST_F(ColourTest, pairsHaveIt) {
    showGreyRamp();
    const formats::ChannelColour colour = colourOf(kMix, {0, 0.1F, 0.35F, 1});
    const ProjectorCodes codes(colour);
    const Projection eye(map_, kColouredChannel);
    const gl::Target target(GL_RGBA16, kStripSize);
    const auto packed = [&](config::StereoMode mode) {
        PairProjection(kStripSize, kColouredChannel, mode)
            .draw({scene_.texture(), eye},
                  {scene_.texture(), eye},
                  {.framebuffer = target.framebuffer(),
                   .frame = {},
                   .encoding = Encoding::Plain,
                   .codes = &codes});
        return gl::readRgb<std::uint16_t>(target);
    };
    const auto alone = project<std::uint16_t>(colour);
    EXPECT_EQ(packed(config::StereoMode::Interlaced), alone);
    EXPECT_EQ(packed(config::StereoMode::TopBottom), alone);
}

// A node whose channel has a wall file with a colour.

session::Admission coloured(const formats::ChannelColour& colour, config::StereoMode mode) {
    session::Admission admission = admissionTo(wire::Pattern::Grey);
    config::Rig& rig = admission.rig;
    const wall::WarpMap map = wall::Wall(rig).warp(0);
    formats::Warp warp{.size = map.sizePixels, .samples = {}};
    for (const glm::vec4& pixel : map.pointAndWeight)
        warp.samples.push_back(pixel.w > 0 ? glm::vec3(pixel) : glm::vec3(std::nanf("")));
    formats::WallFile file;
    file.profile = formats::Profile::Screen;
    formats::FileChannel& channel = file.channels.emplace_back();
    channel.name = "left";
    channel.sizePixels = map.sizePixels;
    channel.warp = std::move(warp);
    channel.blend = formats::Mask{.size = {1, 1}, .codes = {255}};
    channel.colour = colour;
    rig.files["hall.mpcdi"] =
        std::make_shared<const std::vector<std::byte>>(formats::encodeMpcdi(file, 2));
    rig.channels[0].wallFile = {"hall.mpcdi", "left", ""};
    rig.stereo = {.mode = mode, .eyeSeparationMetres = 0.06};
    return admission;
}

TEST(ColouredChannel, everyPictureOfItHasItsCodes) {
    const auto context = gl::makeOffscreenContext("auto", {16, 16});
    const formats::ChannelColour colour = colourOf(kMix, {0, 0.02F, 0.2F, 0.5F, 1});
    const glm::dvec3 own = glm::dmat3(kMix) * glm::dvec3(wall::kGreyLight);
    for (const config::StereoMode mode : {config::StereoMode::Mono,
                                          config::StereoMode::QuadBuffer,
                                          config::StereoMode::SideBySide}) {
        ChannelPicture picture(coloured(colour, mode), 0, config::QualityTier::Low);
        picture.drawScene(frameNumber(1, wire::Pattern::Grey), {});
        for (const Shown shown : {Shown::Display, Shown::LeftEye, Shown::RightEye}) {
            const Picture taken = takePicture(picture, PictureBits::Deep16, shown);
            const auto middle = static_cast<std::size_t>(taken.sizePixels.y / 2) *
                                    static_cast<std::size_t>(taken.sizePixels.x) +
                                static_cast<std::size_t>(taken.sizePixels.x / 4);
            for (int c = 0; c < 3; ++c) {
                const auto sample = static_cast<std::size_t>(c);
                EXPECT_NEAR(taken.rgb[3 * middle + sample],
                            65535 * formats::codeFor(colour.response[sample], own[c]),
                            40);
            }
        }
    }
}

}  // namespace
}  // namespace aquarama::show
