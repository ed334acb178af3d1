// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "calibration/scan/pictures.h"
#include "common/wall/scan_pattern.h"
#include "common/wall/wall.h"

namespace aquarama::scan {

namespace {

using config::ScanPattern;
using Kind = ScanPattern::Kind;

// The panorama in cells, each with a bit for every channel that lights it.
constexpr glm::ivec2 kCells{128, 32};
// A margin around the area that a channel lights, since rigs hang crooked; as a share of the
// panorama.
constexpr double kSlack = 0.02;

using Cells = std::vector<std::uint64_t>;

std::size_t cellAt(int x, int y) {
    return static_cast<std::size_t>(y * kCells.x + x);
}

std::uint64_t litAt(const wall::Wall& wall, glm::dvec3 point) {
    std::uint64_t lit = 0;
    for (std::size_t c = 0; c < wall.channels(); ++c)
        if (wall.channel(c).pixelOf(point)) lit |= config::bitOf(c);
    return lit;
}

Cells litCells(const wall::Wall& wall) {
    Cells cells(static_cast<std::size_t>(kCells.x * kCells.y));
    for (int y = 0; y < kCells.y; ++y)
        for (int x = 0; x < kCells.x; ++x) {
            const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) / glm::dvec2(kCells);
            if (const auto point = wall.screen().at(place))
                cells[cellAt(x, y)] = litAt(wall, *point);
        }
    return cells;
}

std::uint64_t litAround(const Cells& cells, int x, int y) {
    const int reach = static_cast<int>(std::lround(kSlack * kCells.x));
    std::uint64_t lit = 0;
    for (int j = std::max(0, y - reach); j <= std::min(kCells.y - 1, y + reach); ++j)
        for (int i = std::max(0, x - reach); i <= std::min(kCells.x - 1, x + reach); ++i)
            lit |= cells[cellAt(i, j)];
    return lit;
}

// For each channel, the set of channels that may share light with it.
std::vector<std::uint64_t> neighboursOf(const config::Rig& rig) {
    const Cells cells = litCells(wall::Wall(rig));
    std::vector<std::uint64_t> neighbours(rig.channels.size());
    for (int y = 0; y < kCells.y; ++y)
        for (int x = 0; x < kCells.x; ++x) {
            const std::uint64_t lit = litAround(cells, x, y);
            for (std::size_t c = 0; c < neighbours.size(); ++c)
                if (config::contains(lit, c)) neighbours[c] |= lit;
        }
    return neighbours;
}

// Sets of channels that show their patterns together: each channel joins the first set where it has
// no neighbour.
std::vector<std::uint64_t> roundsOf(const config::Rig& rig) {
    const std::vector<std::uint64_t> neighbours = neighboursOf(rig);
    std::vector<std::uint64_t> rounds;
    for (std::size_t c = 0; c < neighbours.size(); ++c) {
        const auto free = std::ranges::find_if(
            rounds, [&](std::uint64_t round) { return (round & neighbours[c]) == 0; });
        std::uint64_t& round = free == rounds.end() ? rounds.emplace_back(0) : *free;
        round |= config::bitOf(c);
    }
    return rounds;
}

// Columns or rows of a channel's picture.
int linesOf(const config::Channel& channel, Kind kind) {
    return kind == Kind::GrayColumns ? channel.sizePixels.x : channel.sizePixels.y;
}

// The channels of a round whose Gray code has this bit: smaller pictures have fewer bits.
std::uint64_t withBit(const config::Rig& rig, std::uint64_t round, Kind kind, int bit) {
    std::uint64_t lit = 0;
    for (std::size_t c = 0; c < rig.channels.size(); ++c)
        if (wall::scanGrayBits(linesOf(rig.channels[c], kind), wall::kScanPeriodPixels / 2) > bit)
            lit |= round & config::bitOf(c);
    return lit;
}

// The bit of the stripes that are shown at the end of the scan, to detect a projector that moved
// meanwhile. All channels of the round have it, and it is coarse enough for the small copies.
int lateBit(const config::Rig& rig, std::uint64_t round, Kind kind) {
    constexpr int kFromFinest = 3;
    int bits = 0;
    while (withBit(rig, round, kind, bits) == round) ++bits;
    return std::max(0, bits - kFromFinest);
}
ScanPattern stripes(Kind kind, int bit, std::uint64_t lit) {
    return {.kind = kind, .step = static_cast<std::uint8_t>(bit), .lit = lit};
}

void addAxis(std::vector<ScanPattern>& sequence,
             const config::Rig& rig,
             std::uint64_t round,
             Kind gray,
             Kind phase) {
    const int late = lateBit(rig, round, gray);
    for (int bit = 0; withBit(rig, round, gray, bit) != 0; ++bit)
        if (bit != late) sequence.push_back(stripes(gray, bit, withBit(rig, round, gray, bit)));
    for (int step = 0; step < wall::kScanPhaseSteps; ++step)
        sequence.push_back({.kind = phase, .step = static_cast<std::uint8_t>(step), .lit = round});
}

void addRound(std::vector<ScanPattern>& sequence, const config::Rig& rig, std::uint64_t round) {
    addAxis(sequence, rig, round, Kind::GrayColumns, Kind::PhaseColumns);
    addAxis(sequence, rig, round, Kind::GrayRows, Kind::PhaseRows);
}

void addLateStripes(std::vector<ScanPattern>& sequence,
                    const config::Rig& rig,
                    std::uint64_t round) {
    for (const Kind kind : {Kind::GrayColumns, Kind::GrayRows})
        sequence.push_back(stripes(kind, lateBit(rig, round, kind), round));
}

// Adds patterns that all channels show at once: colours and levels for the responses of the
// channels, whose light adds up, and white in shorter exposures for the response of the camera.
// They have no tags, as other channels would light them.
void addLevels(std::vector<ScanPattern>& sequence, std::uint64_t all) {
    constexpr std::array<glm::vec3, 8> kLevels{{{1, 0, 0},
                                                {0, 1, 0},
                                                {0, 0, 1},
                                                glm::vec3(0.004F),
                                                glm::vec3(0.02F),
                                                glm::vec3(0.3F),
                                                glm::vec3(0.8F),
                                                glm::vec3(0.92F)}};
    for (const glm::vec3 light : kLevels)
        sequence.push_back({.light = light, .lit = all, .tagged = false});
    for (const std::uint8_t step : {std::uint8_t{1}, std::uint8_t{2}})
        sequence.push_back({.step = step, .lit = all, .tagged = false});
}

ScanPattern black() {
    return {.light = glm::vec3(0), .lit = 0, .tagged = false};
}

}  // namespace

