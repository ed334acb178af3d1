// SPDX-License-Identifier: Apache-2.0
#include "drawings/sheet.h"

#include "drawings/page.h"
#include "drawings/tags.h"

namespace aquarama::drawings {

namespace {

// Light, so that crayons cover them: the outline, and what is within it.
constexpr Pen kOutline{.widthMillimetres = kOutlineMillimetres, .grey = 0.64, .isClosed = true};
constexpr Pen kInside{.widthMillimetres = 0.5, .grey = 0.74};
constexpr Pen kEye{.widthMillimetres = 0.7, .grey = 0.64, .isClosed = true};

void drawTag(Page& page, const TagCode& code) {
    const TagPattern pattern = tagPattern(idOf(code));
    const double module = kTagMillimetres / kTagModules;
    // Wider by a hair than a module, so that no seam shows between two.
    constexpr double kOverlap = 0.02;
    const glm::dvec2 corner = tagOn(code.corner).front();
    for (int y = 0; y < kTagModules; ++y)
        for (int x = 0; x < kTagModules; ++x)
            if (pattern.at(static_cast<std::size_t>(y)).at(static_cast<std::size_t>(x)))
                page.square(corner + module * glm::dvec2{x, -y}, module + kOverlap);
}

std::vector<glm::dvec2> onSheet(const SkinOnSheet& place, const Polyline& line) {
    std::vector<glm::dvec2> points;
    for (const glm::vec2 at : line) points.push_back(place.sheetAt(at));
    return points;
}

void drawLikeness(Page& page, const Sheet& sheet) {
    for (const Polyline& line : sheet.likeness.lines)
        page.line(onSheet(sheet.place, line), kInside);
    for (const Polyline& line : sheet.likeness.outline)
        page.line(onSheet(sheet.place, line), kOutline);
    const glm::dvec2 eye = sheet.place.sheetAt(sheet.likeness.eye);
    const double radius =
        sheet.place.millimetresPerTexel * static_cast<double>(sheet.likeness.eyeRadius);
    page.circle(eye, radius, kEye);
    page.circle(eye, radius / 2, kEye);
}

}  // namespace

Sheet makeSheet(const config::Species& species, int number) {
    Sheet sheet{species.name, number, likenessOf(species), {}};
    sheet.place = placeOf(sheet.likeness);
    return sheet;
}

std::vector<std::byte> pdfOf(const Sheet& sheet,
                             glm::dvec2 paperMillimetres,
                             const std::string& line) {
    constexpr double kTextHeight = 5;
    Page page(paperMillimetres);
    drawLikeness(page, sheet);
    for (const auto corner :
         {Corner::UpperLeft, Corner::UpperRight, Corner::LowerRight, Corner::LowerLeft})
        drawTag(page, {.species = sheet.number, .corner = corner});
    page.text(kLineOfText, kTextHeight, kFieldMillimetres.x - 2.4 * kTagMillimetres, line);
    return page.finish();
}

}  // namespace aquarama::drawings
