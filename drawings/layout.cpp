// SPDX-License-Identifier: Apache-2.0
#include "drawings/layout.h"

#include <algorithm>
#include <cassert>

#include <glm/common.hpp>

namespace aquarama::drawings {

namespace {

// From tags and text to the outline.
constexpr double kGap = 6;
constexpr double kTextHeight = 8;

// A rectangle in millimetres.
struct Box {
    glm::dvec2 centre, size;
};

// Of the outline, in texels.
Box boxOf(const Likeness& likeness) {
    glm::vec2 least{1e9F}, most{-1e9F};
    for (const Polyline& line : likeness.outline)
        for (const glm::vec2 at : line) {
            least = glm::min(least, at);
            most = glm::max(most, at);
        }
    return {glm::dvec2{least + most} / 2.0, most - least};
}

}  // namespace

int idOf(const TagCode& code) {
    assert(code.species >= 0 && code.species < kMostSpecies);
    assert(code.version >= 1 && code.version <= kMostVersions);
    return static_cast<int>(code.corner) +
           static_cast<int>(kCorners) * (code.species + kMostSpecies * (code.version - 1));
}

std::optional<TagCode> codeOf(int id) {
    constexpr int kTags = static_cast<int>(kCorners);
    if (id < 0 || id >= kTags * kMostSpecies * kMostVersions) return std::nullopt;
    return TagCode{.species = id / kTags % kMostSpecies,
                   .version = id / kTags / kMostSpecies + 1,
                   .corner = static_cast<Corner>(id % kTags)};
}

TagCorners tagOn(Corner corner) {
    const bool isRight = corner == Corner::UpperRight || corner == Corner::LowerRight;
    const bool isUpper = corner == Corner::UpperLeft || corner == Corner::UpperRight;
    const glm::dvec2 outer = kFieldMillimetres / 2.0;
    const double x = isRight ? outer.x - kTagMillimetres : -outer.x;
    const double y = isUpper ? outer.y : -outer.y + kTagMillimetres;
    return {{{x, y},
             {x + kTagMillimetres, y},
             {x + kTagMillimetres, y - kTagMillimetres},
             {x, y - kTagMillimetres}}};
}

SkinOnSheet placeOf(const Likeness& likeness) {
    const Box box = boxOf(likeness);
    const double tags = kTagMillimetres + kGap;
    const Box wide{{0, 0}, kFieldMillimetres - glm::dvec2{0, 2 * tags}};
    const Box high{{0, kTextHeight / 2}, kFieldMillimetres - glm::dvec2{2 * tags, kTextHeight}};
    const auto scaleIn = [&](const Box& room) {
        return std::min(room.size.x / box.size.x, room.size.y / box.size.y);
    };
    const Box& room = scaleIn(wide) > scaleIn(high) ? wide : high;
    SkinOnSheet place{.millimetresPerTexel = scaleIn(room), .upperLeft = {}};
    place.upperLeft = room.centre - (place.sheetAt(box.centre) - place.upperLeft);
    return place;
}

}  // namespace aquarama::drawings
