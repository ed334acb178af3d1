// SPDX-License-Identifier: Apache-2.0
#include "tests/drawings/judged.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <map>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "common/base/files.h"
#include "tests/drawings/painted_sheet.h"
#include "tests/drawings/sample_photos.h"
#include "tests/drawings/snapshot.h"
#include "tests/support/colour_difference.h"

namespace aquarama::test {

namespace {

using drawings::Drawing;
using drawings::Sheet;

double processorSeconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// Half of the sheets on A4, half on Letter; each printed once.
const PaintedSheet& blank(const Sheet& sheet, bool isLetter) {
    static std::map<std::pair<int, bool>, PaintedSheet> all;
    const auto known = all.find({sheet.number, isLetter});
    if (known != all.end()) return known->second;
    const glm::dvec2 paper = isLetter ? drawings::kLetter : drawings::kA4;
    return all.emplace(std::pair{sheet.number, isLetter}, printed(sheet, paper)).first->second;
}

// The mean of what is drawn on a texel, linear.
glm::dvec3 drawnOn(const PaintedSheet& paper, const Sheet& sheet, glm::ivec2 texel) {
    constexpr int kSamples = 3;
    glm::dvec3 sum{};
    for (int y = 0; y < kSamples; ++y)
        for (int x = 0; x < kSamples; ++x)
            sum += glm::dvec3(paper.at(sheet.place.sheetAt(
                       glm::dvec2(texel) + (glm::dvec2{x, y} + 0.5) / double{kSamples}))) /
                   double{kSamples * kSamples};
    return sum;
}

// Every eighth texel each way within the outline.
double colourDifference(const PaintedSheet& paper, const Sheet& sheet, const Drawing& drawing) {
    constexpr int kStep = 8;
    double sum = 0;
    int count = 0;
    for (int y = 0; y < body::kSideTexels.y; y += kStep)
        for (int x = 0; x < body::kSideTexels.x; x += kStep) {
            const std::size_t at = 4 * static_cast<std::size_t>(y * body::kSideTexels.x + x);
            if (drawing.skin.codes[at + 3] < 255) continue;
            glm::dvec3 read{};
            for (int c = 0; c < 3; ++c)
                read[c] =
                    linearFromSrgb(drawing.skin.codes[at + static_cast<std::size_t>(c)] / 255.0);
            sum += ciede2000(labOf(drawnOn(paper, sheet, {x, y})), labOf(read));
            ++count;
        }
    return sum / count;
}

double outlineShare(const Sheet& sheet, const Drawing& drawing, const Camera& camera) {
    const glm::dmat3 sheetFromPhoto = glm::inverse(drawing.flat.photoFromSheet);
    double worst = 0, least = 1e9, most = -1e9;
    for (const drawings::Polyline& line : sheet.likeness.outline)
        for (const glm::vec2 texel : line) {
            const glm::dvec2 is = sheet.place.sheetAt(texel);
            const glm::dvec3 seen = sheetFromPhoto * glm::dvec3{camera.photoAt(is), 1};
            worst = std::max(worst, glm::distance(is, glm::dvec2{seen} / seen.z));
            least = std::min(least, is.x);
            most = std::max(most, is.x);
        }
    return worst / (most - least);
}

void keep(const std::string& name, std::span<const std::byte> file) {
    if (const char* folder = std::getenv("AQUARAMA_SHOTS"))
        writeWhole(std::filesystem::path(folder) / name, file);
}

}  // namespace

Judged judge(drawings::Catalogue& catalogue,
             const std::vector<std::string>& species,
             std::uint32_t seed,
             double mostMegapixels) {
    const Sheet& sheet = catalogue.sheetOf(species[seed % species.size()]);
    const bool isLetter = seed / species.size() % 2 == 1;
    const PaintedSheet paper = painted(sheet, blank(sheet, isLetter), seed);
    const Circumstances how = circumstancesOf(seed, mostMegapixels);
    const Camera camera(how, isLetter ? drawings::kLetter : drawings::kA4);
    std::vector<std::byte> file = jpegOf(photographed(paper, how, camera), how.jpegQuality);
    const std::string name = fmt::format("{:03}-{}", seed, sheet.species);
    keep(name + ".jpg", file);
    Judged judged{.species = sheet.species, .refused = {}};
    const double start = processorSeconds();
    try {
        const Drawing drawing = readDrawing(drawings::decodePhoto(file),
                                            [&](int number) { return catalogue.sheetOf(number); });
        judged.seconds = processorSeconds() - start;
        judged.skin = encodePng(drawing.skin, PngMeaning::Srgb);
        keep(name + ".png", judged.skin);
        judged.colourDifference = colourDifference(paper, sheet, drawing);
        judged.outlineShare = outlineShare(sheet, drawing, camera);
    } catch (const drawings::Refusal& refusal) {
        judged.refused = refusal.reason();
        judged.seconds = processorSeconds() - start;
    }
    std::cout << fmt::format(
        "{}: {:4.1f} MP, skew {:2.0f}, {:4.0f} K{}{}{}: {}, colours {:.1f}, outline {:.2f} %, "
        "{:.2f} s\n",
        name,
        how.sizePixels.x * how.sizePixels.y / 1e6,
        how.tiltDegrees,
        how.kelvin,
        how.shadow > 0 ? fmt::format(", shadow {:.2f}", how.shadow) : "",
        how.creaseHeight > 0 ? fmt::format(", crease {:.1f} mm", how.creaseHeight) : "",
        how.thumb ? ", thumb" : "",
        judged.refused ? drawings::lineOf(*judged.refused) : "found",
        judged.colourDifference,
        100 * judged.outlineShare,
        judged.seconds);
    judged.photo = std::move(file);
    return judged;
}

Judgement judgeAll(drawings::Catalogue& catalogue,
                   const std::vector<std::string>& species,
                   int count,
                   double mostMegapixels,
                   const std::function<void(const Judged&)>& also) {
    Judgement all;
    for (int i = 0; i < count; ++i) {
        const Judged one = judge(catalogue, species, static_cast<std::uint32_t>(i), mostMegapixels);
        also(one);
        if (one.refused) continue;
        ++all.found;
        all.colourDifference += one.colourDifference;
        all.worstColourDifference = std::max(all.worstColourDifference, one.colourDifference);
        all.worstOutlineShare = std::max(all.worstOutlineShare, one.outlineShare);
    }
    all.colourDifference /= std::max(1, all.found);
    std::cout << fmt::format(
        "{} of {} found; colours {:.2f}, at worst {:.2f}; outline within {:.2f} % of its length\n",
        all.found,
        count,
        all.colourDifference,
        all.worstColourDifference,
        100 * all.worstOutlineShare);
    return all;
}

}  // namespace aquarama::test