std::vector<ScanPattern> sequenceOf(const config::Rig& rig) {
    std::vector<ScanPattern> sequence{{.kind = Kind::Room, .lit = 0, .tagged = false}, black()};
    for (std::size_t c = 0; c < rig.channels.size(); ++c)
        sequence.push_back({.lit = config::bitOf(c)});
    const std::vector<std::uint64_t> rounds = roundsOf(rig);
    std::uint64_t all = 0;
    for (const std::uint64_t round : rounds) {
        addRound(sequence, rig, round);
        all |= round;
    }
    addLevels(sequence, all);
    sequence.push_back(black());  // tells of light that came or went
    for (const std::uint64_t round : rounds) addLateStripes(sequence, rig, round);
    for (std::size_t i = 0; i < sequence.size(); ++i)
        sequence[i].number = static_cast<std::uint16_t>(i + 1);
    return sequence;
}

std::vector<ScanPattern> dotSequenceOf(const config::Rig& rig, bool isNumbered) {
    std::vector<ScanPattern> sequence{black()};
    const int steps = isNumbered ? static_cast<int>(std::bit_width(wall::scanDotNumber(
                                       rig.channels.size() - 1, wall::kScanDotCount - 1)))
                                 : 0;
    for (const std::uint64_t round : roundsOf(rig)) {
        sequence.push_back({.lit = round, .tagged = false});
        for (int step = 0; step <= steps; ++step)
            sequence.push_back({.kind = Kind::Dots,
                                .step = static_cast<std::uint8_t>(step),
                                .lit = round,
                                .tagged = false});
    }
    return sequence;
}

}  // namespace aquarama::scan
