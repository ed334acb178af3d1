// SPDX-License-Identifier: Apache-2.0
#include "drawings/likeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/body/spine.h"
#include "common/skin/limit_table.h"

namespace aquarama::drawings {

namespace {

using Parts = std::map<body::CagePart, Raster>;

constexpr std::array kPairedFins{body::CagePart::Pelvic, body::CagePart::Pectoral};

// In texels of the skin, from a place (s, y) of the rest shape.
glm::vec2 texelOf(const body::SideView& view, glm::vec2 place) {
    return view.texelAt({-place.x, place.y});
}

// What each part covers as seen from the right: of what comes in pairs, the right one.
Parts partsOf(const body::FishBody& body, const body::SideView& view) {
    const skin::LimitTable table = skin::makeLimitTable(body, skin::kSurfaceLevels - 1);
    Parts parts;
    for (std::size_t t = 0; t < table.indices.size(); t += 3) {
        std::array<glm::vec2, 3> corners{};
        float right = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec4 rest = table.vertices[table.indices[t + k]].rest;
            corners.at(k) = texelOf(view, rest) * static_cast<float>(kPixelsPerTexel);
            right += rest.z;
        }
        const auto part = static_cast<body::CagePart>(table.vertices[table.indices[t + 2]].part);
        const bool isPaired = std::ranges::find(kPairedFins, part) != kPairedFins.end();
        if (isPaired && right < 0) continue;
        parts.try_emplace(part, kPixelsPerTexel * body::kSideTexels).first->second.add(corners);
    }
    return parts;
}

Polyline inTexels(Polyline line) {
    for (glm::vec2& at : line) at /= static_cast<float>(kPixelsPerTexel);
    return line;
}

constexpr std::size_t kLeastContour = 120;  // pixels around
constexpr int kInner = 5;                   // pixels from the outline that a line keeps

// Parts of a line in pixels as open lines in texels: where `isShown` holds, and long enough to mean
// something. Short gaps are closed.
template <class IsShown>
void addShown(const Polyline& line, const IsShown& isShown, std::vector<Polyline>& lines) {
    constexpr std::size_t kLeast = 8;
    constexpr float kBetweenRuns = 24;  // pixels
    std::vector<Polyline> runs;
    bool isOpen = false;
    for (const glm::vec2 at : line) {
        const bool goesOn =
            isOpen || (!runs.empty() && glm::distance(runs.back().back(), at) < kBetweenRuns);
        isOpen = isShown(at);
        if (isOpen && !goesOn) runs.emplace_back();
        if (isOpen) runs.back().push_back(at);
    }
    for (Polyline& run : runs)
        if (run.size() >= kLeast) lines.push_back(inTexels(std::move(run)));
}

template <class IsShown>
void addShownContours(const Raster& part, const IsShown& isShown, std::vector<Polyline>& lines) {
    for (Polyline line : contoursOf(part, kLeastContour)) {
        line.push_back(line.front());
        addShown(line, isShown, lines);
    }
}

// Whether a paired fin hides a pixel of the flank.
bool isHidden(const Parts& parts, glm::vec2 at) {
    return std::ranges::any_of(kPairedFins, [&](body::CagePart part) {
        const auto found = parts.find(part);
        return found != parts.end() &&
               found->second.at(static_cast<int>(at.x), static_cast<int>(at.y));
    });
}

// Where fins meet the body, and paired fins upon it.
void addSeams(const Parts& parts, Likeness& likeness) {
    const auto isInner = [&](glm::vec2 at) { return likeness.shape.isWithin(at, kInner); };
    addShownContours(
        parts.at(body::CagePart::Body),
        [&](glm::vec2 at) { return isInner(at) && !isHidden(parts, at); },
        likeness.lines);
    for (const body::CagePart part : kPairedFins)
        if (const auto found = parts.find(part); found != parts.end())
            addShownContours(found->second, isInner, likeness.lines);
}

// A share of the way along a line, whose points count equally.
glm::vec2 along(const std::vector<glm::vec2>& line, float share) {
    const float at = share * static_cast<float>(line.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(at), line.size() - 2);
    return glm::mix(line[low], line[low + 1], at - static_cast<float>(low));
}

// The middle halves of a few rays of the fins along back and belly and of the tail.
void addRays(const config::Fins& fins, Likeness& likeness) {
    const auto add = [&](const config::Fin& fin, int count) {
        for (int i = 1; i <= count; ++i) {
            const float share = static_cast<float>(i) / static_cast<float>(count + 1);
            const glm::vec2 base = along(fin.base, share), edge = along(fin.edge, share);
            likeness.lines.push_back({texelOf(likeness.view, glm::mix(base, edge, 0.25F)),
                                      texelOf(likeness.view, glm::mix(base, edge, 0.75F))});
        }
    };
    add(fins.caudal, 5);
    add(fins.anal, 4);
    add(fins.firstDorsal, fins.secondDorsal ? 4 : 8);
    if (fins.secondDorsal) add(*fins.secondDorsal, 4);
}

// The gape, and the hind edge of the gill cover: a bow between three quarters of the back and of
// the belly.
void addFace(const body::FishBody& body, const Parts& parts, Likeness& likeness) {
    const body::FishFace& face = body.face;
    likeness.lines.push_back(
        {texelOf(likeness.view, face.front), texelOf(likeness.view, face.corner)});
    Polyline gill;
    constexpr int kSteps = 24;
    constexpr float kReach = 0.72F;
    for (int i = 0; i <= kSteps; ++i) {
        const float v = kReach * (2 * static_cast<float>(i) / kSteps - 1);
        const float s = face.gill.x - face.gill.y * v * v;
        const float up = body::interpolate(body.profileStations, body.profileDorsal, s);
        const float down = body::interpolate(body.profileStations, body.profileVentral, s);
        gill.push_back(texelOf(likeness.view, {s, v * (v > 0 ? up : down)}) *
                       static_cast<float>(kPixelsPerTexel));
    }
    addShown(
        gill, [&](glm::vec2 at) { return !isHidden(parts, at); }, likeness.lines);
    likeness.eye = texelOf(likeness.view, face.eye);
    likeness.eyeRadius = glm::distance(
        likeness.eye, texelOf(likeness.view, glm::vec2{face.eye} + glm::vec2{face.eye.z, 0}));
}

}  // namespace

Likeness likenessOf(const config::Species& species) {
    const body::FishBody body = body::makeBody(species);
    Likeness likeness{.view = body::sideViewOf(body), .outline = {}, .lines = {}};
    const Parts parts = partsOf(body, likeness.view);
    for (const auto& [part, raster] : parts) likeness.shape.add(raster);
    for (Polyline& line : contoursOf(likeness.shape, kLeastContour))
        likeness.outline.push_back(inTexels(std::move(line)));
    addSeams(parts, likeness);
    addRays(species.fins, likeness);
    addFace(body, parts, likeness);
    return likeness;
}

float coverage(const Likeness& likeness, glm::ivec2 texel) {
    int covered = 0;
    for (int y = 0; y < kPixelsPerTexel; ++y)
        for (int x = 0; x < kPixelsPerTexel; ++x)
            covered +=
                likeness.shape.at(kPixelsPerTexel * texel.x + x, kPixelsPerTexel * texel.y + y) ? 1
                                                                                                : 0;
    return static_cast<float>(covered) / (kPixelsPerTexel * kPixelsPerTexel);
}

}  // namespace aquarama::drawings
