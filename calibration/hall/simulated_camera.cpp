// SPDX-License-Identifier: Apache-2.0
#include "calibration/hall/simulated_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/base/hash.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::hall {

namespace {

constexpr float kWhite = 0.8F;        // of the most light that the sensor counts
constexpr float kMean = 0.1F;         // what an automatic exposure makes of every picture
constexpr float kHandAlbedo = 0.02F;  // of what is in the camera's way
constexpr std::size_t kLevels = 65536;

// Standard normal numbers at equal steps of their probability: a draw is one look-up.
const std::array<float, 4096>& normals() {
    static const std::array<float, 4096> table = [] {
        std::array<float, 4096> numbers{};
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const double share = (double(i) + 0.5) / double(numbers.size());
            double low = -6, high = 6;
            for (int step = 0; step < 60; ++step) {
                const double middle = (low + high) / 2;
                const bool isLow = 0.5 * std::erfc(-middle / std::numbers::sqrt2) < share;
                (isLow ? low : high) = middle;
            }
            numbers[i] = static_cast<float>(low);
        }
        return numbers;
    }();
    return table;
}

// The code of each of kLevels steps of linear light.
std::vector<std::uint16_t> codesOf(const config::HallCamera& camera) {
    std::vector<std::uint16_t> codes(kLevels);
    const double most = (1 << camera.bits) - 1;
    const double stored = camera.bits == 8 ? 255 : 65535;  // more than 8 bits are kept in 16
    for (std::size_t i = 0; i < kLevels; ++i) {
        double value = double(i) / double(kLevels - 1);
        if (camera.response == config::ScanCamera::Response::Srgb) {
            value = srgbFromLinear(value);
            const double turn = 2 * std::numbers::pi;
            value += camera.responseBend * std::sin(turn * value) / turn;
        }
        codes[i] =
            static_cast<std::uint16_t>(std::lround(std::round(value * most) / most * stored));
    }
    return codes;
}

// The weights of blur on a pixel and its neighbours, the middle first.
std::vector<float> blurWeights(double sigma) {
    const int reach = static_cast<int>(std::ceil(3 * sigma));
    std::vector<float> weights;
    double sum = 0;
    for (int i = 0; i <= reach; ++i) {
        const double weight = std::exp(-0.5 * i * i / (sigma * sigma));
        weights.push_back(static_cast<float>(weight));
        sum += i == 0 ? weight : 2 * weight;
    }
    for (float& weight : weights) weight /= static_cast<float>(sum);
    return weights;
}

// A row or column of a picture, with its border's colour past its ends.
void blurLine(glm::vec3* first,
              std::ptrdiff_t step,
              int count,
              const std::vector<float>& weights,
              std::vector<glm::vec3>& copy) {
    const int reach = static_cast<int>(weights.size()) - 1;
    copy.resize(static_cast<std::size_t>(count + 2 * reach));
    for (int i = 0; i < count + 2 * reach; ++i)
        copy[static_cast<std::size_t>(i)] = first[step * std::clamp(i - reach, 0, count - 1)];
    for (int i = 0; i < count; ++i) {
        const glm::vec3* here = &copy[static_cast<std::size_t>(i + reach)];
        glm::vec3 sum = weights[0] * here[0];
        for (int off = 1; off <= reach; ++off)
            sum += weights[static_cast<std::size_t>(off)] * (here[off] + here[-off]);
        first[step * i] = sum;
    }
}

// The hall before a projector is moved during the scan.
config::Hall unmoved(config::Hall hall) {
    hall.faults.moved.reset();
    return hall;
}

}  // namespace

SimulatedCamera::Earlier::Earlier(const TrueHall& now, WorkerPool& pool)
    : hall{now.rig(), unmoved(now.hall())}, bounce{hall}, view{hall, hall.cameraLens(), pool} {}

