// SPDX-License-Identifier: Apache-2.0
#include "calibration/light/brightness.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <thread>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "common/base/units.h"
#include "common/base/worker_pool.h"
#include "common/wall/optics.h"
#include "common/wall/wall.h"

namespace aquarama::light {

namespace {

constexpr float kNoBound = std::numeric_limits<float>::infinity();
// The fastest change of brightness that is not visible: of its logarithm, for each degree of view.
constexpr double kWhiteStep = 0.01, kBlackStep = 0.04;
// White is smoothed over this many degrees, so that its slope has no jumps.
constexpr double kSoftDegrees = 2.0;

ScreenField fieldOf(glm::ivec2 size, float value) {
    return {size, std::vector<float>(static_cast<std::size_t>(size.x * size.y), value)};
}

std::size_t indexOf(const ScreenField& field, int x, int y) {
    return static_cast<std::size_t>(y * field.size.x + x);
}

// One pass over a field of logarithms: each cell is at most a step above the cells before it.
void sweep(ScreenField& field, glm::dvec2 step, bool isBack) {
    const glm::ivec2 size = field.size;
    const int way = isBack ? -1 : 1;
    const glm::dvec2 square = step * step;
    const double slant = std::sqrt(square.x + square.y);
    const auto lower = [&](float& here, int x, int y, double by) {
        if (x < 0 || y < 0 || x >= size.x || y >= size.y) return;
        here = std::min(here, field.values[indexOf(field, x, y)] + static_cast<float>(by));
    };
    for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) {
            const int x = isBack ? size.x - 1 - i : i, y = isBack ? size.y - 1 - j : j;
            float& here = field.values[indexOf(field, x, y)];
            lower(here, x - way, y, step.x);
            lower(here, x, y - way, step.y);
            lower(here, x - 1, y - way, slant);
            lower(here, x + 1, y - way, slant);
        }
}

// Gaussian, across and then down; sigma in cells.
void soften(ScreenField& field, glm::dvec2 sigma) {
    for (int axis = 0; axis < 2; ++axis) {
        const int reach = static_cast<int>(std::ceil(3 * sigma[axis]));
        const ScreenField before = field;
        for (int y = 0; y < field.size.y; ++y)
            for (int x = 0; x < field.size.x; ++x) {
                double sum = 0, weights = 0;
                for (int i = -reach; i <= reach; ++i) {
                    glm::ivec2 there(x, y);
                    there[axis] = std::clamp(there[axis] + i, 0, field.size[axis] - 1);
                    const double weight = std::exp(-0.5 * i * i / (sigma[axis] * sigma[axis]));
                    sum += weight * double(before.values[indexOf(before, there.x, there.y)]);
                    weights += weight;
                }
                field.values[indexOf(field, x, y)] = static_cast<float>(sum / weights);
            }
    }
}

template <class Function>
void each(ScreenField& field, const Function& function) {
    for (float& value : field.values) value = static_cast<float>(function(double(value)));
}

// The conversion from light in the wall's primaries to shares of each projector's own colours.
struct Colours {
    std::vector<glm::dmat3> mixes;
    std::vector<double> gains;  // luminance of the wall's white, as a share of the projector's own
    double desaturation = 0;
};

glm::dmat3 meanPrimaries(const std::vector<ChannelLight>& lights) {
    glm::dmat3 mean(0.0);
    for (const ChannelLight& light : lights) mean += light.primaries / double(lights.size());
    return mean;
}

// The share of the other primaries that must be mixed into each, so that every projector reaches
// it.
glm::dmat3 desaturationOf(const std::vector<ChannelLight>& lights, const glm::dmat3& mean) {
    glm::dmat3 most(0.0);
    for (const ChannelLight& light : lights) {
        const glm::dmat3 reached = glm::inverse(light.primaries) * mean;
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                if (row != column)
                    most[column][row] = std::max(most[column][row], -reached[column][row]);
    }
    return most;
}

// The mean of the projectors' primaries, desaturated only as far as all projectors need. Its white
// stays that of the mean.
Colours coloursOf(const std::vector<ChannelLight>& lights) {
    Colours colours;
    const glm::dmat3 mean = meanPrimaries(lights), others = desaturationOf(lights, mean);
    glm::dmat3 wanted = glm::dmat3(1.0) + others;
    const glm::dvec3 sums = wanted * glm::dvec3(1);
    for (int column = 0; column < 3; ++column) {
        wanted[column] /= sums;
        colours.desaturation = std::max(
            colours.desaturation,
            (wanted[column].x + wanted[column].y + wanted[column].z) / wanted[column][column] - 1);
    }
    for (const ChannelLight& light : lights) {
        glm::dmat3 mix = glm::inverse(light.primaries) * mean * wanted;
        for (int column = 0; column < 3; ++column)
            mix[column] = glm::max(mix[column], glm::dvec3(0));
        const glm::dvec3 white = mix * glm::dvec3(1);
        const double gain = 1 / std::max({white.x, white.y, white.z});
        colours.mixes.push_back(gain * mix);
        colours.gains.push_back(gain);
    }
    return colours;
}

// The share of the light of each channel, and its available light, at each cell of the unrolled
// screen.
class ShareMap {
  public:
    ShareMap(const geometry::SolvedHall& hall,
             const std::vector<ChannelLight>& lights,
             const Colours& colours,
             const formats::WallFile& file)
        : rig_{hall.rig}, lights_{lights}, colours_{colours} {
        constexpr int kMostColumns = 1000;
        const glm::ivec2 panorama = rig_.panoramaPixels;
        const int columns = std::min(kMostColumns, panorama.x);
        const glm::ivec2 size(columns, std::max(2, columns * panorama.y / panorama.x));
        reached_.resize(static_cast<std::size_t>(size.x * size.y));
        mostWhite = fieldOf(size, kNoBound);
        black = fieldOf(size, 0);
        shares.assign(lights.size(), fieldOf(size, 0));
        const wall::ScreenSurface& screen = hall.nominal.screen();
        for (std::size_t c = 0; c < lights.size(); ++c) {
            rig_.channels[c].wallFile =
                config::WallFileRegion{.file = {}, .region = rig_.channels[c].name, .frustum = {}};
            optics_.push_back(wall::makeCalibratedOptics(rig_, c, screen, file));
        }
        WorkerPool(std::thread::hardware_concurrency())
            .run(shares.front().values.size(), [&](std::size_t cell) {
                const int index = static_cast<int>(cell);
                const glm::dvec2 place =
                    (glm::dvec2(index % size.x, index / size.x) + 0.5) / glm::dvec2(size);
                if (const auto point = screen.at(place)) fill(cell, *point);
            });
    }

