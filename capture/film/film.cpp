// SPDX-License-Identifier: Apache-2.0
#include "capture/film/film.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "common/base/dot_font.h"
#include "common/base/units.h"

namespace aquarama::film {

namespace {

// The picture: three bands, each with a view from above and one from the side, and below them the
// curves. Lengths in pixels.
constexpr int kBandHeight = 204;
constexpr int kAboveWidth = 520;
constexpr int kGap = 4;
constexpr int kCurvesTop = 3 * kBandHeight;
constexpr int kSamples = 2;          // a pixel each way
constexpr float kAbovePixels = 160;  // a body length; a fish across fits into the band
constexpr float kMostSidePixels = 250;

constexpr glm::vec3 kWater{0.16F, 0.25F, 0.30F};
constexpr glm::vec3 kSpeck{0.55F, 0.66F, 0.70F};
constexpr glm::vec3 kPaper{0.02F, 0.03F, 0.04F};
constexpr glm::vec3 kInk{0.9F, 0.92F, 0.92F};
constexpr glm::vec3 kFaint{0.25F, 0.28F, 0.3F};
constexpr glm::vec3 kGhost{1.0F, 0.28F, 0.03F};
constexpr glm::vec3 kOfFish{0.35F, 0.75F, 1.0F};

// The cameras follow the mean over so many ticks to either side.
constexpr std::size_t kCentreTicks = 4;
constexpr std::size_t kHeadingTicks = 45;
// From the side a camera looks a little from ahead and from above.
constexpr float kAhead = 25 * kRadiansPerDegree<float>;
constexpr float kElevation = 12 * kRadiansPerDegree<float>;

// Slow motion.
constexpr int kSlowness = 4;
constexpr std::size_t kSlowTicksAfter = 8;  // of what follows a fast start

// The curves: the last seconds, and the greatest values.
constexpr std::size_t kCurveTicks = 480;
constexpr double kMostBodyLengths = 0.5;
constexpr double kMostDegrees = 45;

constexpr std::size_t kSlipTicks = 15;  // to either side
constexpr double kSlowest = 0.2;        // body lengths a second

template <typename Value>
Value meanAbout(const std::vector<Value>& values, std::size_t at, std::size_t ticks) {
    const std::size_t first = at > ticks ? at - ticks : 0;
    const std::size_t last = std::min(at + ticks, values.size() - 1);
    Value sum{};
    for (std::size_t i = first; i <= last; ++i) sum += values[i];
    return sum / static_cast<float>(last - first + 1);
}

void fillRectangle(Light& picture, glm::ivec2 from, glm::ivec2 size, glm::vec3 colour) {
    const glm::ivec2 least = glm::max(from, glm::ivec2(0));
    const glm::ivec2 most = glm::min(from + size, picture.sizePixels);
    for (int y = least.y; y < most.y; ++y)
        for (int x = least.x; x < most.x; ++x) picture.at(x, y) = colour;
}

// Characters are of the font: capitals.
void write(Light& picture, glm::ivec2 at, int dot, const std::string& text, glm::vec3 colour) {
    for (const char character : text) {
        const GlyphBits bits = glyphOf(character);
        for (std::size_t row = 0; row < kGlyphRows; ++row)
            for (std::size_t column = 0; column < kGlyphColumns; ++column)
                if ((bits >> (row * kGlyphColumns + column) & 1U) != 0)
                    fillRectangle(
                        picture,
                        at + dot * glm::ivec2(static_cast<int>(column), static_cast<int>(row)),
                        {dot, dot},
                        colour);
        at.x += dot * static_cast<int>(kGlyphColumns + 1);
    }
}

// "turn_left_sharp" as "TURN LEFT SHARP".
std::string inCapitals(std::string text) {
    for (char& character : text)
        character = character == '_'
                        ? ' '
                        : static_cast<char>(std::toupper(static_cast<unsigned char>(character)));
    return text;
}

// Specks that hang in the water, on a lattice of half a body length: what the fish passes.
void drawSpecks(Light& paper, const FarView& view) {
    constexpr float kStep = 0.5F;
    constexpr float kDepth = 0.6F;  // to either side; farther specks are not shown
    const glm::vec2 reach = glm::vec2(paper.sizePixels) / (2 * view.pixels);
    const float most = glm::length(reach) + kDepth;
    const glm::ivec3 middle(glm::round(view.centre / kStep));
    const int steps = static_cast<int>(std::ceil(most / kStep));
    const bool isFromAbove = view.towards.y > 0.99F;  // all levels look alike
    for (int x = -steps; x <= steps; ++x)
        for (int y = isFromAbove ? 0 : -steps; y <= (isFromAbove ? 0 : steps); ++y)
            for (int z = -steps; z <= steps; ++z) {
                const glm::vec3 place = kStep * glm::vec3(middle + glm::ivec3(x, y, z));
                const float depth =
                    isFromAbove ? 0 : std::abs(glm::dot(place - view.centre, view.towards));
                if (depth >= kDepth) continue;
                const glm::ivec2 at(view.onPaper(place, paper.sizePixels));
                const float seen = 1 - depth / kDepth;
                for (int j = -2; j < 2; ++j)
                    for (int i = -2; i < 2; ++i) {
                        const glm::ivec2 pixel = at + glm::ivec2(i, j);
                        if (glm::any(glm::lessThan(pixel, glm::ivec2(0))) ||
                            glm::any(glm::greaterThanEqual(pixel, paper.sizePixels)))
                            continue;
                        glm::vec3& light = paper.at(pixel.x, pixel.y);
                        light = glm::mix(light, kSpeck, seen);
                    }
            }
}

void putShrunk(const Light& fine, Light& picture, glm::ivec2 corner) {
    const glm::ivec2 size = fine.sizePixels / kSamples;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            glm::vec3 sum{};
            for (int j = 0; j < kSamples; ++j)
                for (int i = 0; i < kSamples; ++i)
                    sum += fine.at(kSamples * x + i, kSamples * y + j);
            picture.at(corner.x + x, corner.y + y) = sum / static_cast<float>(kSamples * kSamples);
        }
}

// Light as codes of sRGB of 8 bits, by a table.
Picture encoded(const Light& light) {
    constexpr std::size_t kSteps = 8192;
    static const std::vector<std::uint16_t> codes = [] {
        std::vector<std::uint16_t> made;
        for (std::size_t i = 0; i <= kSteps; ++i)
            made.push_back(static_cast<std::uint16_t>(
                std::lround(255 * srgbFromLinear(static_cast<double>(i) / kSteps))));
        return made;
    }();
    Picture picture{.sizePixels = light.sizePixels, .bits = 8, .rgb = {}};
    picture.rgb.reserve(3 * light.rgb.size());
    for (const glm::vec3& pixel : light.rgb)
        for (int c = 0; c < 3; ++c)
            picture.rgb.push_back(codes[static_cast<std::size_t>(
                std::clamp(pixel[c], 0.0F, 1.0F) * static_cast<float>(kSteps) + 0.5F)]);
    return picture;
}

std::string degreesText(const std::optional<double>& degrees) {
    return degrees ? fmt::format("{:2.0f}", *degrees) : " -";
}

// How high a body at rest is with its median fins, body lengths.
float heightOf(const body::FishBody& body) {
    float least = 0, most = 0;
    for (const body::CageVertex& vertex : body.cage.vertices) {
        least = std::min(least, vertex.rest.y);
        most = std::max(most, vertex.rest.y);
    }
    return most - least;
}

}  // namespace

