// SPDX-License-Identifier: Apache-2.0
// A camera that sees the channels of a rig side by side through a slightly keystoned map, with
// noise, blur and indirect light; and what may go wrong with it.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>

#include <glm/common.hpp>

#include "calibration/scan/pictures.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

struct SyntheticSettings {
    glm::ivec2 sizePixels{400, 250};
    int bits = 16;
    config::ScanCamera::Response response = config::ScanCamera::Response::Linear;
    double white = 0.7, black = 0.02, noise = 0.007;  // linear; noise of a picture's pixel
    double indirect = 0;  // share of white that comes from around the place itself
    double bend = 0;      // of the response: light * (1 + bend * (1 - light))
    // Of the picture of an index.
    std::function<std::size_t(std::size_t)> shown = [](std::size_t i) { return i; };
    std::function<double(std::size_t)> gain = [](std::size_t) { return 1.0; };
    std::function<double(std::size_t)> lamp = [](std::size_t) { return 0.0; };
    std::function<double(std::size_t)> shift = [](std::size_t) { return 0.0; };  // of the channels
    double blockedTo = 0;  // share of the camera's columns that see something else
    std::vector<std::size_t> dark = {};  // channels that are off
};

class SyntheticCamera final : public PictureSource {
  public:
    SyntheticCamera(const config::Rig& rig, SyntheticSettings settings)
        : rig_{rig}, settings_{std::move(settings)} {
        scan_.rig = rig.name;
        scan_.cameras = {{.response = settings_.response}};
        for (const config::ScanPattern& pattern : sequenceOf(rig))
            scan_.pictures.push_back({.file = "", .pattern = pattern});
    }
    [[nodiscard]] const config::Scan& scan() const override { return scan_; }
    [[nodiscard]] Picture picture(std::size_t index) override {
        const std::size_t shown = settings_.shown(index);
        std::vector<double> light(count(), settings_.black + settings_.lamp(index));
        for (std::size_t c = 0; c < rig_.channels.size(); ++c)
            if (std::ranges::find(settings_.dark, c) == settings_.dark.end())
                addChannel(light, scan_.pictures[shown].pattern, c, settings_.shift(index));
        blur(light);
        return encoded(light, index);
    }

    // Of a camera's pixel, continuous; channels overlap by a sixth.
    [[nodiscard]] glm::dvec2 placeAt(std::size_t channel, glm::dvec2 pixel) const {
        const auto channels = static_cast<double>(rig_.channels.size());
        const glm::dvec2 size(rig_.channels[channel].sizePixels);
        const double wide = settings_.sizePixels.x / (1 + (channels - 1) * 5 / 6) * 0.94;
        const glm::dvec2 low(static_cast<double>(channel) * wide * 5 / 6 + 0.03 * wide,
                             0.05 * settings_.sizePixels.y);
        const glm::dvec2 at = (pixel - low) / glm::dvec2(wide, 0.9 * settings_.sizePixels.y);
        const glm::dvec2 crooked(at.x + 0.02 * at.y, at.y - 0.015 * at.x);
        return crooked / (0.97 + 0.05 * at.x + 0.02 * at.y) * size;
    }