SimulatedCamera::SimulatedCamera(const TrueHall& hall,
                                 const std::vector<config::ScanPattern>& patterns,
                                 std::uint32_t seed)
    : hall_{hall},
      seed_{seed},
      pool_{std::thread::hardware_concurrency()},
      bounce_{hall},
      view_{hall, hall.cameraLens(), pool_},
      codes_{codesOf(hall.hall().camera)} {
    listPictures(patterns);
    if (hall.hall().faults.moved) earlier_ = std::make_unique<Earlier>(hall, pool_);
    std::set<std::uint64_t> shown;
    for (const config::ScanPattern& pattern : patterns) shown.insert(pattern.lit);
    float brightest = 0;
    for (const std::uint64_t lit : shown) brightest = std::max(brightest, view_.brightestOf(lit));
    if (brightest > 0) gain_ = kWhite / brightest * static_cast<float>(hall.hall().camera.exposure);
}

void SimulatedCamera::listPictures(const std::vector<config::ScanPattern>& patterns) {
    scan_.rig = hall_.rig().name;
    scan_.cameras.push_back(
        {.response = hall_.hall().camera.response, .focalPixels = hall_.hall().camera.focalPixels});
    for (const config::ScanPattern& pattern : patterns)
        scan_.pictures.push_back({.file = fmt::format("{:04}.png", scan_.pictures.size()),
                                  .camera = 0,
                                  .exposureSeconds = wall::scanExposure(pattern),
                                  .pattern = pattern});
}

const config::ScanPattern& SimulatedCamera::shownIn(std::size_t index) const {
    const bool isLate = hall_.hall().faults.latePicture == index && index > 0;
    return scan_.pictures[isLate ? index - 1 : index].pattern;
}

bool SimulatedCamera::isEarly(std::size_t index) const {
    const auto& moved = hall_.hall().faults.moved;
    return moved && index < moved->fromPicture;
}

Light SimulatedCamera::lightOf(std::size_t index) const {
    const config::ScanPattern& pattern = shownIn(index);
    std::vector<ThrownPicture> pictures(hall_.channels());
    pool_.run(pictures.size(),
              [&](std::size_t channel) { pictures[channel] = thrown(hall_, channel, pattern); });
    const auto& lamp = hall_.hall().faults.lamp;
    HallLamps lamps;
    lamps.room = scan_.pictures[index].pattern.kind == config::ScanPattern::Kind::Room ? 1 : 0;
    lamps.spot = lamp && index >= lamp->fromPicture ? 1 : 0;
    const HallView& view = isEarly(index) ? earlier_->view : view_;
    const Bounce& bounce = isEarly(index) ? earlier_->bounce : bounce_;
    return view.of(pictures, bounce.of(pictures), lamps);
}

// Draws a dark object before the lens, out of focus.
void SimulatedCamera::hide(Light& light) const {
    const auto& block = hall_.hall().faults.blocked;
    if (!block) return;
    constexpr double kSoft = 0.15;  // of its radius
    for (int y = 0; y < light.sizePixels.y; ++y)
        for (int x = 0; x < light.sizePixels.x; ++x) {
            const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) / glm::dvec2(light.sizePixels);
            const double radius = glm::length((place - block->place) / block->radius);
            const auto free = static_cast<float>(glm::smoothstep(1 - kSoft, 1 + kSoft, radius));
            light.at(x, y) *= glm::mix(kHandAlbedo, 1.0F, free);
        }
}