std::optional<double> slipDegrees(const report::Trace& trace, std::size_t tick) {
    if (tick < kSlipTicks || tick + kSlipTicks >= trace.size()) return std::nullopt;
    const glm::dvec3 path =
        trace[tick + kSlipTicks].frame.origin - trace[tick - kSlipTicks].frame.origin;
    if (glm::length(path) * kTicksPerSecond < kSlowest * 2 * kSlipTicks) return std::nullopt;
    glm::dvec3 faces{};
    for (std::size_t i = tick - kSlipTicks; i <= tick + kSlipTicks; ++i)
        faces += trace[i].frame.worldFromBody[0];
    const double cosine = glm::dot(glm::normalize(path), glm::normalize(faces));
    if (cosine < 0) return std::nullopt;
    return std::acos(std::min(cosine, 1.0)) / kRadiansPerDegree<double>;
}

Film::Film(Shown shown) : shown_(std::move(shown)) {
    assert(shown_.fish.size() == shown_.replica.size());
    std::size_t start = 0;
    double beatBefore = shown_.script.front().beatTicks;
    for (std::size_t i = 0; i < shown_.script.size(); ++i) {
        const report::ScriptCommand& command = shown_.script[i];
        overlays_.emplace_back(shown_.fish, shown_.replica, start, beatBefore);
        commands_.insert(commands_.end(), static_cast<std::size_t>(command.ticks), i);
        start += static_cast<std::size_t>(command.ticks);
        beatBefore = command.beatTicks;
    }
    assert(shown_.fish.size() == start + 1);
    listTicks();
    fishTrack_ = trackOf(shown_.fish);
    replicaTrack_ = trackOf(shown_.replica);
    for (std::size_t tick = 0; tick < commands_.size(); ++tick) {
        distance_.push_back(overlayAt(tick).distanceAt(tick));
        fishSlip_.push_back(slipDegrees(shown_.fish, tick));
        replicaSlip_.push_back(slipDegrees(shown_.replica, tick));
    }
    sidePixels_ =
        std::min(kMostSidePixels, 0.85F * static_cast<float>(kBandHeight) / heightOf(shown_.body));
}

