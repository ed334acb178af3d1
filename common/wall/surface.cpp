// SPDX-License-Identifier: Apache-2.0
#include "common/wall/surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace aquarama::wall {

namespace {

// One point for each pixel or two of a projector.
constexpr int kStepsPerSide = 2048;

// Calls visit for points along the border of the unit square, corners included.
template <class Visit>
void walkUnitSquare(Visit visit) {
    for (int i = 0; i <= kStepsPerSide; ++i) {
        const double t = static_cast<double>(i) / kStepsPerSide;
        visit(glm::dvec2(t, 0));
        visit(glm::dvec2(t, 1));
        visit(glm::dvec2(0, t));
        visit(glm::dvec2(1, t));
    }
}

bool isWithinUnit(glm::dvec2 place) {
    return place.x >= 0 && place.y >= 0 && place.x <= 1 && place.y <= 1;
}

// A surface that unrolls to a rectangle.
class UnrolledSurface : public ScreenSurface {
  public:
    [[nodiscard]] std::optional<glm::dvec3> at(glm::dvec2 position) const override {
        return isWithinUnit(position) ? std::optional(pointAt(position, 0)) : std::nullopt;
    }
    [[nodiscard]] std::vector<glm::dvec3> border(double spill) const override {
        std::vector<glm::dvec3> points;
        walkUnitSquare([&](glm::dvec2 t) { points.push_back(pointAt(t, spill)); });
        return points;
    }

  protected:
    // The point at a place of the panorama, of the screen enlarged by `spill` metres at each edge.
    [[nodiscard]] virtual glm::dvec3 pointAt(glm::dvec2 position, double spill) const = 0;
};

// A piece of a cylinder about the y axis, its middle at (0, 0, -radius).
class Cylinder final : public UnrolledSurface {
  public:
    explicit Cylinder(const config::Screen& screen)
        : radius_{screen.radiusMetres}, arc_{screen.arcRadians}, height_{screen.heightMetres} {}

    [[nodiscard]] std::optional<glm::dvec3> hit(const Ray& ray, double spill) const override {
        // Where the ray o + t d crosses the cylinder x^2 + z^2 = r^2: a t^2 + 2 b t + c = 0.
        const glm::dvec3& o = ray.origin;
        const glm::dvec3& d = ray.direction;
        const double a = d.x * d.x + d.z * d.z;
        const double b = o.x * d.x + o.z * d.z;
        const double c = o.x * o.x + o.z * o.z - radius_ * radius_;
        const double root = b * b - a * c;
        if (a <= 0 || root < 0) return std::nullopt;
        // Of the two crossings the far one is on the inside of the screen, where the light leaves
        // the cylinder.
        const double along = (std::sqrt(root) - b) / a;
        if (along <= 0) return std::nullopt;
        const glm::dvec3 point = o + along * d;
        const bool isOn = std::abs(azimuthOf(point)) <= arc_ / 2 + spill / radius_ &&
                          std::abs(point.y) <= height_ / 2 + spill;
        return isOn ? std::optional(point) : std::nullopt;
    }
    [[nodiscard]] glm::dvec3 normalAt(glm::dvec3 point) const override {
        return {-point.x, 0, -point.z};
    }
    [[nodiscard]] glm::dvec2 unrolled(glm::dvec3 point) const override {
        return {0.5 + azimuthOf(point) / arc_, 0.5 - point.y / height_};
    }
    [[nodiscard]] PatternGround patternGround() const override {
        return {.kind = PatternGround::Kind::Cylinder, .size = radius_};
    }

  private:
    [[nodiscard]] glm::dvec3 pointAt(glm::dvec2 position, double spill) const override {
        const double azimuth = (position.x - 0.5) * (arc_ + 2 * spill / radius_);
        return {radius_ * std::sin(azimuth),
                (0.5 - position.y) * (height_ + 2 * spill),
                -radius_ * std::cos(azimuth)};
    }
    double radius_, arc_, height_;
};

// A rectangle across the z axis, its middle at (0, 0, -distance).
class FlatWall final : public UnrolledSurface {
  public:
    explicit FlatWall(const config::Screen& screen)
        : size_{screen.widthMetres, screen.heightMetres}, distance_{screen.distanceMetres} {}

