// SPDX-License-Identifier: Apache-2.0
// Control points: they move a channel's picture by hand, on top of its other geometry.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <Eigen/LU>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "common/base/log.h"
#include "common/wall/optics.h"

namespace aquarama::wall {

namespace {

// A control point and its hill; pixels of the panorama.
struct Anchor {
    glm::dvec2 place{}, wanted{};
    double radius = 0;
    config::SourcePlace source = {};
    glm::dvec2 weight{};  // of the hill, such that the hills of all points sum to what each wants
};

// Wendland's function of second order: 1 in the middle; 0, with its first two derivatives, at the
// radius and beyond. A system of such hills about different places has a solution while their radii
// are alike.
double hill(double share) {
    return share < 1 ? std::pow(1 - share, 4) * (4 * share + 1) : 0;
}
// The slope of hill(), divided by the share.
double hillSlope(double share) {
    return share < 1 ? -20 * std::pow(1 - share, 3) : 0;
}

double hillOf(const Anchor& anchor, glm::dvec2 place) {
    return hill(glm::distance(place, anchor.place) / anchor.radius);
}

// Solves for the weights with which the hills of all anchors together move each place as wanted.
// False where the system is singular.
bool solveWeights(std::vector<Anchor>& anchors) {
    constexpr double kLeastPivot = 1e-6;  // hills are 1 high
    const auto count = static_cast<Eigen::Index>(anchors.size());
    Eigen::MatrixXd hills(count, count);
    Eigen::MatrixX2d wanted(count, 2);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Anchor& at = anchors[static_cast<std::size_t>(i)];
        for (Eigen::Index j = 0; j < count; ++j)
            hills(i, j) = hillOf(anchors[static_cast<std::size_t>(j)], at.place);
        wanted.row(i) << at.wanted.x, at.wanted.y;
    }
    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(hills);
    if (factors.matrixLU().diagonal().cwiseAbs().minCoeff() < kLeastPivot) return false;
    const Eigen::MatrixX2d weights = factors.solve(wanted);
    for (Eigen::Index i = 0; i < count; ++i)
        anchors[static_cast<std::size_t>(i)].weight = {weights(i, 0), weights(i, 1)};
    return true;
}

// A smooth movement of the panorama, in its pixels, that does not fold it: the wanted one at each
// point, none beyond all radii.
class SmoothMove {
  public:
    // Throws Error where there is no such movement. `source`: the file of the points.
    SmoothMove(std::vector<Anchor> anchors, const std::string& source)
        : anchors_(std::move(anchors)) {
        if (!solveWeights(anchors_))
            refuse(
                source, anchors_.back(), "two points of one channel lie at one place: remove one");
        for (const Anchor& anchor : anchors_) checkFold(anchor, source);
    }

    [[nodiscard]] bool moves(glm::dvec2 place) const {
        return std::ranges::any_of(anchors_, [&](const Anchor& anchor) {
            return glm::distance(place, anchor.place) < anchor.radius;
        });
    }
    // The place to which a place moves.
    [[nodiscard]] glm::dvec2 moved(glm::dvec2 place) const {
        glm::dvec2 to = place;
        for (const Anchor& anchor : anchors_) to += anchor.weight * hillOf(anchor, place);
        return to;
    }
    // The inverse, by Newton's method.
    [[nodiscard]] glm::dvec2 before(glm::dvec2 place) const {
        constexpr int kMostSteps = 60;
        constexpr double kGoodPixels = 1e-9;
        glm::dvec2 from = place;
        glm::dvec2 off = moved(from) - place;
        for (int i = 0; i < kMostSteps && glm::length(off) > kGoodPixels; ++i) {
            glm::dvec2 step = glm::inverse(slopeAt(from)) * off;
            // Halves the step until it comes nearer.
            for (int half = 0; half < 20; ++half, step /= 2.0)
                if (glm::length(moved(from - step) - place) < glm::length(off)) break;
            from -= step;
            off = moved(from) - place;
        }
        return from;
    }