// The run-in is not shown.
void Film::listTicks() {
    const auto first = static_cast<std::size_t>(shown_.script.front().ticks);
    std::size_t sinceStart = kSlowTicksAfter;  // ticks since the last fast start ended
    int due = 0;                               // player's ticks that are not filled yet
    for (std::size_t tick = first; tick < commands_.size(); ++tick) {
        const bool starts = report::isStart(shown_.script[commands_[tick]].manoeuvre);
        sinceStart = starts ? 0 : sinceStart + 1;
        for (due += sinceStart < kSlowTicksAfter ? kSlowness : 1; due >= kTicksAPicture;
             due -= kTicksAPicture)
            ticks_.push_back(tick);
    }
}

Film::Track Film::trackOf(const report::Trace& trace) {
    std::vector<glm::vec3> places;
    std::vector<float> headings;
    double turned = 0;
    for (const report::TracePoint& point : trace) {
        const glm::dvec3& nose = point.frame.worldFromBody[0];
        turned += report::wrapped(std::atan2(-nose.z, nose.x) - turned);
        places.emplace_back(point.frame.origin);
        headings.push_back(static_cast<float>(turned));
    }
    Track track;
    for (std::size_t tick = 0; tick < trace.size(); ++tick) {
        track.centre.push_back(meanAbout(places, tick, kCentreTicks));
        track.heading.push_back(meanAbout(headings, tick, kHeadingTicks));
    }
    return track;
}

const report::Overlay& Film::overlayAt(std::size_t tick) const {
    return overlays_[commands_[tick]];
}

FarView Film::viewOf(const Track& track, std::size_t tick, bool isFromAbove) const {
    FarView view{
        .centre = track.centre[tick],
        .pixels = static_cast<float>(kSamples) * (isFromAbove ? kAbovePixels : sidePixels_)};
    if (isFromAbove) return view;
    const float heading = track.heading[tick];
    const glm::vec3 nose(std::cos(heading), 0, -std::sin(heading));
    const glm::vec3 side(std::sin(heading), 0, std::cos(heading));
    const glm::vec3 level = std::cos(kAhead) * side + std::sin(kAhead) * nose;
    view.right = std::cos(kAhead) * nose - std::sin(kAhead) * side;
    view.towards = std::cos(kElevation) * level + glm::vec3(0, std::sin(kElevation), 0);
    view.up = glm::cross(view.towards, view.right);
    return view;
}

void Film::drawBand(Light& picture,
                    int band,
                    std::size_t tick,
                    const PosedSurface& surface,
                    const PosedSurface* ghost) const {
    const Track& track = band == 1 ? replicaTrack_ : fishTrack_;
    for (const bool isFromAbove : {true, false}) {
        const int left = isFromAbove ? 0 : kAboveWidth + kGap;
        const int width = isFromAbove ? kAboveWidth : kFilmPixels.x - left;
        Light paper = darkness(kSamples * glm::ivec2(width, kBandHeight - kGap));
        std::ranges::fill(paper.rgb, kWater);
        const FarView view = viewOf(track, tick, isFromAbove);
        drawSpecks(paper, view);
        drawFish(paper, shown_.skin, surface, view);
        if (ghost != nullptr) drawGhost(paper, shown_.skin, *ghost, view, kGhost);
        putShrunk(paper, picture, {left, band * kBandHeight});
    }
}

void Film::drawLabels(Light& picture, std::size_t number) const {
    const std::size_t tick = ticks_[number];
    const report::ScriptCommand& command = shown_.script[commands_[tick]];
    const std::array<std::string, 3> bands{
        "SIMULATED FISH", "REPLICA", "BOTH, THE REPLICA AS GHOST"};
    for (int band = 0; band < 3; ++band) {
        const int y = band * kBandHeight + 8;
        write(picture, {8, y}, 2, bands.at(static_cast<std::size_t>(band)), kInk);
        write(picture, {kAboveWidth - 72, y + kBandHeight - 24}, 1, "FROM ABOVE", kInk);
        write(picture, {kFilmPixels.x - 96, y + kBandHeight - 24}, 1, "FROM THE SIDE", kInk);
    }
    const bool isSlow = (number > 0 && ticks_[number - 1] == tick) ||
                        (number + 1 < ticks_.size() && ticks_[number + 1] == tick);
    write(picture,
          {kAboveWidth + 16, 8},
          2,
          inCapitals(report::nameOf(command.manoeuvre)) + (isSlow ? "  (1/4 SPEED)" : ""),
          kInk);
    const auto start = static_cast<std::size_t>(shown_.script.front().ticks);
    write(picture,
          {kFilmPixels.x - 90, 8},
          2,
          fmt::format("{:4.1f} S", static_cast<double>(tick - start) / kTicksPerSecond),
          kInk);
    write(picture, {kAboveWidth + 16, 28}, 1, inCapitals(shown_.body.species), kInk);
}

