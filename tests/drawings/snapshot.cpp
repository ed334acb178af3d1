// SPDX-License-Identifier: Apache-2.0
#include "tests/drawings/snapshot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "common/base/units.h"

namespace aquarama::test {

namespace {

glm::dvec2 direction(double degrees) {
    return {std::cos(degrees * kDegree), std::sin(degrees * kDegree)};
}

// Of a black body, its green 1: the locus of Kim et al. 2002, in linear Rec. 709.
glm::dvec3 lampOf(double kelvin) {
    const double t = 1000 / kelvin;
    const double x = kelvin < 4000 ? 0.179910 + t * (0.8776956 + t * (-0.2343589 - 0.2661239 * t))
                                   : 0.240390 + t * (0.2226347 + t * (2.1070379 - 3.0258469 * t));
    const double y = kelvin < 4000
                         ? -0.16748867 + x * (2.09137015 + x * (-1.37418593 - 0.9549476 * x))
                         : -0.37001483 + x * (3.75112997 + x * (-5.87338670 + 3.0817580 * x));
    const glm::dmat3 rgbFromXyz{{3.2404542, -0.9692660, 0.0556434},
                                {-1.5371385, 1.8760108, -0.2040259},
                                {-0.4985314, 0.0415560, 1.0572252}};
    const glm::dvec3 rgb = rgbFromXyz * glm::dvec3{x / y, 1, (1 - x - y) / y};
    return glm::max(rgb, 0.02) / rgb.g;
}

glm::dmat3 about(glm::dvec3 axis, double radians) {
    const double c = std::cos(radians), s = std::sin(radians);
    const glm::dmat3 across{{0, axis.z, -axis.y}, {-axis.z, 0, axis.x}, {axis.y, -axis.x, 0}};
    return glm::dmat3{c} + s * across + (1 - c) * glm::outerProduct(axis, axis);
}

// The light on a place of the sheet, 0 to 1.
double lightOn(const Circumstances& how, const Camera& camera, glm::dvec2 at) {
    constexpr double kHalf = 150;
    const double side = glm::dot(at, how.lampTowards) / kHalf;
    double light = 1 - how.unevenness * (0.5 - 0.5 * side + 0.15 * side * side);
    const double inShadow = (glm::dot(at, how.shadowTowards) - how.shadowAt) / how.shadowEdge;
    light *= 1 - how.shadow * glm::smoothstep(-0.5, 0.5, inShadow);
    if (how.creaseHeight > 0) light *= std::clamp(1 + 0.6 * camera.slopeAt(at), 0.6, 1.3);
    light = std::max(light, 0.1);  // far from the sheet
    return light;
}

// Whether a thumb of 20 mm that comes from the nearest edge covers a place.
bool isThumb(const Circumstances& how, glm::dvec2 at) {
    if (!how.thumb) return false;
    const glm::dvec2 tip = *how.thumb;
    const bool fromSide = std::abs(tip.x) / 148 > std::abs(tip.y) / 105;
    const glm::dvec2 away =
        fromSide ? glm::dvec2{std::copysign(1, tip.x), 0} : glm::dvec2{0, std::copysign(1, tip.y)};
    const double along = std::max(0.0, glm::dot(at - tip, away));
    return glm::distance(at, tip + along * away) < 10;
}

glm::dvec3 tableAt(glm::dvec2 at, std::uint32_t seed) {
    const auto grain = static_cast<double>(smoothNoise(at / glm::dvec2{60, 2}, seed));
    return (0.1 + 0.2 * grain) * glm::dvec3{1.0, 0.75 - 0.1 * (seed % 3), 0.5};
}

// The taps of a bell curve, sigma in pixels; they sum to 1.
std::vector<float> bellOf(double sigma) {
    const int reach = static_cast<int>(std::ceil(2.5 * sigma));
    std::vector<float> taps;
    float sum = 0;
    for (int k = -reach; k <= reach; ++k) {
        taps.push_back(static_cast<float>(std::exp(-0.5 * k * k / (sigma * sigma))));
        sum += taps.back();
    }
    for (float& tap : taps) tap /= sum;
    return taps;
}

// Along rows, or along columns; the border goes on.
void blur(Light& light, const std::vector<float>& taps, glm::ivec2 way) {
    const int reach = static_cast<int>(taps.size() / 2);
    const glm::ivec2 size = light.sizePixels;
    Light out = darkness(size);
    for (int y = 0; y < size.y; ++y)
        for (int k = -reach; k <= reach; ++k) {
            const float tap = taps[static_cast<std::size_t>(k + reach)];
            const glm::vec3* from = &light.at(0, std::clamp(y + k * way.y, 0, size.y - 1));
            glm::vec3* to = &out.at(0, y);
            const int by = k * way.x;
            const int first = std::clamp(-by, 0, size.x), last = std::clamp(size.x - by, 0, size.x);
            for (int x = 0; x < first; ++x) to[x] += tap * from[0];
            for (int x = first; x < last; ++x) to[x] += tap * from[x + by];
            for (int x = last; x < size.x; ++x) to[x] += tap * from[size.x - 1];
        }
    light = std::move(out);
}

// Shot noise and the sensor's own, then sRGB codes.
drawings::Photo developed(const Light& light, double noise, std::uint32_t seed) {
    std::minstd_rand random(seed + 1);
    std::array<float, 1024> bell{};
    std::normal_distribution<float> normal;
    std::ranges::generate(bell, [&] { return normal(random); });
    std::array<std::uint8_t, 4096> codes{};
    for (std::size_t i = 0; i < codes.size(); ++i)
        codes.at(i) = static_cast<std::uint8_t>(
            std::lround(255 * srgbFromLinear((static_cast<double>(i) + 0.5) /
                                             static_cast<double>(codes.size()))));
    drawings::Photo photo{light.sizePixels, {}};
    photo.rgb.reserve(3 * light.rgb.size());
    for (const glm::vec3& rgb : light.rgb)
        for (int c = 0; c < 3; ++c) {
            const float spread = static_cast<float>(noise) * (0.3F + std::sqrt(rgb[c]));
            const float value = rgb[c] + spread * bell[random() % bell.size()];
            photo.rgb.push_back(
                codes[static_cast<std::size_t>(std::clamp(value * 4096.0F, 0.0F, 4095.0F))]);
        }
    return photo;
}

}  // namespace

Circumstances circumstancesOf(std::uint32_t seed, double mostMegapixels) {
    std::mt19937 random(seed * 7919 + 13);
    const auto within = [&](double least, double most) {
        return least + (most - least) * static_cast<double>(random()) / 4294967296.0;
    };
    const auto happens = [&](double share) { return within(0, 1) < share; };
    Circumstances how;
    how.seed = seed;
    const double megapixels = std::exp(within(std::log(0.5), std::log(mostMegapixels)));
    const int height = static_cast<int>(std::sqrt(megapixels * 1e6 / (4.0 / 3)));
    how.sizePixels = {height * 4 / 3, height};
    how.tiltDegrees = happens(0.15) ? 45 : within(0, 45);
    how.tiltTowardsDegrees = within(0, 360);
    how.rollDegrees = within(-12, 12) + (happens(0.2) ? 180 : 0);
    how.filling = within(0.78, 0.97);
    how.kelvin = within(2700, 6500);
    how.adaptation = within(0, 1);
    how.exposure = within(0.45, 0.95);
    how.unevenness = within(0, 0.45);
    how.lampTowards = direction(within(0, 360));
    if (happens(0.4)) how.shadow = within(0.15, 0.5);
    how.shadowEdge = within(15, 80);
    how.shadowAt = within(-90, 90);
    how.shadowTowards = direction(within(0, 360));
    if (happens(0.3)) how.creaseHeight = within(0.3, 1.5);
    how.creaseWidth = within(10, 25);
    how.creaseAt = within(-80, 80);
    how.creaseTowards = direction(happens(0.5) ? within(-10, 10) : within(80, 100));
    if (happens(0.35))
        how.thumb = happens(0.5) ? glm::dvec2{std::copysign(125, within(-1, 1)), within(-95, 95)}
                                 : glm::dvec2{within(-125, 125), std::copysign(85, within(-1, 1))};
    how.blurPixels = within(0.35, 0.8) * std::max(1.0, how.sizePixels.x / 1800.0);
    how.noise = within(0.003, 0.03);
    how.jpegQuality = static_cast<int>(within(70, 96));
    return how;
}

Camera::Camera(const Circumstances& how, glm::dvec2 paperMillimetres) : how_{how} {
    // A wide angle, as phones have it: 65 degrees across.
    focalPixels_ = 0.78 * how.sizePixels.x;
    // The sheet's y is up, the picture's down.
    const glm::dmat3 flip{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    const glm::dvec2 axis = direction(how.tiltTowardsDegrees + 90);
    turn_ = about({0, 0, 1}, how.rollDegrees * kDegree) *
            about({axis, 0}, how.tiltDegrees * kDegree) * flip;
    aim(paperMillimetres);
    const glm::dmat3 photoFromSheet =
        glm::dmat3{{focalPixels_, 0, 0},
                   {0, focalPixels_, 0},
                   {how.sizePixels.x / 2.0, how.sizePixels.y / 2.0, 1}} *
        glm::dmat3{turn_[0], turn_[1], move_};
    sheetFromPhoto_ = glm::inverse(photoFromSheet);
}

// So far away, and to the side, that the paper fills its share in the middle of the picture.
void Camera::aim(glm::dvec2 paperMillimetres) {
    const glm::dvec2 half = paperMillimetres / 2.0, size(how_.sizePixels);
    for (int i = 0; i < 60; ++i) {
        glm::dvec2 least(1e9), most(-1e9);
        for (const glm::dvec2 corner : {glm::dvec2{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
            const glm::dvec2 at = projected({corner * half, 0});
            least = glm::min(least, at);
            most = glm::max(most, at);
        }
        const glm::dvec2 off = (least + most) / 2.0 - size * glm::dvec2{0.5 + how_.aside, 0.5},
                         share = (most - least) / size;
        move_ -= glm::dvec3{off * move_.z / focalPixels_, 0};
        move_.z *= std::clamp(std::max(share.x, share.y) / how_.filling, 0.8, 1.25);
    }
}

glm::dvec2 Camera::projected(glm::dvec3 place) const {
    const glm::dvec3 seen = turn_ * place + move_;
    return focalPixels_ * glm::dvec2{seen} / seen.z + glm::dvec2(how_.sizePixels) / 2.0;
}

double Camera::heightAt(glm::dvec2 sheet) const {
    const double from = (glm::dot(sheet, how_.creaseTowards) - how_.creaseAt) / how_.creaseWidth;
    return how_.creaseHeight * std::exp(-std::abs(from));
}

double Camera::slopeAt(glm::dvec2 sheet) const {
    const double from = glm::dot(sheet, how_.creaseTowards) - how_.creaseAt;
    return std::copysign(heightAt(sheet) / how_.creaseWidth, from);
}

glm::dvec2 Camera::photoAt(glm::dvec2 sheet) const {
    return projected({sheet, heightAt(sheet)});
}

glm::dvec2 Camera::sheetAt(glm::dvec2 pixel) const {
    const auto flat = [this](glm::dvec2 at) {
        const glm::dvec3 place = sheetFromPhoto_ * glm::dvec3{at, 1};
        return glm::dvec2{place} / place.z;
    };
    const glm::dvec2 on = flat(pixel);
    constexpr double kFar = 300;  // from where a crease is of no matter
    if (how_.creaseHeight == 0 || !(glm::length(on) < kFar)) return on;
    glm::dvec2 at = on;
    for (int i = 0; i < 3; ++i) at += on - flat(photoAt(at));
    return at;
}

drawings::Photo photographed(const PaintedSheet& sheet,
                             const Circumstances& how,
                             const Camera& camera) {
    const glm::dvec3 lamp = lampOf(how.kelvin);
    const glm::dvec3 seen = how.exposure * glm::pow(lamp, glm::dvec3(1 - how.adaptation));
    const glm::dvec3 exposed = seen / std::max(1.0, std::max(seen.r, seen.b) / 0.97);
    Light light = darkness(how.sizePixels);
    for (int y = 0; y < how.sizePixels.y; ++y)
        for (int x = 0; x < how.sizePixels.x; ++x) {
            const glm::dvec2 at =
                glm::clamp(camera.sheetAt(glm::dvec2{x, y} + 0.5), -2000.0, 2000.0);
            glm::dvec3 reflected =
                sheet.isPaper(at) ? glm::dvec3(sheet.at(at)) : tableAt(at, how.seed);
            if (isThumb(how, at)) reflected = {0.55, 0.28, 0.2};
            light.at(x, y) = exposed * reflected * lightOn(how, camera, at);
        }
    for (const glm::ivec2 way : {glm::ivec2{1, 0}, glm::ivec2{0, 1}})
        blur(light, bellOf(how.blurPixels), way);
    return developed(light, how.noise, how.seed);
}

}  // namespace aquarama::test