  private:
    [[noreturn]] static void refuse(const std::string& source,
                                    const Anchor& anchor,
                                    const std::string& why) {
        throw Error(config::placed(source, anchor.source, why));
    }
    [[nodiscard]] glm::dmat2 slopeAt(glm::dvec2 place) const {
        glm::dmat2 slope(1.0);
        for (const Anchor& anchor : anchors_) {
            const glm::dvec2 off = (place - anchor.place) / anchor.radius;
            slope +=
                glm::outerProduct(anchor.weight, hillSlope(glm::length(off)) * off / anchor.radius);
        }
        return slope;
    }
    // Tests places all over a point's circle: at each, a share of the picture's area must be left.
    void checkFold(const Anchor& anchor, const std::string& source) const {
        constexpr int kSteps = 16;  // from the middle to the radius
        constexpr double kLeastArea = 0.2;
        for (int y = -kSteps; y <= kSteps; ++y)
            for (int x = -kSteps; x <= kSteps; ++x) {
                const glm::dvec2 place =
                    anchor.place + anchor.radius * glm::dvec2(x, y) / double{kSteps};
                if (glm::determinant(slopeAt(place)) >= kLeastArea) continue;
                refuse(source,
                       anchor,
                       fmt::format("this point folds the picture{}: move it less, or give it a "
                                   "larger radius_px",
                                   othersNear(anchor, place)));
            }
    }
    // As in " together with those at line 3, 7".
    [[nodiscard]] std::string othersNear(const Anchor& anchor, glm::dvec2 place) const {
        std::string lines;
        for (const Anchor& other : anchors_)
            if (&other != &anchor && hillOf(other, place) > 0)
                lines += fmt::format("{}{}", lines.empty() ? "" : ", ", other.source.line);
        return lines.empty() ? "" : " together with the points at line " + lines;
    }

    std::vector<Anchor> anchors_;
};

class AdjustedOptics final : public Optics {
  public:
    AdjustedOptics(std::unique_ptr<const Optics> optics,
                   SmoothMove move,
                   const ScreenSurface& screen,
                   glm::dvec2 panoramaPixels)
        : optics_(std::move(optics)),
          move_(std::move(move)),
          screen_(screen),
          panorama_(panoramaPixels) {}

    [[nodiscard]] std::optional<glm::dvec3> pointOf(glm::dvec2 pixel, double spill) const override {
        const auto point = optics_->pointOf(pixel, spill);
        return point ? std::optional(shownAt(*point)) : std::nullopt;
    }
    [[nodiscard]] std::optional<glm::dvec2> pixelOf(glm::dvec3 point) const override {
        const glm::dvec2 place = screen_.unrolled(point) * panorama_;
        if (!move_.moves(place)) return optics_->pixelOf(point);
        const auto there = screen_.at(move_.moved(place) / panorama_);
        return there ? optics_->pixelOf(*there) : std::nullopt;
    }
    [[nodiscard]] std::vector<glm::dvec3> outline(double spill) const override {
        std::vector<glm::dvec3> outline = optics_->outline(spill);
        for (glm::dvec3& point : outline) point = shownAt(point);
        return outline;
    }
    [[nodiscard]] const std::vector<glm::vec3>& blend() const override { return optics_->blend(); }
    [[nodiscard]] const std::vector<glm::vec3>& black() const override { return optics_->black(); }
    [[nodiscard]] const formats::ChannelColour* colour() const override {
        return optics_->colour();
    }

  private:
    // The point that is shown at a point of the screen: the one that was moved there. Beyond the
    // screen's edge, the edge is continued.
    [[nodiscard]] glm::dvec3 shownAt(glm::dvec3 point) const {
        const glm::dvec2 place = screen_.unrolled(point) * panorama_;
        if (!move_.moves(place)) return point;
        const glm::dvec2 from = move_.before(place);
        if (const auto shown = screen_.at(from / panorama_)) return *shown;
        const auto within = [&](glm::dvec2 at) {
            return screen_.at(glm::clamp(at / panorama_, 0.0, 1.0));
        };
        const auto to = within(from), here = within(place);
        return to && here ? point + (*to - *here) : point;
    }

    std::unique_ptr<const Optics> optics_;
    SmoothMove move_;
    const ScreenSurface& screen_;
    glm::dvec2 panorama_;
};

}  // namespace

std::unique_ptr<const Optics> adjusted(std::unique_ptr<const Optics> optics,
                                       const config::Rig& rig,
                                       std::size_t channel,
                                       const ScreenSurface& screen,
                                       const config::Adjustments& adjustments) {
    const glm::dvec2 panorama(rig.panoramaPixels);
    std::vector<Anchor> anchors;
    for (const config::ControlPoint& point : adjustments.points) {
        if (point.channel != channel) continue;
        Anchor anchor{.place = point.place,
                      .wanted = point.byPixels,
                      .radius = point.radiusPixels,
                      .source = point.source};
        if (point.pixelsOf == config::PixelsOf::Picture) {
            const auto lit = optics->pointOf(point.place, 0);
            if (!lit)
                throw Error(config::placed(rig.adjustments,
                                           point.source,
                                           "this pixel of channel \"" + rig.channels[channel].name +
                                               "\" lights no screen: give one that does"));
            anchor.place = screen.unrolled(*lit) * panorama;
        }
        anchors.push_back(anchor);
    }
    if (anchors.empty()) return optics;
    return std::make_unique<AdjustedOptics>(
        std::move(optics), SmoothMove(std::move(anchors), rig.adjustments), screen, panorama);
}

}  // namespace aquarama::wall
