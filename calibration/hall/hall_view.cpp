// SPDX-License-Identifier: Apache-2.0
#include "calibration/hall/hall_view.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/base/statistics.h"

namespace aquarama::hall {

namespace {

constexpr float kDrapeAlbedo = 0.03F;
constexpr int kWidest = 1500;        // of a picture whose rays are all followed
constexpr int kStride = 4;           // between those of others
constexpr float kPerStep = 2048;     // of a beam's steps
constexpr double kEverywhere = 0.4;  // of the room's light, from its walls

// Of one lamp over the audience.
double lampLight(const TrueHall& hall, glm::dvec3 point, glm::dvec3 normal) {
    const glm::dvec3 way = hall.rig().sweetSpotMetres + glm::dvec3(0.5, 0.6, 1.0) - point;
    return std::max(0.0, glm::dot(normal, glm::normalize(way))) / glm::dot(way, way);
}

double lampLightInTheMiddle(const TrueHall& hall) {
    const wall::ScreenSurface& shape = hall.screen().shape();
    const glm::dvec3 middle = shape.at(glm::dvec2(0.5)).value_or(glm::dvec3(0, 0, -1));
    return std::max(1e-6, lampLight(hall, middle, glm::normalize(shape.normalAt(middle))));
}

std::array<std::int16_t, 2> stepOf(glm::vec2 from, glm::vec2 to) {
    const glm::vec2 step = glm::clamp((to - from) * kPerStep, -32767.0F, 32767.0F);
    return {static_cast<std::int16_t>(step.x), static_cast<std::int16_t>(step.y)};
}

glm::vec2 vectorOf(std::array<std::int16_t, 2> step) {
    return glm::vec2(step[0], step[1]) / kPerStep;
}

}  // namespace

HallView::HallView(const TrueHall& hall, const TrueLens& eye, WorkerPool& pool)
    : hall_{hall},
      eye_{eye},
      pool_{pool},
      size_{eye.truth().size},
      step_{size_.x > kWidest ? kStride : 1},
      gridWidth_{(size_.x - 1) / step_ + 2},
      middleLight_{lampLightInTheMiddle(hall)} {
    if (const auto& lamp = hall.hall().faults.lamp) spot_ = hall.screen().at(lamp->place);
    const int gridHeight = (size_.y - 1) / step_ + 2;
    std::vector<Arrival> grid(static_cast<std::size_t>(gridWidth_ * gridHeight));
    const auto rows = static_cast<std::size_t>(size_.y);
    pool_.run(static_cast<std::size_t>(gridHeight), [&](std::size_t y) {
        for (std::size_t x = 0; x < static_cast<std::size_t>(gridWidth_); ++x)
            grid[y * static_cast<std::size_t>(gridWidth_) + x] =
                arrivalAt(double(step_) * glm::dvec2(x, y) + 0.5);
    });
    rows_.resize(rows);
    pool_.run(rows, [&](std::size_t y) { rows_[y] = rowOf(grid, static_cast<int>(y)); });
    std::vector<std::vector<std::uint8_t>> coverage(rows);
    pool_.run(rows, [&](std::size_t y) {
        coverage[y] = smoothed(static_cast<int>(y));
        setSteps(static_cast<int>(y));
    });
    for (std::size_t y = 0; y < rows; ++y) rows_[y].coverage = std::move(coverage[y]);
}

HallView::Arrival HallView::arrivalAt(glm::dvec2 pixel) const {
    const auto meeting = hall_.screen().meet(eye_.ray(pixel));
    if (!meeting) return {};
    return {.point = meeting->point,
            .normal = hall_.screen().normalAt(meeting->point),
            .place = hall_.screen().shape().unrolled(meeting->foot),
            .isThere = true,
            .isWhite = meeting->isScreen && !meeting->isMarked};
}

bool HallView::isWhite(glm::dvec2 pixel) const {
    const auto meeting = hall_.screen().meet(eye_.ray(pixel));
    return meeting && meeting->isScreen && !meeting->isMarked;
}

HallView::Arrival HallView::arrivalIn(const std::vector<Arrival>& grid, int x, int y) const {
    const auto first = static_cast<std::size_t>(y / step_ * gridWidth_ + x / step_);
    if (step_ == 1) return grid[first];
    const std::size_t below = first + static_cast<std::size_t>(gridWidth_);
    const std::array corners{&grid[first], &grid[first + 1], &grid[below], &grid[below + 1]};
    const auto alike = [&](const Arrival* arrival) {
        return arrival->isThere && arrival->isWhite == corners[0]->isWhite;
    };
    if (!std::ranges::all_of(corners, alike)) return arrivalAt(glm::dvec2(x, y) + 0.5);
    const double s = double(x % step_) / step_, t = double(y % step_) / step_;
    const auto between = [&](auto member) {
        return glm::mix(glm::mix(corners[0]->*member, corners[1]->*member, s),
                        glm::mix(corners[2]->*member, corners[3]->*member, s),
                        t);
    };
    return {.point = between(&Arrival::point),
            .normal = glm::normalize(between(&Arrival::normal)),
            .place = between(&Arrival::place),
            .isThere = true,
            .isWhite = corners[0]->isWhite};
}

float HallView::roomLight(const Arrival& arrival) const {
    if (!arrival.isThere) return static_cast<float>(kEverywhere);
    const double lamp = lampLight(hall_, arrival.point, arrival.normal) / middleLight_;
    return static_cast<float>(kEverywhere + (1 - kEverywhere) * lamp);
}

// Round, with soft edges.
float HallView::spotLight(const Arrival& arrival) const {
    if (!arrival.isThere) return 0;
    const config::HallFaults::Lamp& lamp = *hall_.hall().faults.lamp;
    const glm::dvec3 off = arrival.point - *spot_;
    const double square = glm::dot(off, off) / (lamp.radiusMetres * lamp.radiusMetres);
    return static_cast<float>(lamp.light * std::exp(-2 * square * square));
}

HallView::Row HallView::rowOf(const std::vector<Arrival>& grid, int y) const {
    Row row;
    row.beams.resize(hall_.channels());
    for (int x = 0; x < size_.x; ++x) add(arrivalIn(grid, x, y), x, row);
    return row;
}

void HallView::add(const Arrival& arrival, int column, Row& row) const {
    row.coverage.push_back(arrival.isWhite ? kFullCoverage : 0);
    row.place.emplace_back(arrival.place);
    row.room.push_back(roomLight(arrival));
    if (spot_) row.spot.push_back(spotLight(arrival));
    for (std::size_t channel = 0; arrival.isThere && channel < row.beams.size(); ++channel)
        addBeam(arrival, column, channel, row.beams[channel]);
}

void HallView::addBeam(const Arrival& arrival,
                       int column,
                       std::size_t channel,
                       std::vector<Beam>& beams) const {
    const auto pixel = hall_.lens(hall_.projectorOf(channel)).pixelOf(arrival.point);
    if (!pixel) return;
    const double white = hall_.whiteOn(channel, arrival.point, arrival.normal);
    if (white > 0)
        beams.push_back({.panelPixel = glm::vec2(*pixel),
                         .white = static_cast<float>(white),
                         .column = static_cast<std::uint16_t>(column)});
}

// How much of each pixel is screen, smoothed at the screen's edges.
std::vector<std::uint8_t> HallView::smoothed(int y) const {
    std::vector<std::uint8_t> coverage = rows_[static_cast<std::size_t>(y)].coverage;
    const auto isLit = [&](int x, int row) {
        const glm::ivec2 at = glm::clamp(glm::ivec2(x, row), glm::ivec2(0), size_ - 1);
        return rows_[static_cast<std::size_t>(at.y)].coverage[static_cast<std::size_t>(at.x)] > 0;
    };
    for (int x = 0; x < size_.x; ++x) {
        const int lit =
            isLit(x, y) + isLit(x - 1, y) + isLit(x + 1, y) + isLit(x, y - 1) + isLit(x, y + 1);
        if (lit % 5 == 0) continue;
        int parts = 0;
        for (int i = 0; i < kFullCoverage; ++i) {
            const int column = i % 4, row = i / 4;
            const glm::dvec2 part(column + 0.5, row + 0.5);
            parts += isWhite(glm::dvec2(x, y) + part / 4.0) ? 1 : 0;
        }
        coverage[static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(parts);
    }
    return coverage;
}

// Sets the steps to the beams of the next pixels to the right and below; without a next beam they
// are those of the beam before.
void HallView::setSteps(int y) {
    const bool isLast = y + 1 == size_.y;
    const Row& other = rows_[static_cast<std::size_t>(isLast ? y - 1 : y + 1)];
    Row& row = rows_[static_cast<std::size_t>(y)];
    for (std::size_t channel = 0; channel < row.beams.size(); ++channel) {
        setStepsRight(row.beams[channel]);
        setStepsDown(row.beams[channel], other.beams[channel], isLast);
    }
}

void HallView::setStepsRight(std::vector<Beam>& beams) {
    for (std::size_t i = 0; i < beams.size(); ++i) {
        const bool goesOn = i + 1 < beams.size() && beams[i + 1].column == beams[i].column + 1;
        if (goesOn)
            beams[i].right = stepOf(beams[i].panelPixel, beams[i + 1].panelPixel);
        else if (i > 0)
            beams[i].right = beams[i - 1].right;
    }
}

void HallView::setStepsDown(std::vector<Beam>& beams,
                            const std::vector<Beam>& others,
                            bool areAbove) {
    auto near = others.begin();
    for (std::size_t i = 0; i < beams.size(); ++i) {
        while (near != others.end() && near->column < beams[i].column) ++near;
        if (near != others.end() && near->column == beams[i].column)
            beams[i].down = areAbove ? stepOf(near->panelPixel, beams[i].panelPixel)
                                     : stepOf(beams[i].panelPixel, near->panelPixel);
        else if (i > 0)
            beams[i].down = beams[i - 1].down;
    }
}

// Two by two samples of each pixel.
void HallView::light(const Row& row,
                     const std::vector<ThrownPicture>& pictures,
                     std::vector<glm::vec4>& sum) const {
    for (std::size_t channel = 0; channel < row.beams.size(); ++channel)
        for (const Beam& beam : row.beams[channel]) {
            const glm::vec2 right = 0.25F * vectorOf(beam.right),
                            down = 0.25F * vectorOf(beam.down);
            const ThrownPicture& picture = pictures[channel];
            const glm::vec4 light = picture.at(beam.panelPixel + right + down) +
                                    picture.at(beam.panelPixel + right - down) +
                                    picture.at(beam.panelPixel - right + down) +
                                    picture.at(beam.panelPixel - right - down);
            sum[beam.column] += 0.25F * beam.white * light;
        }
}

float HallView::albedo(std::uint8_t coverage) const {
    const float share = static_cast<float>(coverage) / kFullCoverage;
    return glm::mix(kDrapeAlbedo, static_cast<float>(hall_.hall().screen.albedo), share);
}

Light HallView::of(const std::vector<ThrownPicture>& pictures,
                   const Light& bounced,
                   HallLamps lamps) const {
    Light seen = darkness(size_);
    const auto dark = lamps.dark * static_cast<float>(hall_.hall().darkLight);
    const auto room = lamps.room * static_cast<float>(hall_.hall().roomLight);
    const bool bounces = bounced.rgb.size() > 1;
    pool_.run(rows_.size(), [&](std::size_t y) {
        const Row& row = rows_[y];
        std::vector<glm::vec4> sum(row.coverage.size());
        light(row, pictures, sum);
        for (std::size_t x = 0; x < sum.size(); ++x) {
            glm::vec3 falls = glm::vec3(sum[x]) + dark + room * row.room[x];
            if (!row.spot.empty()) falls += lamps.spot * row.spot[x];
            if (bounces)
                falls +=
                    bilinear(bounced, glm::dvec2(row.place[x]) * glm::dvec2(bounced.sizePixels));
            seen.rgb[y * sum.size() + x] = albedo(row.coverage[x]) * falls;
        }
    });
    return seen;
}

// The white of some channels, for each pixel of a row.
std::vector<float> HallView::whiteOf(const Row& row, std::uint64_t channels) const {
    std::vector<float> white(row.coverage.size());
    for (std::size_t channel = 0; channel < row.beams.size(); ++channel)
        if (config::contains(channels, channel))
            for (const Beam& beam : row.beams[channel]) white[beam.column] += beam.white;
    for (std::size_t x = 0; x < white.size(); ++x) white[x] *= albedo(row.coverage[x]);
    return white;
}

float HallView::brightestOf(std::uint64_t channels) const {
    constexpr std::size_t kRows = 4;  // of so many one is looked at
    std::vector<float> lit;
    for (std::size_t y = 0; y < rows_.size(); y += kRows)
        for (const float white : whiteOf(rows_[y], channels))
            if (white > 0) lit.push_back(white);
    if (lit.empty()) return 0;
    return valueAtRank(lit, lit.size() * 999 / 1000);
}

TrueLens eyeAt(glm::dvec3 position, glm::dvec3 lookAt, glm::ivec2 sizePixels, double halfWidth) {
    const config::HallCamera camera{.positionMetres = position,
                                    .lookAtMetres = lookAt,
                                    .sizePixels = sizePixels,
                                    .focalPixels = sizePixels.x / 2.0 / halfWidth,
                                    .principalPixels = glm::dvec2(sizePixels) / 2.0};
    return TrueLens(lensOf(camera));
}

Light seen(const TrueHall& hall, std::span<const Light> channels, const TrueLens& eye) {
    WorkerPool pool(std::thread::hardware_concurrency());
    const std::vector<ThrownPicture> pictures = allThrown(hall, channels);
    return HallView(hall, eye, pool).of(pictures, Bounce(hall).of(pictures), {});
}

LitScreen::LitScreen(const TrueHall& hall, std::span<const Light> channels)
    : hall_{hall}, pictures_{allThrown(hall, channels)}, bounced_{Bounce(hall).of(pictures_)} {}

glm::vec3 LitScreen::at(glm::dvec3 point) const {
    const glm::dvec2 place = hall_.screen().shape().unrolled(point);
    const glm::dvec3 there = hall_.screen().at(place).value_or(point);
    const glm::dvec3 normal = hall_.screen().normalAt(there);
    glm::vec3 falls(static_cast<float>(hall_.hall().darkLight));
    for (std::size_t channel = 0; channel < pictures_.size(); ++channel)
        if (const auto pixel = hall_.lens(hall_.projectorOf(channel)).pixelOf(there))
            falls += static_cast<float>(hall_.whiteOn(channel, there, normal)) *
                     glm::vec3(pictures_[channel].at(glm::vec2(*pixel)));
    if (bounced_.rgb.size() > 1)
        falls += bilinear(bounced_, place * glm::dvec2(bounced_.sizePixels));
    return static_cast<float>(hall_.hall().screen.albedo) * falls;
}

Light LitScreen::panorama(glm::ivec2 sizePixels) const {
    Light unrolled = darkness(sizePixels);
    for (int y = 0; y < sizePixels.y; ++y)
        for (int x = 0; x < sizePixels.x; ++x) {
            const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) / glm::dvec2(sizePixels);
            if (const auto point = hall_.screen().at(place)) unrolled.at(x, y) = at(*point);
        }
    return unrolled;
}

}  // namespace aquarama::hall
