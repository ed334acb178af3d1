// SPDX-License-Identifier: Apache-2.0
#include "tests/drawings/other_pictures.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <apriltag/apriltag.h>
#include <apriltag/tag25h9.h>

#include "common/base/hash.h"
#include "common/base/picture.h"
#include "drawings/tags.h"
#include "tests/drawings/snapshot.h"

namespace aquarama::test {

namespace {

using drawings::Corner;
using drawings::Photo;
using drawings::TagPattern;

TagPattern allBlack() {
    TagPattern pattern{};
    for (auto& row : pattern) row.fill(true);
    return pattern;
}

// A tag of 25h9, seven modules wide, and a column and a row of paper.
TagPattern otherFamily(std::uint32_t id) {
    const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> family(tag25h9_create(),
                                                                                  tag25h9_destroy);
    TagPattern pattern = allBlack();
    for (std::uint32_t bit = 0; bit < family->nbits; ++bit)
        if ((family->codes[id % family->ncodes] >> (family->nbits - 1 - bit) & 1U) != 0)
            pattern.at(family->bit_y[bit]).at(family->bit_x[bit]) = false;
    for (std::size_t i = 0; i < pattern.size(); ++i)
        pattern.at(i).back() = pattern.back().at(i) = false;
    return pattern;
}

TagPattern modules(std::uint32_t seed, bool isRandom) {
    TagPattern pattern = allBlack();
    for (std::size_t y = 1; y + 1 < pattern.size(); ++y)
        for (std::size_t x = 1; x + 1 < pattern.size(); ++x)
            pattern.at(y).at(x) =
                isRandom ? hashOf(seed + static_cast<std::uint32_t>(8 * y + x)) % 2 == 0
                         : (x + y) % 2 == 0;
    return pattern;
}

TagPattern faulty(TagFault fault, int species, Corner corner, std::uint32_t seed) {
    const int index = static_cast<int>(corner);
    const auto tagOf = [corner](int number, int version) {
        return drawings::tagPattern(
            drawings::idOf({.species = number, .version = version, .corner = corner}));
    };
    switch (fault) {
        case TagFault::OtherFamily:
            return otherFamily(seed + static_cast<std::uint32_t>(index));
        case TagFault::RandomModules:
            return modules(seed + static_cast<std::uint32_t>(100 * index), true);
        case TagFault::TwoOnly:
            return index % 2 == 0 ? tagOf(species, 1) : TagPattern{};
        case TagFault::SeveralSpecies:
            return tagOf(index, 1);
        case TagFault::Exchanged:
            return drawings::tagPattern(
                drawings::idOf({.species = species, .corner = static_cast<Corner>(index ^ 1)}));
        case TagFault::OtherVersion:
            return tagOf(species, 2);
        case TagFault::UnknownSpecies:
            return tagOf(drawings::kMostSpecies - 1, 1);
        case TagFault::Checkers:
            return modules(0, false);
    }
    return {};
}

// Prints a tag in a corner, over what is there.
void print(PaintedSheet& paper, Corner corner, const TagPattern& pattern) {
    const drawings::TagCorners at = drawings::tagOn(corner);
    const double module = drawings::kTagMillimetres / drawings::kTagModules;
    for (int y = 0; y < paper.paper.sizePixels.y; ++y)
        for (int x = 0; x < paper.paper.sizePixels.x; ++x) {
            const glm::dvec2 off =
                glm::dvec2{x, y} + 0.5 - glm::dvec2(paper.paper.sizePixels) / 2.0;
            const glm::dvec2 place =
                (glm::dvec2{off.x, -off.y} / paper.pixelsPerMillimetre - at.front()) / module;
            const glm::dvec2 from{place.x, -place.y};
            if (from.x < 0 || from.y < 0 || from.x >= drawings::kTagModules ||
                from.y >= drawings::kTagModules)
                continue;
            const bool isBlack =
                pattern.at(static_cast<std::size_t>(from.y)).at(static_cast<std::size_t>(from.x));
            paper.paper.at(x, y) = glm::vec3(isBlack ? 0.02F : 1.0F);
        }
}

// Lines of words: dark rows, in which noise leaves gaps.
PaintedSheet pageOfText(PaintedSheet paper, std::uint32_t seed) {
    for (int y = 0; y < paper.paper.sizePixels.y; ++y)
        for (int x = 0; x < paper.paper.sizePixels.x; ++x) {
            const glm::dvec2 at = glm::dvec2{x, y} / paper.pixelsPerMillimetre;
            const bool isInk = static_cast<int>(at.y / 3) % 2 == 0 && at.x > 25 && at.y > 20 &&
                               smoothNoise(at / glm::dvec2{6, 6}, seed) > 0.25F &&
                               smoothNoise(at / glm::dvec2{0.7, 1.3}, seed + 1) > 0.55F;
            paper.paper.at(x, y) = glm::vec3(isInk ? 0.05F : 1.0F);
        }
    return paper;
}

Photo noise(std::uint32_t seed) {
    std::minstd_rand random(seed + 1);
    const double cell = 1 + static_cast<int>(random() % 40);
    Photo photo{{800, 600}, {}};
    for (int y = 0; y < photo.sizePixels.y; ++y)
        for (int x = 0; x < photo.sizePixels.x; ++x)
            for (std::uint32_t c = 0; c < 3; ++c)
                photo.rgb.push_back(static_cast<std::uint8_t>(
                    255 * smoothNoise(glm::dvec2{x, y} / cell, seed + 7 * c)));
    return photo;
}

Photo golden(std::uint32_t number) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(AQUARAMA_SOURCE_DIR "/tests/golden"))
        if (entry.path().extension() == ".png") files.push_back(entry.path());
    std::ranges::sort(files);
    const Picture picture = readPng(files[number % files.size()].string());
    Photo photo{picture.sizePixels, {}};
    for (const std::uint16_t code : picture.rgb)
        photo.rgb.push_back(static_cast<std::uint8_t>(picture.bits == 16 ? code >> 8 : code));
    return photo;
}

Photo snapshotOf(const PaintedSheet& paper, std::uint32_t seed) {
    constexpr double kMostMegapixels = 1;
    const Circumstances how = circumstancesOf(seed, kMostMegapixels);
    return photographed(paper, how, Camera(how, drawings::kA4));
}

}  // namespace

PaintedSheet withFault(const drawings::Sheet& sheet,
                       PaintedSheet paper,
                       TagFault fault,
                       std::uint32_t seed) {
    for (const auto corner :
         {Corner::UpperLeft, Corner::UpperRight, Corner::LowerRight, Corner::LowerLeft})
        print(paper, corner, faulty(fault, sheet.number, corner, seed));
    return paper;
}

Photo otherPicture(drawings::Catalogue& catalogue, std::uint32_t number) {
    constexpr std::uint32_t kKinds = kTagFaults + 4;
    const drawings::Sheet& sheet = catalogue.sheetOf("clownfish");
    static const PaintedSheet paper = printed(sheet, drawings::kA4);
    const std::uint32_t kind = number % kKinds;
    if (kind < kTagFaults)
        return snapshotOf(withFault(sheet, paper, static_cast<TagFault>(kind), number), number);
    PaintedSheet bare = paper;
    std::ranges::fill(bare.paper.rgb, glm::vec3(1));
    if (kind == kTagFaults) return snapshotOf(bare, number);
    if (kind == kTagFaults + 1) return snapshotOf(pageOfText(std::move(bare), number), number);
    return kind == kTagFaults + 2 ? noise(number) : golden(number / kKinds);
}

}  // namespace aquarama::test