    [[nodiscard]] std::optional<glm::dvec3> hit(const Ray& ray, double spill) const override {
        if (ray.direction.z >= 0 || ray.origin.z <= -distance_) return std::nullopt;
        const double along = (-distance_ - ray.origin.z) / ray.direction.z;
        glm::dvec3 point = ray.origin + along * ray.direction;
        point.z = -distance_;
        const bool isOn =
            std::abs(point.x) <= size_.x / 2 + spill && std::abs(point.y) <= size_.y / 2 + spill;
        return isOn ? std::optional(point) : std::nullopt;
    }
    [[nodiscard]] glm::dvec3 normalAt(glm::dvec3) const override { return {0, 0, 1}; }
    [[nodiscard]] glm::dvec2 unrolled(glm::dvec3 point) const override {
        return {0.5 + point.x / size_.x, 0.5 - point.y / size_.y};
    }
    [[nodiscard]] PatternGround patternGround() const override {
        return {.kind = PatternGround::Kind::Plane, .size = distance_};
    }

  private:
    [[nodiscard]] glm::dvec3 pointAt(glm::dvec2 position, double spill) const override {
        const glm::dvec2 size = size_ + 2 * spill;
        return {(position.x - 0.5) * size.x, (0.5 - position.y) * size.y, -distance_};
    }
    glm::dvec2 size_;
    double distance_;
};

// The part of a sphere round the y axis. Unrolled to a fisheye: the distance from the middle grows
// with the angle from the axis; what is in front (-z) is at the bottom, +x at the right.
class Dome final : public ScreenSurface {
  public:
    explicit Dome(const config::Screen& screen)
        : radius_{screen.radiusMetres}, halfOpening_{screen.arcRadians / 2} {}

    [[nodiscard]] std::optional<glm::dvec3> hit(const Ray& ray, double spill) const override {
        const glm::dvec3 d = glm::normalize(ray.direction);
        const double b = glm::dot(ray.origin, d);
        const double c = glm::dot(ray.origin, ray.origin) - radius_ * radius_;
        const double root = b * b - c;
        if (root < 0) return std::nullopt;
        const double along = std::sqrt(root) - b;  // the far crossing, on the inside
        if (along <= 0) return std::nullopt;
        const glm::dvec3 point = ray.origin + along * d;
        const bool isOn = angleOf(point) <= halfOpening_ + spill / radius_;
        return isOn ? std::optional(point) : std::nullopt;
    }
    [[nodiscard]] glm::dvec3 normalAt(glm::dvec3 point) const override { return -point; }
    [[nodiscard]] glm::dvec2 unrolled(glm::dvec3 point) const override {
        const glm::dvec2 side(point.x, -point.z);
        const double length = glm::length(side);
        if (length == 0) return glm::dvec2(0.5);
        return 0.5 + 0.5 * angleOf(point) / halfOpening_ / length * side;
    }
    [[nodiscard]] std::optional<glm::dvec3> at(glm::dvec2 position) const override {
        const glm::dvec2 side = 2.0 * position - 1.0;
        const double share = glm::length(side);
        if (share > 1) return std::nullopt;
        const glm::dvec2 way = share > 0 ? side / share : glm::dvec2(1, 0);
        return pointAt(share * halfOpening_, way);
    }
    [[nodiscard]] std::vector<glm::dvec3> border(double spill) const override {
        std::vector<glm::dvec3> points;
        for (int i = 0; i < 4 * kStepsPerSide; ++i) {
            const double turn = 2 * std::numbers::pi * i / (4 * kStepsPerSide);
            points.push_back(
                pointAt(halfOpening_ + spill / radius_, {std::cos(turn), std::sin(turn)}));
        }
        return points;
    }
    [[nodiscard]] PatternGround patternGround() const override {
        return {.kind = PatternGround::Kind::Sphere, .size = radius_};
    }

  private:
    [[nodiscard]] static double angleOf(glm::dvec3 point) {
        return std::atan2(std::hypot(point.x, point.z), point.y);
    }
    [[nodiscard]] glm::dvec3 pointAt(double angle, glm::dvec2 way) const {
        return radius_ *
               glm::dvec3(std::sin(angle) * way.x, std::cos(angle), -std::sin(angle) * way.y);
    }
    double radius_, halfOpening_;
};

// A screen that is tilted about the x axis, its front downwards.
class Tilted final : public ScreenSurface {
  public:
    Tilted(std::unique_ptr<const ScreenSurface> upright, double tilt)
        : upright_{std::move(upright)},
          wallFromUpright_{turned({0, -tilt, 0})},
          uprightFromWall_{glm::transpose(wallFromUpright_)} {}

