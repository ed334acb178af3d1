// SPDX-License-Identifier: Apache-2.0
#include "tests/support/portrait.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat3x4.hpp>

#include "capture/film/triangle.h"
#include "common/base/log.h"

namespace aquarama::test {

namespace {

constexpr int kLevel = 2;

glm::vec3 paintOf(const config::Species& species, const std::string& part) {
    const auto found = std::ranges::find(species.palette, part, &config::Paint::part);
    if (found == species.palette.end())
        throw Error(species.name + ": the palette lacks \"" + part + "\": add it");
    return found->linear;
}

glm::vec2 onPaper(const View& view, glm::vec3 p) {
    return {glm::dot(p, view.right), -glm::dot(p, view.up)};
}

// Wrapped daylight from above the head, and the water's own from everywhere.
float lightOn(glm::vec3 normal) {
    const glm::vec3 sun = glm::normalize(glm::vec3(0.28F, 0.80F, 0.53F));
    return 0.75F * std::max(0.0F, 0.72F * glm::dot(normal, sun) + 0.28F) + 0.25F + 0.12F * normal.y;
}

}  // namespace

Portrait::Portrait(const config::Species& species,
                   const body::FishBody& body,
                   const body::NodalPoints& nodes)
    : palette_{.back = paintOf(species, "back"),
               .flank = paintOf(species, "flank"),
               .belly = paintOf(species, "belly"),
               .fin = paintOf(species, "fin"),
               .tail = paintOf(species, "tail"),
               .iris = paintOf(species, "iris")},
      eye_(body.face.eye),
      table_(skin::makeLimitTable(body, kLevel)) {
    std::vector<glm::vec3> controlPoints(body::kControlPoints);
    body::poseCage(body, nodes, controlPoints);
    for (std::size_t i = 0; i < table_.vertices.size(); ++i) {
        glm::vec3 position{}, u{}, v{};
        for (std::uint32_t k = table_.firstEntry[i]; k < table_.firstEntry[i + 1]; ++k) {
            const skin::StencilEntry& entry = table_.entries[k];
            position += entry.position * controlPoints[entry.controlPoint];
            u += entry.tangentU * controlPoints[entry.controlPoint];
            v += entry.tangentV * controlPoints[entry.controlPoint];
        }
        vertices_.push_back({position, glm::normalize(glm::cross(u, v))});
    }
}

Portrait::Extent Portrait::extent(const View& view) const {
    Extent extent{glm::vec2(1e9F), glm::vec2(-1e9F)};
    for (const Vertex& vertex : vertices_) {
        extent.least = glm::min(extent.least, onPaper(view, vertex.position));
        extent.most = glm::max(extent.most, onPaper(view, vertex.position));
    }
    return extent;
}

glm::vec3 Portrait::colourOf(std::uint32_t part, const skin::SkinPlace& place) const {
    if (part == static_cast<std::uint32_t>(body::CagePart::Caudal)) return palette_.tail;
    if (part != static_cast<std::uint32_t>(body::CagePart::Body) &&
        part != static_cast<std::uint32_t>(body::CagePart::Eye))
        return palette_.fin;
    const float fromEye = glm::distance(glm::vec2(place.rest), glm::vec2(eye_)) / eye_.z;
    if (fromEye < 0.5F) return glm::vec3(0.004F);
    if (fromEye < 1) return palette_.iris;
    const float v = place.rest.w;
    const glm::vec3 side =
        glm::mix(palette_.belly, palette_.flank, glm::smoothstep(-0.7F, -0.2F, v));
    return glm::mix(side, palette_.back, glm::smoothstep(0.2F, 0.75F, v));
}

void Portrait::draw(Light& paper,
                    const View& view,
                    glm::vec2 originPixels,
                    float pixelsPerBodyLength) const {
    std::vector<float> nearest(paper.rgb.size(), -1e9F);
    for (std::size_t t = 0; t < table_.indices.size(); t += 3) {
        std::array<glm::vec2, 3> corners{};
        glm::mat3 positions, normals;
        glm::mat3x4 rest;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t i = table_.indices[t + k];
            corners.at(k) =
                originPixels + pixelsPerBodyLength * onPaper(view, vertices_[i].position);
            positions[static_cast<int>(k)] = vertices_[i].position;
            normals[static_cast<int>(k)] = vertices_[i].normal;
            rest[static_cast<int>(k)] = table_.vertices[i].rest;
        }
        const std::uint32_t part = table_.vertices[table_.indices[t + 2]].part;
        film::fillTriangle(corners, paper.sizePixels, [&](int x, int y, glm::vec3 weights) {
            const auto pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(paper.sizePixels.x) +
                static_cast<std::size_t>(x);
            const float depth = glm::dot(positions * weights, view.towards);
            if (depth <= nearest[pixel]) return;
            nearest[pixel] = depth;
            const skin::SkinPlace place{.rest = rest * weights};
            glm::vec3 normal = glm::normalize(normals * weights);
            if (glm::dot(normal, view.towards) < 0) normal = -normal;
            paper.at(x, y) = colourOf(part, place) * lightOn(normal);
        });
    }
}

}  // namespace aquarama::test
