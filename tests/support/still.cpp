// SPDX-License-Identifier: Apache-2.0
#include "tests/support/still.h"

#include <algorithm>
#include <cmath>

#include <epoxy/gl.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "common/base/files.h"
#include "common/body/fish_body.h"
#include "common/body/side_skin.h"
#include "tests/render_node/surface/test_fish.h"
#include "tests/support/cast.h"

namespace aquarama::test {

namespace {

constexpr float kSway = 0.05F;
constexpr std::size_t kMostPngBytes = std::size_t{16} << 20U;
constexpr glm::vec3 kUp{0, 1, 0};

glm::mat3 worldFromCamera(const Camera& camera) {
    const glm::mat4 turned =
        glm::rotate(glm::mat4{1.0F}, -glm::radians(camera.azimuthDegrees), kUp);
    return glm::mat3(
        glm::rotate(turned, glm::radians(camera.elevationDegrees), glm::vec3{1, 0, 0}));
}

// Of one species after the other, as a scene takes them.
struct Cast {
    std::vector<surface::SchoolSpecies> species;
    std::vector<motion::FishRecord> fish;
    body::SkinsByNumber drawings;
};

body::SkinsByNumber::value_type drawingOf(const std::string& png, std::uint32_t number) {
    return {number,
            std::make_shared<const body::SideSkin>(
                body::sideSkinOf(readWhole(png, kMostPngBytes), png))};
}

Cast castOf(const std::vector<StillFish>& fish) {
    Cast cast;
    std::vector<std::string> names;
    for (const StillFish& one : fish)
        if (std::ranges::find(names, one.species) == names.end()) names.push_back(one.species);
    for (const std::string& name : names) {
        const config::Species species = castMember(name);
        const body::FishBody body = body::makeBody(species);
        std::vector<motion::FishTraits> traits;
        for (const StillFish& one : fish) {
            if (one.species != name) continue;
            motion::PresentedFish shown =
                fishAt(one.placeMetres, one.worldFromBody, one.lengthMetres);
            shown.phase = one.phase;
            shown.speed = one.speedBodyLengths;
            shown.spread = one.spread;
            const float gaze = glm::radians(one.gazeDegrees);
            shown.gaze = {std::cos(gaze), 0, std::sin(gaze)};
            shown.mouth = one.mouth;
            shown.id = static_cast<std::uint32_t>(cast.fish.size());
            cast.fish.push_back(recordOf(shown));
            traits.push_back(traitsOf(shown));
            if (one.drawing.empty()) continue;
            cast.fish.back().skin = shown.id + 1;
            cast.drawings.insert(drawingOf(one.drawing, shown.id + 1));
        }
        cast.species.push_back({.body = body,
                                .skin = body::skinOf(species),
                                .repertoire = swaying(body, kSway),
                                .fish = traits,
                                .takesDrawings = !cast.drawings.empty()});
    }
    return cast;
}

Picture encoded(unsigned texture, glm::ivec2 size) {
    Light light = darkness(size);
    glGetTextureImage(texture,
                      0,
                      GL_RGB,
                      GL_FLOAT,
                      static_cast<GLsizei>(light.rgb.size() * sizeof(glm::vec3)),
                      light.rgb.data());
    Picture picture{.sizePixels = size, .bits = 8, .rgb = {}};
    for (int y = size.y - 1; y >= 0; --y)  // GL's rows begin at the bottom
        for (int x = 0; x < size.x; ++x)
            for (int c = 0; c < 3; ++c) {
                const double shown = std::clamp(static_cast<double>(light.at(x, y)[c]), 0.0, 1.0);
                picture.rgb.push_back(
                    static_cast<std::uint16_t>(std::lround(255 * srgbFromLinear(shown))));
            }
    return picture;
}

}  // namespace

float pixelRadiansOf(const Camera& camera) {
    const float tangent = std::tan(glm::radians(camera.heightDegrees) / 2);
    return 2.0F * tangent / static_cast<float>(camera.sizePixels.y);
}

scene::View viewOf(const Camera& camera) {
    constexpr float kNear = 0.05F;
    const glm::vec2 size(camera.sizePixels);
    const float tangent = std::tan(glm::radians(camera.heightDegrees) / 2);
    scene::View view;
    view.sizePixels = camera.sizePixels;
    view.clipFromCamera = glm::mat4{0.0F};
    view.clipFromCamera[0][0] = size.y / size.x / tangent;
    view.clipFromCamera[1][1] = 1.0F / tangent;
    view.clipFromCamera[2][3] = -1.0F;
    view.clipFromCamera[3][2] = kNear;
    view.cameraFromWorld =
        glm::translate(glm::mat4(glm::transpose(worldFromCamera(camera))), -camera.eyeMetres);
    return view;
}

StillFish portraitOf(const std::string& species,
                     const Camera& camera,
                     float metresAway,
                     float turnDegrees,
                     float lengthMetres) {
    const glm::vec3 ahead = worldFromCamera(camera) * glm::vec3{0, 0, -1};
    // A body looks along +x: turned half round it swims to the left of a camera that looks along
    // -z.
    const float turn = 180.0F - camera.azimuthDegrees + turnDegrees;
    return {species,
            camera.eyeMetres + metresAway * ahead,
            glm::angleAxis(glm::radians(turn), kUp),
            lengthMetres,
            0.1F,
            0.8F};
}

std::vector<StillFish> ballOf(const std::string& species,
                              int fish,
                              glm::vec3 centreMetres,
                              float radiusMetres) {
    constexpr float kGoldenAngle = 2.3999632F;
    std::vector<StillFish> ball;
    for (int i = 0; i < fish; ++i) {
        const float share = (static_cast<float>(i) + 0.5F) / static_cast<float>(fish);
        const float rise = 1.0F - 2.0F * share;
        const float angle = kGoldenAngle * static_cast<float>(i);
        // Fills the shell between half the radius and the radius.
        const float depth = std::fmod(0.754877F * static_cast<float>(i), 1.0F);
        const float r = radiusMetres * std::cbrt(0.125F + 0.875F * depth);
        const float flat = std::sqrt(1.0F - rise * rise);
        const glm::vec3 from{flat * std::sin(angle), rise, flat * std::cos(angle)};
        const float wobble = 0.25F * std::sin(12.9898F * static_cast<float>(i));
        const glm::quat heading = glm::angleAxis(angle + wobble, kUp);
        const float length = 0.24F * (1.0F + 0.1F * std::sin(7.0F * static_cast<float>(i)));
        ball.push_back({species, centreMetres + r * from, heading, length, depth, 1.5F});
    }
    return ball;
}

Picture Photographer::pictureOf(const Still& still) {
    const Cast cast = castOf(still.fish);
    scene::SceneOptions options = still.options;
    options.pixelRadians = pixelRadiansOf(still.camera);
    std::vector<std::tuple<std::string, float, bool>> fish;
    for (const StillFish& one : still.fish)
        fish.emplace_back(one.species, one.lengthMetres, !one.drawing.empty());
    if (!scene_ || options != options_ || fish != fish_) {
        scene_.reset();
        scene_ = std::make_unique<scene::SceneRenderer>(options, cast.species);
        options_ = options;
        fish_ = std::move(fish);
    }
    scene::SceneFrame frame;
    frame.timeSeconds = still.timeSeconds;
    frame.eyePositionMetres = still.camera.eyeMetres;
    frame.fish.after = cast.fish;
    frame.daylight = still.daylight;
    frame.timeOfDay = still.timeOfDay;
    frame.colourReturned = still.colourReturned;
    scene_->wear(cast.drawings, cast.drawings.size());
    scene_->update(frame);
    return encoded(scene_->draw(viewOf(still.camera)), still.camera.sizePixels);
}

Picture pictureOf(const Still& still) {
    return Photographer{}.pictureOf(still);
}

}  // namespace aquarama::test