  private:
    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(settings_.sizePixels.x * settings_.sizePixels.y);
    }

    // Light along the axis of a pattern, and its mean around each place.
    struct Line {
        std::vector<double> light, sums, around;
        bool rows = false;
        // The mean of the light between two places; it is dark beyond the ends.
        [[nodiscard]] double between(double low, double high) const {
            return (sumTo(high) - sumTo(low)) / (high - low);
        }
        [[nodiscard]] double sumTo(double place) const {
            const double at = std::clamp(place, 0.0, static_cast<double>(light.size()));
            const auto pixel = std::min(light.size() - 1, static_cast<std::size_t>(at));
            return sums[pixel] + (at - static_cast<double>(pixel)) * light[pixel];
        }
    };
    [[nodiscard]] Line lineOf(const config::ScanPattern& pattern, std::size_t c) const {
        using Kind = config::ScanPattern::Kind;
        constexpr int kReach = 300;
        Line line;
        line.rows = pattern.kind == Kind::GrayRows || pattern.kind == Kind::PhaseRows;
        const glm::ivec2 size = rig_.channels[c].sizePixels;
        const int pixels = line.rows ? size.y : size.x;
        for (int i = 0; i < pixels; ++i) {
            const glm::ivec2 at = line.rows ? glm::ivec2(0, i) : glm::ivec2(i, 0);
            const glm::vec3 light = wall::scanLight(pattern, c, size, at);
            line.light.push_back(
                double{0.25F * light.r + 0.5F * light.g + 0.25F * light.b});
        }
        line.sums = {0};
        for (const double value : line.light) line.sums.push_back(line.sums.back() + value);
        line.around = smoothed(smoothed(line.light, kReach), kReach);
        return line;
    }
    [[nodiscard]] static std::vector<double> smoothed(const std::vector<double>& sharp, int reach) {
        const auto pixels = static_cast<int>(sharp.size());
        std::vector<double> sums{0}, smooth;
        for (const double value : sharp) sums.push_back(sums.back() + value);
        for (int i = 0; i < pixels; ++i) {
            const int low = std::max(0, i - reach), high = std::min(pixels, i + reach);
            smooth.push_back((sums[static_cast<std::size_t>(high)] - sums[static_cast<std::size_t>(low)]) / (high - low));
        }
        return smooth;
    }

    void addChannel(std::vector<double>& light,
                    const config::ScanPattern& pattern,
                    std::size_t c,
                    double shift) const {
        if (((pattern.lit >> c) & 1U) == 0) return;
        const Line line = lineOf(pattern, c);
        for (int y = 0; y < settings_.sizePixels.y; ++y)
            for (int x = static_cast<int>(settings_.blockedTo * settings_.sizePixels.x); x < settings_.sizePixels.x; ++x)
                light[static_cast<std::size_t>(y * settings_.sizePixels.x + x)] +=
                    settings_.white * seen(pattern, line, c, glm::dvec2(x, y), shift);
    }
    // By a pixel, which sees a square of the channel's picture.
    [[nodiscard]] double seen(const config::ScanPattern& pattern,
                              const Line& line,
                              std::size_t c,
                              glm::dvec2 corner,
                              double shift) const {
        const glm::dvec2 place = placeAt(c, corner + 0.5) + shift;
        const glm::ivec2 size = rig_.channels[c].sizePixels;
        const int across = line.rows ? 0 : 1;
        if (place.x < 0 || place.y < 0 || place.x >= size.x || place.y >= size.y) return 0;
        const double at = place[1 - across];
        const double half = 0.5 * std::abs(placeAt(c, corner + 1.5)[1 - across] + shift - at);
        const auto pixel = static_cast<std::size_t>(std::clamp(at, 0.0, size[1 - across] - 1.0));
        double direct = line.between(at - half, at + half);
        if (const auto tag = tagLight(pattern, c, glm::ivec2(glm::floor(place)))) direct = *tag;
        return (1 - settings_.indirect) * direct + settings_.indirect * line.around[pixel];
    }
    [[nodiscard]] std::optional<double> tagLight(const config::ScanPattern& pattern,
                                                 std::size_t c,
                                                 glm::ivec2 pixel) const {
        const glm::ivec2 size = rig_.channels[c].sizePixels;
        const auto [cell, corner] = wall::scanTagPlace(size);
        const glm::ivec2 off = pixel - corner;
        if (off.x < 0 || off.y < 0 || off.x >= wall::kScanTagCells * cell || off.y >= cell)
            return std::nullopt;
        const glm::vec3 tag = wall::scanLight(pattern, c, size, pixel);
        return double{0.25F * tag.r + 0.5F * tag.g + 0.25F * tag.b};
    }

    void blur(std::vector<double>& light) const {
        const auto width = static_cast<std::size_t>(settings_.sizePixels.x);
        for (const std::size_t step : {std::size_t{1}, width}) {
            const std::vector<double> sharp = light;
            for (std::size_t p = step; p + step < light.size(); ++p)
                light[p] = 0.15 * sharp[p - step] + 0.7 * sharp[p] + 0.15 * sharp[p + step];
        }
    }
    [[nodiscard]] Picture encoded(const std::vector<double>& light, std::size_t index) const {
        Picture picture{.sizePixels = settings_.sizePixels, .bits = settings_.bits, .rgb = {}};
        const double most = (1 << settings_.bits) - 1;
        std::minstd_rand random(static_cast<unsigned>(index + 1));
        std::normal_distribution<double> noise(0, settings_.noise);
        for (const double clean : light) {
            double value = clean * settings_.gain(index) + noise(random);
            value *= 1 + settings_.bend * (1 - value);
            value = std::clamp(value, 0.0, 1.0);
            const bool linear = settings_.response == config::ScanCamera::Response::Linear;
            const double code = (linear ? value : srgbFromLinear(value)) * most;
            for (int i = 0; i < 3; ++i) picture.rgb.push_back(static_cast<std::uint16_t>(std::lround(code)));
        }
        return picture;
    }

    config::Rig rig_;
    SyntheticSettings settings_;
    config::Scan scan_;
};

}  // namespace aquarama::scan
