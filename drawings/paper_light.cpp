// SPDX-License-Identifier: Apache-2.0
#include "drawings/paper_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "common/base/picture.h"
#include "drawings/refusal.h"

namespace aquarama::drawings {

namespace {

constexpr double kCell = 8;  // millimetres, of a piece of paper
constexpr double kStep = 1;  // from one sample of it to the next
constexpr double kGrid = 6;  // from one node of the field to the next
constexpr double kKeep = 4;  // from the outline, tags and text to bare paper
// Light of which colours cannot be told: of all, and of one of the three.
constexpr double kDark = 0.03;
constexpr float kDarkColour = 0.004F;

// A piece of paper: its middle, and the logarithm of its white.
struct PaperPiece {
    glm::dvec2 at{};
    glm::dvec3 white{};
};
using Pieces = std::vector<PaperPiece>;

// Low-order terms at a place, which is taken relative to half the field.
using Terms = Eigen::Matrix<double, 1, 6>;
Terms termsAt(glm::dvec2 sheet) {
    const glm::dvec2 p = sheet / (kFieldMillimetres / 2.0);
    Terms terms;
    terms << 1, p.x, p.y, p.x * p.x, p.x * p.y, p.y * p.y;
    return terms;
}
using Polynomial = Eigen::Matrix<double, 6, 3>;

glm::dvec3 valueOf(const Polynomial& polynomial, glm::dvec2 sheet) {
    const Eigen::Matrix<double, 1, 3> value = termsAt(sheet) * polynomial;
    return {value(0), value(1), value(2)};
}

// Whether nothing is printed near a place, and nobody should have painted.
bool isBare(const Sheet& sheet, glm::dvec2 at) {
    const glm::dvec2 inner = kFieldMillimetres / 2.0 - kTagMillimetres - kKeep;
    const bool isByTag = std::abs(at.x) > inner.x && std::abs(at.y) > inner.y;
    const bool isText = at.y < kLineOfText.y + 2 * kKeep && !isByTag;
    if (isByTag || isText) return false;
    const glm::vec2 pixel{static_cast<double>(kPixelsPerTexel) * sheet.place.texelAt(at)};
    const auto reach =
        static_cast<float>(kKeep * kPixelsPerTexel / sheet.place.millimetresPerTexel);
    constexpr int kWays = 12;
    for (int i = 0; i < kWays; ++i) {
        const float angle = static_cast<float>(i) * 6.2832F / kWays;
        const glm::ivec2 near(pixel + reach * glm::vec2{std::cos(angle), std::sin(angle)});
        if (sheet.likeness.shape.at(near.x, near.y)) return false;
    }
    return !sheet.likeness.shape.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
}

// The mean of the brighter half of some light.
glm::vec3 whiteOf(std::vector<glm::vec3>& light) {
    const auto half = light.begin() + static_cast<std::ptrdiff_t>(light.size() / 2);
    std::ranges::nth_element(
        light, half, std::greater{}, [](glm::vec3 rgb) { return luminance(glm::dvec3(rgb)); });
    glm::vec3 sum{};
    for (auto one = light.begin(); one != half; ++one) sum += *one;
    return sum / static_cast<float>(light.size() / 2);
}

// Of one cell where most of it is bare.
void addPiece(const PhotoLight& photo,
              const Flattening& flat,
              const Sheet& sheet,
              glm::dvec2 corner,
              Pieces& pieces) {
    std::vector<glm::vec3> light;
    for (double y = kStep / 2; y < kCell; y += kStep)
        for (double x = kStep / 2; x < kCell; x += kStep)
            if (const glm::dvec2 at = corner + glm::dvec2{x, y}; isBare(sheet, at))
                light.push_back(photo.at(flat.photoAt(at)));
    if (static_cast<double>(light.size()) < 0.5 * kCell * kCell / (kStep * kStep)) return;
    const glm::vec3 white = whiteOf(light);
    if (luminance(white) > kDark && std::min({white.r, white.g, white.b}) > kDarkColour)
        pieces.push_back({corner + kCell / 2, glm::log(glm::dvec3(white))});
}

Pieces piecesOf(const PhotoLight& photo, const Flattening& flat, const Sheet& sheet) {
    Pieces pieces;
    const glm::dvec2 half = kFieldMillimetres / 2.0;
    for (double y = -half.y; y + kCell <= half.y; y += kCell)
        for (double x = -half.x; x + kCell <= half.x; x += kCell)
            addPiece(photo, flat, sheet, {x, y}, pieces);
    return pieces;
}

Polynomial fit(const Pieces& pieces) {
    const auto rows = static_cast<Eigen::Index>(pieces.size());
    Eigen::MatrixXd terms(rows, 6), values(rows, 3);
    for (Eigen::Index row = 0; row < rows; ++row) {
        const PaperPiece& piece = pieces[static_cast<std::size_t>(row)];
        terms.row(row) = termsAt(piece.at);
        values.row(row) << piece.white.r, piece.white.g, piece.white.b;
    }
    return terms.colPivHouseholderQr().solve(values);
}

// Whether a piece is paper in the light of its neighbours: shadows change its brightness, paint,
// thumbs and tables its hue as well.
bool isPaper(const PaperPiece& piece, const Polynomial& around) {
    constexpr double kMostHue = 0.12, kMostShadow = 0.9;
    const glm::dvec3 off = piece.white - valueOf(around, piece.at);
    const double mean = (off.r + off.g + off.b) / 3;
    return std::abs(mean) < kMostShadow && glm::length(off - glm::dvec3(mean)) < kMostHue;
}

// Keeps the paper of all pieces, and fits it.
Polynomial fitPaper(Pieces& pieces) {
    constexpr std::size_t kLeastPieces = 24;
    constexpr int kRounds = 4;
    Polynomial around = Polynomial::Zero();
    for (int round = 0; round < kRounds; ++round) {
        if (pieces.size() < kLeastPieces) throw Refusal(RefusalReason::TooDark);
        around = fit(pieces);
        std::erase_if(pieces, [&](const PaperPiece& piece) { return !isPaper(piece, around); });
    }
    return around;
}

// What the pieces have beyond the polynomial, at a place: their mean, near ones counting most. The
// edges of shadows are there.
glm::dvec3 remainderAt(const Pieces& pieces, const Polynomial& around, glm::dvec2 at) {
    glm::dvec3 sum{};
    double weights = 0;
    for (const PaperPiece& piece : pieces) {
        const glm::dvec2 way = (piece.at - at) / kCell;
        const double near = 1 / (1 + glm::dot(way, way));
        const double weight = near * near;
        sum += weight * (piece.white - valueOf(around, piece.at));
        weights += weight;
    }
    return sum / weights;
}

}  // namespace

PaperLight::PaperLight(const PhotoLight& photo, const Flattening& flat, const Sheet& sheet)
    : size_(glm::ceil(kFieldMillimetres / kGrid) + 1.0) {
    Pieces pieces = piecesOf(photo, flat, sheet);
    const Polynomial around = fitPaper(pieces);
    for (int y = 0; y < size_.y; ++y)
        for (int x = 0; x < size_.x; ++x) {
            const glm::dvec2 at = kGrid * glm::dvec2{x, y} - kFieldMillimetres / 2.0;
            white_.emplace_back(glm::exp(valueOf(around, at) + remainderAt(pieces, around, at)));
        }
}

glm::vec3 PaperLight::at(glm::dvec2 sheet) const {
    const glm::dvec2 last(size_ - 1);
    const glm::dvec2 at =
        glm::clamp((sheet + kFieldMillimetres / 2.0) / kGrid, glm::dvec2(0), last);
    const glm::ivec2 low(at);
    const glm::ivec2 high = glm::min(low + 1, size_ - 1);
    const glm::vec2 t(at - glm::dvec2(low));
    const auto node = [&](int x, int y) {
        return white_[static_cast<std::size_t>(y * size_.x + x)];
    };
    return glm::mix(glm::mix(node(low.x, low.y), node(high.x, low.y), t.x),
                    glm::mix(node(low.x, high.y), node(high.x, high.y), t.x),
                    t.y);
}

}  // namespace aquarama::drawings