    // The sum of the blacks of all channels at a pixel of one channel, as the mean over the pixel.
    [[nodiscard]] double blackAt(std::size_t channel, glm::dvec2 pixel, glm::dvec2 place) const {
        const Reach reach = reachAbout(place);
        if (reach.all == reach.some) return black.at(place);
        constexpr int kParts = 4;  // each way
        double sum = 0;
        for (int i = 0; i < kParts * kParts; ++i)
            sum +=
                blackOf(channel,
                        pixel + (glm::dvec2(i % kParts, i / kParts) + 0.5) / double{kParts} - 0.5,
                        reach.some);
        return sum / (kParts * kParts);
    }

    std::vector<ScreenField> shares;
    // The most light that the channels give together while each gives its share; and the sum of
    // blacks.
    ScreenField mostWhite, black;

  private:
    // Channels that reach some and all of the cells about a place.
    struct Reach {
        std::uint64_t some = 0, all = ~std::uint64_t{0};
    };
    [[nodiscard]] Reach reachAbout(glm::dvec2 place) const {
        const glm::ivec2 low = glm::ivec2(glm::floor(place * glm::dvec2(black.size) - 0.5));
        Reach reach;
        for (int y = low.y - 1; y <= low.y + 2; ++y)
            for (int x = low.x - 1; x <= low.x + 2; ++x) {
                const glm::ivec2 at = glm::clamp(glm::ivec2(x, y), glm::ivec2(0), black.size - 1);
                reach.some |= reached_[indexOf(black, at.x, at.y)];
                reach.all &= reached_[indexOf(black, at.x, at.y)];
            }
        return reach;
    }
    // The blacks of some channels at a place of the picture of one of them.
    [[nodiscard]] double blackOf(std::size_t channel,
                                 glm::dvec2 pixel,
                                 std::uint64_t channels) const {
        double sum = blackOf(channel, pixel);
        const auto point = optics_[channel]->pointOf(pixel, wall::kSpillMetres);
        for (std::size_t c = 0; point && c < optics_.size(); ++c)
            if (c != channel && ((channels >> c) & 1U) != 0)
                if (const auto at = optics_[c]->pixelOf(*point)) sum += blackOf(c, *at);
        return sum;
    }
    [[nodiscard]] double blackOf(std::size_t channel, glm::dvec2 pixel) const {
        return lights_[channel].black *
               lights_[channel].white.at(pixel / glm::dvec2(rig_.channels[channel].sizePixels));
    }
    void fill(std::size_t cell, glm::dvec3 point) {
        double sum = 0;
        std::vector<std::optional<glm::dvec2>> pixels;
        for (std::size_t c = 0; c < optics_.size(); ++c) {
            pixels.push_back(optics_[c]->pixelOf(point));
            if (pixels[c]) sum += wall::pullAt(*pixels[c], rig_.channels[c].sizePixels);
        }
        for (std::size_t c = 0; c < optics_.size() && sum > 0; ++c)
            if (pixels[c]) add(cell, c, *pixels[c], sum);
    }
    void add(std::size_t cell, std::size_t channel, glm::dvec2 pixel, double sum) {
        const glm::ivec2 size = rig_.channels[channel].sizePixels;
        const double share = wall::pullAt(pixel, size) / sum;
        reached_[cell] |= config::bitOf(channel);
        const double white = lights_[channel].white.at(pixel / glm::dvec2(size));
        shares[channel].values[cell] = static_cast<float>(share);
        black.values[cell] += static_cast<float>(blackOf(channel, pixel));
        if (share <= 0) return;
        float& most = mostWhite.values[cell];
        most = std::min(most, static_cast<float>(white * colours_.gains[channel] / share));
    }

