// SPDX-License-Identifier: Apache-2.0
#include "drawings/read.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <glm/common.hpp>

#include "drawings/bleed.h"
#include "drawings/paper_light.h"
#include "drawings/refusal.h"
#include "drawings/tags.h"

namespace aquarama::drawings {

namespace {

constexpr std::size_t kLeastCorners = 3;

// Tags of one sheet.
struct SeenSheet {
    int species = 0, version = 0;
    std::map<Corner, FoundTag> tags;
};

// Codes row by row.
struct GreyPicture {
    glm::ivec2 sizePixels{};
    std::vector<std::uint8_t> codes;
};

GreyPicture greyOf(const Photo& photo) {
    GreyPicture grey{photo.sizePixels, std::vector<std::uint8_t>(photo.rgb.size() / 3)};
    for (std::size_t i = 0; i < grey.codes.size(); ++i)  // nearly luminance
        grey.codes[i] = static_cast<std::uint8_t>(
            (photo.rgb[3 * i] + 2 * photo.rgb[3 * i + 1] + photo.rgb[3 * i + 2]) / 4);
    return grey;
}

// Twice as large each way: a row or column, then the mean of it and the next.
GreyPicture doubled(const GreyPicture& grey) {
    const glm::ivec2 last = grey.sizePixels - 1;
    const auto code = [&](int x, int y) {
        return static_cast<int>(
            grey.codes[static_cast<std::size_t>(y) * static_cast<std::size_t>(grey.sizePixels.x) +
                       static_cast<std::size_t>(x)]);
    };
    GreyPicture large{2 * grey.sizePixels, {}};
    large.codes.reserve(4 * grey.codes.size());
    for (int y = 0; y < large.sizePixels.y; ++y)
        for (int x = 0; x < large.sizePixels.x; ++x) {
            const glm::ivec2 low{x / 2, y / 2}, high = glm::min(glm::ivec2{x + 1, y + 1} / 2, last);
            large.codes.push_back(
                static_cast<std::uint8_t>((code(low.x, low.y) + code(high.x, low.y) +
                                           code(low.x, high.y) + code(high.x, high.y) + 2) /
                                          4));
        }
    return large;
}

// Those of a picture that is twice as large, in pixels of the small one. The first pixel of the
// large one is the first of the small one, not a half of it.
std::vector<FoundTag> tagsOfDoubled(const GreyPicture& grey) {
    const GreyPicture large = doubled(grey);
    std::vector<FoundTag> tags = findTags(large.codes, large.sizePixels, 1);
    for (FoundTag& tag : tags)
        for (glm::dvec2& corner : tag.corners) corner = (corner - 0.5) / 2.0 + 0.5;
    return tags;
}

// Small pictures are looked at closely where a tag is missing.
std::vector<FoundTag> tagsOf(const Photo& photo) {
    constexpr int kPixelsToSearch = 1500;  // each way
    const GreyPicture grey = greyOf(photo);
    const int longer = std::max(grey.sizePixels.x, grey.sizePixels.y);
    std::vector<FoundTag> tags =
        findTags(grey.codes, grey.sizePixels, static_cast<float>(1 + longer / kPixelsToSearch));
    if (tags.size() >= kCorners || longer >= kPixelsToSearch) return tags;
    return tagsOfDoubled(grey);
}

// The one sheet that is seen. Throws Refusal.
SeenSheet seenSheet(const std::vector<FoundTag>& tags) {
    std::map<std::pair<int, int>, SeenSheet> sheets;
    for (const FoundTag& tag : tags) {
        const auto code = codeOf(tag.id);
        if (!code) continue;
        SeenSheet& sheet = sheets[{code->version, code->species}];
        sheet.version = code->version;
        sheet.species = code->species;
        if (!sheet.tags.emplace(code->corner, tag).second)
            throw Refusal(RefusalReason::SeveralSheets);
    }
    if (sheets.empty()) throw Refusal(RefusalReason::NoSheet);
    if (sheets.size() > 1) throw Refusal(RefusalReason::SeveralSheets);
    return sheets.begin()->second;
}

// Throws Refusal where the sheet is not whole or not of this version.
const Sheet& knownSheet(const SeenSheet& seen, const SheetOf& sheetOf) {
    if (seen.tags.size() < kLeastCorners) throw Refusal(RefusalReason::TooFewCorners);
    if (seen.version != kSheetVersion) throw Refusal(RefusalReason::OtherVersion);
    const Sheet* sheet = sheetOf(seen.species);
    if (sheet == nullptr) throw Refusal(RefusalReason::UnknownSpecies);
    return *sheet;
}

Flattening flatten(const SeenSheet& seen) {
    std::vector<Correspondence> pairs;
    for (const auto& [corner, tag] : seen.tags)
        for (std::size_t k = 0; k < tag.corners.size(); ++k)
            pairs.push_back({tagOn(corner).at(k), tag.corners.at(k)});
    return flatten(pairs);
}

// Throws Refusal where the fish cannot be read at that place.
void requireReadable(const Flattening& flat, const Photo& photo, const Sheet& sheet) {
    constexpr double kMostBend = 3;           // millimetres
    constexpr double kLeastResolution = 0.7;  // pixels to a millimetre
    if (flat.worstMillimetres > kMostBend) throw Refusal(RefusalReason::NotFlat);
    for (const Polyline& line : sheet.likeness.outline)
        for (const glm::vec2 texel : line) {
            const glm::dvec2 at = sheet.place.sheetAt(texel);
            const glm::dvec2 pixel = flat.photoAt(at);
            if (pixel.x < 0 || pixel.y < 0 || pixel.x > photo.sizePixels.x ||
                pixel.y > photo.sizePixels.y)
                throw Refusal(RefusalReason::CutOff);
            if (flat.pixelsPerMillimetre(at).x < kLeastResolution)
                throw Refusal(RefusalReason::TooSmall);
        }
}

// The mean light of a texel.
glm::vec3 lightOf(const PhotoLight& photo,
                  const Flattening& flat,
                  const SkinOnSheet& place,
                  glm::ivec2 texel,
                  int samples) {
    glm::vec3 sum{};
    for (int y = 0; y < samples; ++y)
        for (int x = 0; x < samples; ++x) {
            const glm::dvec2 within = (glm::dvec2{x, y} + 0.5) / static_cast<double>(samples);
            sum += photo.at(flat.photoAt(place.sheetAt(glm::dvec2(texel) + within)));
        }
    return sum / static_cast<float>(samples * samples);
}

std::uint16_t codeOf(double linear) {
    return static_cast<std::uint16_t>(
        std::lround(255 * srgbFromLinear(std::clamp(linear, 0.0, 1.0))));
}

// Samples a texel takes each way, so that all pixels of the photo count.
int samplesOf(const Flattening& flat, const SkinOnSheet& place) {
    constexpr int kMost = 4;
    const double pixels = flat.pixelsPerMillimetre({0, 0}).y * place.millimetresPerTexel;
    return std::clamp(static_cast<int>(std::ceil(pixels)), 1, kMost);
}

PngPicture skinOf(const Photo& photo, const Flattening& flat, const Sheet& sheet) {
    const PhotoLight light(photo);
    const PaperLight paper(light, flat, sheet);
    const int samples = samplesOf(flat, sheet.place);
    PngPicture skin{.sizePixels = body::kSideTexels, .components = 4, .bits = 8, .codes = {}};
    for (int y = 0; y < skin.sizePixels.y; ++y)
        for (int x = 0; x < skin.sizePixels.x; ++x) {
            const float alpha = coverage(sheet.likeness, {x, y});
            glm::dvec3 colour{};
            if (alpha > 0)
                colour = lightOf(light, flat, sheet.place, {x, y}, samples) /
                         paper.at(sheet.place.sheetAt(glm::dvec2{x, y} + 0.5));
            for (int c = 0; c < 3; ++c) skin.codes.push_back(codeOf(colour[c]));
            skin.codes.push_back(static_cast<std::uint16_t>(std::lround(255 * alpha)));
        }
    bleed(skin, kOutlineMillimetres / sheet.place.millimetresPerTexel);
    return skin;
}

}  // namespace

Drawing readDrawing(const Photo& photo, const SheetOf& sheetOf) {
    const SeenSheet seen = seenSheet(tagsOf(photo));
    const Sheet& sheet = knownSheet(seen, sheetOf);
    const Flattening flat = flatten(seen);
    requireReadable(flat, photo, sheet);
    return {sheet.species, skinOf(photo, flat, sheet), flat};
}

}  // namespace aquarama::drawings
