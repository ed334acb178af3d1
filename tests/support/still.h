// SPDX-License-Identifier: Apache-2.0
// A picture of the sea without a master: a camera anywhere, a place, some fish, one instant. For
// golden pictures, for documents, and for looking while one works on what a visitor sees.
#pragma once

#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/base/picture.h"
#include "common/place/place.h"
#include "render_node/scene/scene.h"

namespace aquarama::test {

struct Camera {
    glm::vec3 eyeMetres = place::kEyePosition;
    float azimuthDegrees = 0.0F;  // from -z to the right
    float elevationDegrees = 0.0F;
    float heightDegrees = 50.0F;  // field of view
    glm::ivec2 sizePixels{480, 270};
};
// Reversed depth, zero to one, far plane at infinity.
[[nodiscard]] scene::View viewOf(const Camera& camera);
// The angle of the pixel in the middle: a still is the whole wall.
[[nodiscard]] float pixelRadiansOf(const Camera& camera);

struct StillFish {
    std::string species;  // of config/species
    glm::vec3 placeMetres{};
    glm::quat worldFromBody{1, 0, 0, 0};
    float lengthMetres = 0.24F;
    float phase = 0.0F;
    float speedBodyLengths = 0.0F;  // a second; its fins go by it
    float spread = 0.0F;            // of fins that brake, 0 to 1
    float mouth = 0.0F;             // 0 shut to 1 wide open
    float gazeDegrees = 0.0F;       // to the right
    std::string drawing = {};       // PNG of what a visitor has painted; empty: its own skin
};
// So far before the camera and turned so that it shows its left side (0), its face (90), its right
// side (180).
[[nodiscard]] StillFish portraitOf(const std::string& species,
                                   const Camera& camera,
                                   float metresAway,
                                   float turnDegrees,
                                   float lengthMetres);
// A ball of fish about a place that mill to the left; the same for the same number.
[[nodiscard]] std::vector<StillFish> ballOf(const std::string& species,
                                            int fish,
                                            glm::vec3 centreMetres,
                                            float radiusMetres);

struct Still {
    Camera camera;
    std::vector<StillFish> fish;
    double timeSeconds = 12.0;
    scene::SceneOptions options;  // quality, place, seed; not pixelRadians
    float daylight = 1.0F;
    float timeOfDay = 0.5F;
    float colourReturned = static_cast<float>(config::SceneWater{}.colourReturned);
};
// Takes stills, and grows a sea only where the one before was of other options or with other fish:
// that takes seconds. Construct, use and destroy with the same context current.
class Photographer {
  public:
    // Bodies sway; they are not captured. sRGB, 8 bits, without dither.
    [[nodiscard]] Picture pictureOf(const Still& still);

  private:
    scene::SceneOptions options_;
    std::vector<std::tuple<std::string, float, bool>> fish_;  // species, length, has a drawing
    std::unique_ptr<scene::SceneRenderer> scene_;
};
// One alone.
[[nodiscard]] Picture pictureOf(const Still& still);

}  // namespace aquarama::test
