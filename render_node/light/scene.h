// SPDX-License-Identifier: Apache-2.0
// The undersea world as one channel sees it, in linear light.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/scene.h"
#include "render_node/light/food_specks.h"
#include "render_node/reef/quality.h"
#include "render_node/surface/school_surface.h"

namespace aquarama::scene {

// One camera: at the sweet spot, or one of two eyes beside it. Column vectors; reversed depth, zero
// to one.
struct View {
    glm::mat4 clipFromCamera{1.0F};
    glm::mat4 cameraFromWorld{1.0F};
    glm::ivec2 sizePixels{};
};

// Everything that a frame shows, the same on every node: a pure function of the shared eye, the
// tick and the fish.
struct SceneFrame {
    double timeSeconds = 0;
    glm::vec3 eyePositionMetres{};    // the shared eye: of the submarine, for levels of detail
    surface::SchoolMoment fish = {};  // of each species in turn, as many as it has
    std::span<const FoodParticle> food = {};
    float daylight = 1.0F;  // of the sky: 1 at noon, towards 0 at night
};

struct SceneOptions {
    std::uint32_t seed = 1;
    config::PlaceKind place = config::PlaceKind::Reef;
    config::WaterType water = config::WaterType::IA;
    config::QualityTier quality = config::QualityTier::Low;
    float pixelRadians = 0.0016F;  // the finest pixel of the whole wall, seen from the sweet spot
    bool culling = true;           // off only to measure what it saves
    bool levelsOfDetail = true;

    bool operator==(const SceneOptions&) const = default;
};

// Owns its GL objects; construct, use and destroy with the same context current.
class SceneRenderer {
  public:
    // Without a cast it is a sea without fish.
    SceneRenderer(const SceneOptions& options, std::span<const surface::SchoolSpecies> cast);
    ~SceneRenderer();
    SceneRenderer(const SceneRenderer&) = delete;
    SceneRenderer& operator=(const SceneRenderer&) = delete;
    SceneRenderer(SceneRenderer&&) = delete;
    SceneRenderer& operator=(SceneRenderer&&) = delete;

    // Once a frame, before it is drawn for each view: the state of the sea, what its light does,
    // and the fish.
    void update(const SceneFrame& frame);

    // Draws the updated frame into a texture of view.sizePixels, RGBA16F, linear Rec. 709, already
    // exposed and toned to display light (0 black, 1 the projector's full white), and returns its
    // GL name; valid until the next draw.
    unsigned draw(const View& view);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace aquarama::scene
