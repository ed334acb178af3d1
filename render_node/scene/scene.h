// SPDX-License-Identifier: Apache-2.0
// Draws the undersea world as one channel sees it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/body/side_skin.h"
#include "common/config/scene.h"
#include "common/place/place.h"
#include "render_node/quality/quality.h"
#include "render_node/scene/food_specks.h"
#include "render_node/surface/school_surface.h"

namespace aquarama::scene {

// A rectangle of a picture, in pixels.
struct PixelArea {
    glm::ivec2 corner{}, size{};
};

// One camera: at the sweet spot, or one of two eyes beside it. Matrices are for column vectors;
// depth is reversed, zero to one.
struct View {
    glm::mat4 clipFromCamera{1.0F};
    glm::mat4 cameraFromWorld{1.0F};
    glm::ivec2 sizePixels{};
    // The part of the picture that is drawn, from the picture's lower left corner, for pictures
    // that are too large for one texture; empty: all of it. It has the pixels that the whole
    // picture has there, but for what softening and bloom read outside of it.
    std::optional<PixelArea> part = {};
    // How many times as fine as the wall's pixels those of this picture are. Levels of detail
    // follow.
    float finer = 1.0F;
};

// Everything that a frame shows, the same on every node. A picture is a pure function of this, the
// options and the view.
struct SceneFrame {
    // Time since tick 0.
    double timeSeconds = 0;
    // The shared eye, in the submarine. Levels of detail follow from it, whatever the view.
    glm::vec3 eyePositionMetres{};
    // Fish of each species in turn, as many as the cast says.
    surface::SchoolMoment fish = {};
    std::span<const FoodParticle> food = {};
    // Light of the sky: 1 at noon, towards 0 at night; and the time of day, 0 and 1 midnight, which
    // gives it its colour.
    float daylight = 1.0F;
    float timeOfDay = 0.5F;
    // The share of the colour that water takes on the way which is given back (water_tables.h).
    float colourReturned = 0.0F;
};

// The options of a scene. A change needs a new SceneRenderer.
struct SceneOptions {
    place::PlaceKey place{.seed = 1};
    config::WaterType water = config::WaterType::IA;
    config::SceneCurrent current = {};
    config::QualityTier quality = config::QualityTier::Low;
    // The angle of the finest pixel of the whole wall, seen from the sweet spot; the same on every
    // node.
    float pixelRadians = 0.0016F;
    // Switched off only to measure what culling saves.
    bool culling = true;
    bool levelsOfDetail = true;

    bool operator==(const SceneOptions&) const = default;
};

// The renderer of one channel: update() once for each frame, then draw() for each view. Owns its GL
// objects; construct, use and destroy it with the same context current.
class SceneRenderer {
  public:
    // The place is made on other threads while this one compiles shaders. With an empty cast the
    // sea has no fish. Throws Error: too many species, a driver that cannot compile a shader.
    SceneRenderer(const SceneOptions& options, std::span<const surface::SchoolSpecies> cast);
    ~SceneRenderer();
    SceneRenderer(const SceneRenderer&) = delete;
    SceneRenderer& operator=(const SceneRenderer&) = delete;
    SceneRenderer(SceneRenderer&&) = delete;
    SceneRenderer& operator=(SceneRenderer&&) = delete;

    // Drawings of visitors that fish wear in the frames that follow: SchoolSurface::wear().
    void wear(const body::SkinsByNumber& skins, std::size_t most);

    // Uploads and computes what all views of a frame share: the waves and their light, the fish and
    // the shadows that they throw. Call it once for each frame, before draw().
    void update(const SceneFrame& frame);

    // Draws the updated frame into a texture of the view's part, RGBA16F, linear Rec. 709, already
    // exposed and toned to display light (0 black, 1 the projector's full white), and returns its
    // GL name; valid until the next draw.
    unsigned draw(const View& view);

    // Of the fish of the last draw(): SchoolSurface::counts().
    [[nodiscard]] surface::SurfaceCounts fishCounts() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace aquarama::scene