// Left the names and the values now, right the last seconds: distance above, slip below.
void Film::drawCurves(Light& picture, std::size_t number) const {
    constexpr int kLeft = 270;
    constexpr int kHeight = 44;
    const std::size_t now = ticks_[number];
    const int width = kFilmPixels.x - kLeft - 8;
    const auto columnOf = [&](std::size_t tick) {
        return kLeft + width - 1 -
               static_cast<int>((now - tick) * static_cast<std::size_t>(width) / kCurveTicks);
    };
    const auto first = static_cast<std::size_t>(shown_.script.front().ticks);
    const std::size_t from = std::max(first, now > kCurveTicks ? now - kCurveTicks : 0);
    const auto draw = [&](int top, double most, glm::vec3 colour, const auto& valueAt) {
        for (std::size_t tick = from; tick <= now; ++tick) {
            const std::optional<double> value = valueAt(tick);
            if (!value) continue;
            const int y =
                top + kHeight - 2 - static_cast<int>(std::min(*value / most, 1.0) * (kHeight - 3));
            fillRectangle(picture, {columnOf(tick), y}, {3, 2}, colour);
        }
    };
    const int distanceTop = kCurvesTop + 8;
    const int slipTop = distanceTop + kHeight + 8;
    for (const int top : {distanceTop, slipTop}) {
        fillRectangle(picture, {kLeft, top + kHeight - 1}, {width, 1}, kFaint);
        fillRectangle(picture, {kLeft, top}, {width, 1}, kFaint);
        for (std::size_t tick = from + 1; tick <= now; ++tick)
            if (commands_[tick] != commands_[tick - 1])
                fillRectangle(picture, {columnOf(tick), top}, {1, kHeight}, kFaint);
    }
    draw(distanceTop, kMostBodyLengths, kGhost, [&](std::size_t tick) {
        return std::optional(distance_[tick]);
    });
    draw(slipTop, kMostDegrees, kOfFish, [&](std::size_t tick) { return fishSlip_[tick]; });
    draw(slipTop, kMostDegrees, kGhost, [&](std::size_t tick) { return replicaSlip_[tick]; });

    write(picture,
          {8, distanceTop + 2},
          2,
          fmt::format("DISTANCE {:.2f} BL", distance_[now]),
          kGhost);
    write(picture, {8, distanceTop + 28}, 1, "REPLICA LAID OVER THE FISH AT EACH", kInk);
    write(picture, {8, distanceTop + 37}, 1, "COMMAND; ABOVE: 0 TO 0.5 BL", kInk);
    write(picture, {8, slipTop + 2}, 2, "SLIP", kInk);
    write(picture, {66, slipTop + 2}, 2, degreesText(fishSlip_[now]) + " DEG", kOfFish);
    write(picture, {162, slipTop + 2}, 2, degreesText(replicaSlip_[now]) + " DEG", kGhost);
    write(picture, {8, slipTop + 24}, 1, "FISH BLUE, REPLICA ORANGE; 0 TO 45 DEG", kInk);
    write(picture, {8, slipTop + 33}, 1, "LAST 8 S; A LINE AT EACH COMMAND", kInk);
}

Picture Film::picture(std::size_t number) const {
    assert(number < ticks_.size());
    const std::size_t tick = ticks_[number];
    const skin::LimitTable& table = shown_.skin.table;
    const PosedSurface fish = surfaceAt(shown_.body, table, shown_.fish, tick);
    const PosedSurface replica = surfaceAt(shown_.body, table, shown_.replica, tick);
    const report::Overlay& overlay = overlayAt(tick);
    const PosedSurface ghost =
        moved(replica, shown_.replica[tick].frame.origin, overlay.at(tick), overlay.turnRadians());
    Light light = darkness(kFilmPixels);
    std::ranges::fill(light.rgb, kPaper);
    drawBand(light, 0, tick, fish, nullptr);
    drawBand(light, 1, tick, replica, nullptr);
    drawBand(light, 2, tick, fish, &ghost);
    drawLabels(light, number);
    drawCurves(light, number);
    return encoded(light);
}

}  // namespace aquarama::film
