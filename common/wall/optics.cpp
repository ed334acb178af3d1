// SPDX-License-Identifier: Apache-2.0
#include "common/wall/optics.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace aquarama::wall {

Lens::Lens(const config::Projector& projector, glm::ivec2 sizePixels)
    : wallFromProjector_(turned(projector.yawPitchRollRadians)),
      position_(projector.positionMetres),
      focal_(projector.focalPixels),
      principal_(projector.principalPixels),
      size_(sizePixels),
      distortion_(projector.distortion) {
    assert(focal_.x > 0);
    assert(focal_.y > 0);
    for (const glm::dvec2 corner :
         {glm::dvec2(0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1)}) {
        const glm::dvec2 tangent = tangentOf(distortion_, (corner * size_ - principal_) / focal_);
        farthestSquared_ = std::max(farthestSquared_, glm::dot(tangent, tangent));
    }
}

Ray Lens::ray(glm::dvec2 pixel) const {
    const glm::dvec2 tangent = tangentOf(distortion_, (pixel - principal_) / focal_);
    // Rows run down, y runs up.
    return {position_, wallFromProjector_ * glm::dvec3(tangent.x, -tangent.y, -1)};
}

std::optional<glm::dvec2> Lens::pixelOf(glm::dvec3 point) const {
    const glm::dvec3 seen = (point - position_) * wallFromProjector_;  // the transpose, applied
    if (seen.z >= 0) return std::nullopt;
    glm::dvec2 tangent = glm::dvec2(seen.x, -seen.y) / -seen.z;
    if (distortion_ != BrownLens<double>{}) {
        constexpr double kSlack = 1 + 1e-9;
        if (glm::dot(tangent, tangent) > farthestSquared_ * kSlack)
            return std::nullopt;  // where the lens may fold
        tangent = imageOf(distortion_, tangent);
    }
    const glm::dvec2 pixel = principal_ + focal_ * tangent;
    const bool inside = pixel.x >= 0 && pixel.y >= 0 && pixel.x <= size_.x && pixel.y <= size_.y;
    return inside ? std::optional(pixel) : std::nullopt;
}

const std::vector<glm::vec3>& Optics::nothing() {
    static const std::vector<glm::vec3> none;
    return none;
}

namespace {

// Calls visit for places along the border of a picture, corners included.
template <class Visit>
void walkPicture(glm::dvec2 sizePixels, Visit visit) {
    constexpr int kStepsPerSide = 2048;  // one for each pixel or two
    for (int i = 0; i <= kStepsPerSide; ++i) {
        const double t = static_cast<double>(i) / kStepsPerSide;
        for (const glm::dvec2 place :
             {glm::dvec2(t, 0), glm::dvec2(t, 1), glm::dvec2(0, t), glm::dvec2(1, t)})
            visit(place * sizePixels);
    }
}

class ProjectorOptics final : public Optics {
  public:
    ProjectorOptics(const config::Channel& channel, const ScreenSurface& screen)
        : lens_(channel.projector, channel.sizePixels),
          size_(channel.sizePixels),
          screen_(screen) {}

    [[nodiscard]] std::optional<glm::dvec3> pointOf(glm::dvec2 pixel, double spill) const override {
        return screen_.hit(lens_.ray(pixel), spill);
    }
    [[nodiscard]] std::optional<glm::dvec2> pixelOf(glm::dvec3 point) const override {
        const auto pixel = lens_.pixelOf(point);
        if (!pixel || !isBefore(screen_, lens_.position(), point)) return std::nullopt;
        return pixel;
    }
    // Where the picture's border falls on the screen, and where the screen's border falls into the
    // picture.
    [[nodiscard]] std::vector<glm::dvec3> outline(double spill) const override {
        std::vector<glm::dvec3> outline;
        walkPicture(size_, [&](glm::dvec2 pixel) {
            if (const auto point = pointOf(pixel, spill)) outline.push_back(*point);
        });
        for (const glm::dvec3& point : screen_.border(spill))
            if (pixelOf(point)) outline.push_back(point);
        return outline;
    }

  private:
    Lens lens_;
    glm::dvec2 size_;
    const ScreenSurface& screen_;
};

// A pixel of a panel lights itself.
class PanelOptics final : public Optics {
  public:
    PanelOptics(const config::Channel& channel, bool hidesBezels)
        : frame_(*channel.panel, hidesBezels), size_(channel.sizePixels) {}

    [[nodiscard]] std::optional<glm::dvec3> pointOf(glm::dvec2 pixel, double) const override {
        const glm::dvec2 share = pixel / size_;
        return frame_.point({(share.x - 0.5) * frame_.size.x, (0.5 - share.y) * frame_.size.y});
    }
    [[nodiscard]] std::optional<glm::dvec2> pixelOf(glm::dvec3 point) const override {
        constexpr double kSlackMetres = 1e-6;  // where rays met it, at its edges too
        const glm::dvec3 at = frame_.local(point);
        const glm::dvec2 beside = glm::abs(glm::dvec2(at)) - frame_.size / 2.0;
        if (std::max({beside.x, beside.y, std::abs(at.z)}) > kSlackMetres) return std::nullopt;
        const glm::dvec2 share = 0.5 + glm::dvec2(at.x, -at.y) / frame_.size;
        return glm::clamp(share, 0.0, 1.0) * size_;
    }
    [[nodiscard]] std::vector<glm::dvec3> outline(double) const override {
        std::vector<glm::dvec3> outline;
        walkPicture(size_, [&](glm::dvec2 pixel) { outline.push_back(*pointOf(pixel, 0)); });
        return outline;
    }
    [[nodiscard]] std::optional<glm::dmat3> wallFromPanel() const override {
        return frame_.wallFromPanel;
    }

  private:
    PanelFrame frame_;
    glm::dvec2 size_;
};

}  // namespace

WallFiles readWallFiles(const config::Rig& rig) {
    WallFiles files;
    for (const config::Channel& channel : rig.channels) {
        if (!channel.wallFile) continue;
        const std::string& name = channel.wallFile->file;
        if (files.contains(name)) continue;
        const std::string& frustum = channel.wallFile->frustum;
        files.emplace(name,
                      formats::readWallFile(
                          *rig.files.at(name),
                          name,
                          {.sizePixels = channel.sizePixels},
                          frustum.empty() ? std::span<const std::byte>{} : *rig.files.at(frustum)));
    }
    return files;
}

std::unique_ptr<const Optics> makeOptics(const config::Rig& rig,
                                         std::size_t channel,
                                         const ScreenSurface& screen,
                                         const WallFiles& files) {
    const config::Channel& what = rig.channels.at(channel);
    if (what.panel) return std::make_unique<PanelOptics>(what, rig.screen.hidesBezels);
    if (what.wallFile)
        return makeCalibratedOptics(rig, channel, screen, files.at(what.wallFile->file));
    return std::make_unique<ProjectorOptics>(what, screen);
}

}  // namespace aquarama::wall