    [[nodiscard]] std::optional<glm::dvec3> hit(const Ray& ray, double spill) const override {
        return back(upright_->hit({uprightFromWall_ * ray.origin, uprightFromWall_ * ray.direction},
                                  spill));
    }
    [[nodiscard]] glm::dvec3 normalAt(glm::dvec3 point) const override {
        return wallFromUpright_ * upright_->normalAt(uprightFromWall_ * point);
    }
    [[nodiscard]] glm::dvec2 unrolled(glm::dvec3 point) const override {
        return upright_->unrolled(uprightFromWall_ * point);
    }
    [[nodiscard]] std::optional<glm::dvec3> at(glm::dvec2 position) const override {
        return back(upright_->at(position));
    }
    [[nodiscard]] std::vector<glm::dvec3> border(double spill) const override {
        std::vector<glm::dvec3> points = upright_->border(spill);
        for (glm::dvec3& point : points) point = wallFromUpright_ * point;
        return points;
    }
    [[nodiscard]] PatternGround patternGround() const override {
        PatternGround ground = upright_->patternGround();
        ground.localFromWall = uprightFromWall_;
        return ground;
    }

  private:
    [[nodiscard]] std::optional<glm::dvec3> back(std::optional<glm::dvec3> point) const {
        if (point) point = wallFromUpright_ * *point;
        return point;
    }
    std::unique_ptr<const ScreenSurface> upright_;
    glm::dmat3 wallFromUpright_, uprightFromWall_;
};

// Flat displays anywhere; the panorama is what is seen from the sweet spot.
class Panels final : public ScreenSurface {
  public:
    explicit Panels(const config::Rig& rig) : view_{rig.sweetSpotMetres} {
        for (const config::Channel& channel : rig.channels)
            panels_.emplace_back(*channel.panel, rig.screen.hidesBezels);
        view_.enclose(pointsInside());
    }

    [[nodiscard]] std::optional<glm::dvec3> hit(const Ray& ray, double spill) const override {
        double nearest = std::numeric_limits<double>::infinity();
        for (const PanelFrame& panel : panels_)
            nearest = std::min(nearest, distanceTo(panel, ray, spill));
        if (nearest == std::numeric_limits<double>::infinity()) return std::nullopt;
        return ray.origin + nearest * ray.direction;
    }
    [[nodiscard]] glm::dvec3 normalAt(glm::dvec3 point) const override {
        const auto off = [&](const PanelFrame& panel) {
            const glm::dvec3 at = panel.local(point);
            const glm::dvec2 beside = glm::max(glm::abs(glm::dvec2(at)) - panel.size / 2.0, 0.0);
            return glm::length(glm::dvec3(beside, at.z));
        };
        return std::ranges::min_element(panels_, {}, off)->wallFromPanel[2];
    }
    [[nodiscard]] glm::dvec2 unrolled(glm::dvec3 point) const override {
        return view_.placeOf(point);
    }
    [[nodiscard]] std::optional<glm::dvec3> at(glm::dvec2 position) const override {
        if (!isWithinUnit(position)) return std::nullopt;
        return hit({view_.eye(), view_.directionAt(position)}, 0);
    }
    [[nodiscard]] std::vector<glm::dvec3> border(double spill) const override {
        std::vector<glm::dvec3> points;
        for (const PanelFrame& panel : panels_)
            walkUnitSquare([&](glm::dvec2 t) {
                points.push_back(panel.point((t - 0.5) * (panel.size + 2 * spill)));
            });
        return points;
    }
    [[nodiscard]] PatternGround patternGround() const override {
        return {.kind = PatternGround::Kind::Far};
    }