    config::Rig rig_;
    const std::vector<ChannelLight>& lights_;
    const Colours& colours_;
    std::vector<std::unique_ptr<const wall::Optics>> optics_;
    std::vector<std::uint64_t> reached_;  // for each cell a bit for each channel
};

// The size of a cell in the middle of the screen, in degrees as the viewer sees it.
glm::dvec2 degreesOf(const geometry::SolvedHall& hall, glm::ivec2 size) {
    const glm::dvec3 eye = hall.rig.sweetSpotMetres;
    const auto towards = [&](glm::dvec2 share) {
        const auto point = hall.nominal.screen().at(share);
        return point ? glm::normalize(*point - eye) : glm::dvec3(0, 0, -1);
    };
    constexpr double kApart = 0.02;
    glm::dvec2 degrees;
    for (int axis = 0; axis < 2; ++axis) {
        glm::dvec2 step(0);
        step[axis] = kApart;
        const double angle = std::acos(std::clamp(
            glm::dot(towards(glm::dvec2(0.5) + step), towards(glm::dvec2(0.5) - step)), -1.0, 1.0));
        degrees[axis] =
            std::max(1e-3, angle / (2 * kApart) / double(size[axis]) / kRadiansPerDegree<double>);
    }
    return degrees;
}

// The white and black of the wall at each place.
struct Target {
    ScreenField white, black;
};

Target targetOf(const geometry::SolvedHall& hall, const ShareMap& map) {
    const glm::dvec2 degrees = degreesOf(hall, map.mostWhite.size);
    Target target{evenedBelow(map.mostWhite, kWhiteStep * degrees), map.black};
    each(target.white, [](double light) { return std::log(light); });
    soften(target.white, kSoftDegrees / degrees);
    // After smoothing it may exceed the bound by its change over the width of the smoothing.
    each(target.white, [](double light) { return std::exp(light - kWhiteStep * kSoftDegrees); });
    // Black is evened from above: the same is done to its inverse.
    each(target.black, [](double light) { return light > 0 ? 1 / light : double(kNoBound); });
    target.black = evenedBelow(target.black, kBlackStep * degrees);
    each(target.black, [](double light) { return -std::log(light); });
    soften(target.black, kSoftDegrees / degrees);
    each(target.black, [](double light) {
        return light > -50 ? std::exp(light + kBlackStep * kSoftDegrees) : 0;
    });
    return target;
}

std::uint16_t codeOf(double light) {
    return static_cast<std::uint16_t>(std::lround(65535 * std::clamp(light, 0.0, 1.0)));
}

// The values of a channel's masks at a place of its picture and of the screen.
struct Shade {
    double blend = 0, black = 0;
};

Shade shadeAt(double own, double white, double dark, double darkBefore) {
    const double lift = std::max(0.0, dark - darkBefore) * own;
    return {(white - dark) * own / (1 - lift), lift};
}

// The masks of a channel whose white at a place of its picture is `white`.
void shadeChannel(const geometry::SolvedHall& hall,
                  const ShareMap& map,
                  const Target& target,
                  const std::function<double(glm::dvec2 share)>& white,
                  std::size_t channel,
                  formats::FileChannel& region) {
    const glm::ivec2 size = region.sizePixels;
    const std::vector<glm::vec3>& points = region.warp->samples;
    formats::Mask blend{.size = size, .components = 1, .bits = 16, .codes = {}};
    blend.codes.assign(points.size(), 0);
    formats::Mask black = blend;
    WorkerPool pool(std::thread::hardware_concurrency());
    pool.run(static_cast<std::size_t>(size.y), [&](std::size_t row) {
        for (int x = 0; x < size.x; ++x) {
            const auto i = row * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x);
            if (std::isnan(points[i].x)) continue;
            const glm::dvec2 place = hall.nominal.screen().unrolled(points[i]);
            const glm::dvec2 pixel(x + 0.5, static_cast<double>(row) + 0.5);
            const Shade shade =
                shadeAt(map.shares[channel].at(place) / white(pixel / glm::dvec2(size)),
                        target.white.at(place),
                        target.black.at(place),
                        map.blackAt(channel, pixel, place));
            blend.codes[i] = codeOf(shade.blend);
            black.codes[i] = codeOf(shade.black);
        }
    });
    region.blend = std::move(blend);
    region.black = std::move(black);
}