void SimulatedCamera::blur(Light& light) const {
    if (hall_.hall().camera.blurPixels == 0) return;
    const std::vector<float> weights = blurWeights(hall_.hall().camera.blurPixels);
    const glm::ivec2 size = light.sizePixels;
    pool_.run(static_cast<std::size_t>(size.y), [&](std::size_t y) {
        std::vector<glm::vec3> copy;
        blurLine(&light.at(0, static_cast<int>(y)), 1, size.x, weights, copy);
    });
    // Columns, a few at a time by each thread.
    constexpr int kColumns = 16;
    const int chunks = (size.x + kColumns - 1) / kColumns;
    pool_.run(static_cast<std::size_t>(chunks), [&](std::size_t chunk) {
        std::vector<glm::vec3> copy;
        const int first = static_cast<int>(chunk) * kColumns;
        for (int x = first; x < std::min(size.x, first + kColumns); ++x)
            blurLine(&light.at(x, 0), size.x, size.y, weights, copy);
    });
}

void SimulatedCamera::dim(Light& light) const {
    if (hall_.hall().camera.lens.vignetting == 0) return;
    pool_.run(static_cast<std::size_t>(light.sizePixels.y), [&](std::size_t y) {
        for (int x = 0; x < light.sizePixels.x; ++x) {
            const glm::dvec2 pixel(x + 0.5, static_cast<double>(y) + 0.5);
            light.at(x, static_cast<int>(y)) *=
                static_cast<float>(hall_.cameraLens().vignetted(pixel));
        }
    });
}

// The gain of an exposure. An automatic exposure gives all pictures the same mean, within its
// range.
float SimulatedCamera::gainFor(const Light& light) const {
    if (!hall_.hall().faults.autoExposure) return gain_;
    constexpr float kFarthest = 16;  // of the exposure that would be right for white
    glm::dvec3 sum(0);
    for (const glm::vec3& rgb : light.rgb) sum += rgb;
    const auto mean = static_cast<float>((sum.x + sum.y + sum.z) / 3 / double(light.rgb.size()));
    return std::clamp(kMean / std::max(mean, 1e-6F), gain_ / kFarthest, gain_ * kFarthest);
}

Picture SimulatedCamera::counted(const Light& light, float gain, std::uint32_t seed) const {
    const config::HallCamera& camera = hall_.hall().camera;
    Picture picture{.sizePixels = light.sizePixels, .bits = camera.bits == 8 ? 8 : 16, .rgb = {}};
    picture.rgb.resize(3 * light.rgb.size());
    const auto read = static_cast<float>(camera.readNoise * camera.readNoise);
    const float shot = camera.fullWell > 0 ? static_cast<float>(1 / camera.fullWell) : 0.0F;
    const auto& normal = normals();
    const auto width = static_cast<std::size_t>(light.sizePixels.x);
    pool_.run(light.rgb.size() / width, [&](std::size_t y) {
        for (std::size_t i = y * width; i < (y + 1) * width; ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                const float mean = gain * light.rgb[i][static_cast<int>(c)];
                const std::uint32_t draw =
                    aquarama::hashOf(seed, static_cast<std::uint32_t>(3 * i + c));
                const float noise = std::sqrt(shot * mean + read) * normal[draw >> 20U];
                const float level = std::clamp(mean + noise, 0.0F, 1.0F) * float{kLevels - 1};
                picture.rgb[3 * i + c] = codes_[static_cast<std::size_t>(std::lround(level))];
            }
    });
    return picture;
}

Picture SimulatedCamera::taken(Light light, std::uint32_t index, float exposure) const {
    hide(light);
    dim(light);
    blur(light);
    return counted(light, exposure * gainFor(light), aquarama::hashOf(seed_, index));
}

Picture SimulatedCamera::picture(std::size_t index) {
    return taken(lightOf(index),
                 static_cast<std::uint32_t>(index),
                 static_cast<float>(scan_.pictures[index].exposureSeconds));
}

Picture SimulatedCamera::pictureOf(const std::vector<ThrownPicture>& pictures) const {
    HallLamps lamps;
    lamps.spot = hall_.hall().faults.lamp ? 1 : 0;
    return taken(view_.of(pictures, bounce_.of(pictures), lamps),
                 static_cast<std::uint32_t>(scan_.pictures.size()),
                 1);
}

}  // namespace aquarama::hall