  private:
    // Not the border alone: a panel may lie under the viewer.
    [[nodiscard]] std::vector<glm::dvec3> pointsInside() const {
        constexpr int kSteps = 64;
        std::vector<glm::dvec3> points;
        for (const PanelFrame& panel : panels_)
            for (int y = 0; y <= kSteps; ++y)
                for (int x = 0; x <= kSteps; ++x)
                    points.push_back(
                        panel.point((glm::dvec2(x, y) / double{kSteps} - 0.5) * panel.size));
        return points;
    }
    // In lengths of the ray's direction; infinite where it misses.
    [[nodiscard]] static double distanceTo(const PanelFrame& panel, const Ray& ray, double spill) {
        constexpr double kNever = std::numeric_limits<double>::infinity();
        const glm::dvec3 from = panel.local(ray.origin);
        const glm::dvec3 way = ray.direction * panel.wallFromPanel;
        if (from.z <= 0 || way.z >= 0) return kNever;
        const double along = -from.z / way.z;
        const glm::dvec2 at = glm::abs(glm::dvec2(from + along * way));
        const glm::dvec2 most = panel.size / 2.0 + spill;
        return at.x <= most.x && at.y <= most.y ? along : kNever;
    }
    std::vector<PanelFrame> panels_;
    ViewBox view_;
};

}  // namespace

std::unique_ptr<const ScreenSurface> makeSurface(const config::Rig& rig) {
    const config::Screen& screen = rig.screen;
    if (screen.shape == config::ScreenShape::Panels) return std::make_unique<Panels>(rig);
    if (screen.shape == config::ScreenShape::Measured) return makeMeasuredSurface(rig);
    std::unique_ptr<const ScreenSurface> upright;
    if (screen.shape == config::ScreenShape::Flat) upright = std::make_unique<FlatWall>(screen);
    if (screen.shape == config::ScreenShape::Dome) upright = std::make_unique<Dome>(screen);
    if (screen.shape == config::ScreenShape::Cylinder) upright = std::make_unique<Cylinder>(screen);
    if (screen.tiltRadians == 0) return upright;
    return std::make_unique<Tilted>(std::move(upright), screen.tiltRadians);
}

bool isBefore(const ScreenSurface& screen, glm::dvec3 position, glm::dvec3 point) {
    return glm::dot(position - point, screen.normalAt(point)) > 0;
}

double azimuthOf(glm::dvec3 point) {
    return std::atan2(point.x, -point.z);
}

double elevationOf(glm::dvec3 point) {
    return std::atan2(point.y, std::hypot(point.x, point.z));
}

glm::dmat3 turned(glm::dvec3 yawPitchRoll) {
    const glm::dquat yaw = glm::angleAxis(yawPitchRoll.x, glm::dvec3(0, 1, 0));
    const glm::dquat pitch = glm::angleAxis(yawPitchRoll.y, glm::dvec3(1, 0, 0));
    const glm::dquat roll = glm::angleAxis(yawPitchRoll.z, glm::dvec3(0, 0, 1));
    return glm::mat3_cast(yaw * pitch * roll);
}

void ViewBox::enclose(std::span<const glm::dvec3> points) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    low_ = glm::dvec2(kInfinity);
    high_ = glm::dvec2(-kInfinity);
    for (const glm::dvec3& point : points) {
        const glm::dvec2 at(azimuthOf(point - eye_), elevationOf(point - eye_));
        low_ = glm::min(low_, at);
        high_ = glm::max(high_, at);
    }
    // Points never quite reach the back, zenith or nadir of what goes round.
    constexpr double kNearly = 0.1;
    constexpr double kQuarter = std::numbers::pi / 2;
    if (high_.x - low_.x > 4 * kQuarter - kNearly) low_.x = -2 * kQuarter, high_.x = 2 * kQuarter;
    if (high_.y > kQuarter - kNearly) high_.y = kQuarter;
    if (low_.y < kNearly - kQuarter) low_.y = -kQuarter;
}

glm::dvec2 ViewBox::placeOf(glm::dvec3 point) const {
    const glm::dvec2 at(azimuthOf(point - eye_), elevationOf(point - eye_));
    const glm::dvec2 share = (at - low_) / (high_ - low_);
    return {share.x, 1 - share.y};
}

glm::dvec3 ViewBox::directionAt(glm::dvec2 place) const {
    const glm::dvec2 at = glm::mix(low_, high_, glm::dvec2(place.x, 1 - place.y));
    return {std::cos(at.y) * std::sin(at.x), std::sin(at.y), -std::cos(at.y) * std::cos(at.x)};
}

PanelFrame::PanelFrame(const config::Panel& panel, bool hidesBezels)
    : middle{panel.positionMetres},
      wallFromPanel{turned(panel.yawPitchRollRadians)},
      size{panel.sizeMetres + (hidesBezels ? 2 * panel.bezelMetres : 0.0)} {}

}  // namespace aquarama::wall