BrightnessFigures figuresOf(const ShareMap& map, const Target& target, double desaturation) {
    double most = 0, kept = 0, contrast = 0;
    std::size_t cells = 0;
    for (std::size_t i = 0; i < map.mostWhite.values.size(); ++i) {
        const double bound = double(map.mostWhite.values[i]);
        const double before = double(map.black.values[i]);
        if (!std::isfinite(bound)) continue;
        most += bound;
        kept += double(target.white.values[i]);
        contrast += before > 0 ? before / double(target.black.values[i]) : 1;
        ++cells;
    }
    if (cells == 0) return {};
    return {kept / most, kept / most * contrast / static_cast<double>(cells), desaturation};
}

}  // namespace

double ScreenField::at(glm::dvec2 share) const {
    const glm::dvec2 spot =
        glm::clamp(share * glm::dvec2(size) - 0.5, glm::dvec2(0), glm::dvec2(size - 1));
    const glm::ivec2 low = glm::min(glm::ivec2(spot), size - 2);
    const glm::dvec2 t = spot - glm::dvec2(low);
    const auto value = [&](int x, int y) {
        return double(values[indexOf(*this, low.x + x, low.y + y)]);
    };
    return glm::mix(
        glm::mix(value(0, 0), value(1, 0), t.x), glm::mix(value(0, 1), value(1, 1), t.x), t.y);
}

ScreenField evenedBelow(ScreenField most, glm::dvec2 step) {
    each(most, [](double light) { return std::log(light); });
    // Two passes each way, so that limits also spread around corners of unlit parts.
    for (int pass = 0; pass < 4; ++pass) sweep(most, step, pass % 2 == 1);
    each(most, [](double light) { return std::exp(light); });
    return most;
}

BrightnessFigures shade(const geometry::SolvedHall& hall,
                        const std::vector<ChannelLight>& lights,
                        formats::WallFile& file) {
    const Colours colours = coloursOf(lights);
    const ShareMap map(hall, lights, colours, file);
    const Target target = targetOf(hall, map);
    for (std::size_t c = 0; c < lights.size(); ++c) {
        formats::FileChannel& region = file.channels[c];
        const auto white = [&](glm::dvec2 share) {
            return lights[c].white.at(share) * colours.gains[c];
        };
        shadeChannel(hall, map, target, white, c, region);
        region.colour = formats::ChannelColour{glm::mat3(colours.mixes[c]), lights[c].response};
    }
    return figuresOf(map, target, colours.desaturation);
}

}  // namespace aquarama::light
