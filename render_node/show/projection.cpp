// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/projection.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "common/base/log.h"
#include "common/base/picture.h"
#include "common/wall/pattern.h"
#include "common/wall/scan_pattern.h"
#include "render_node/gl/program.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::show {

static_assert(shaders::kSideBySide == static_cast<int>(config::StereoMode::SideBySide) &&
              shaders::kTopBottom == static_cast<int>(config::StereoMode::TopBottom) &&
              shaders::kInterlaced == static_cast<int>(config::StereoMode::Interlaced));
static_assert(shaders::kSphereGround == static_cast<int>(wall::PatternGround::Kind::Sphere) &&
              shaders::kPlaneGround == static_cast<int>(wall::PatternGround::Kind::Plane) &&
              shaders::kFarGround == static_cast<int>(wall::PatternGround::Kind::Far));

namespace {

// State and uniforms that project.frag and project_pair.frag share (project.glsl). GL's own
// dithering is off: the shader dithers. The seed changes with the channel and with the parity of
// the frame.

void beginPass(const Projection::Draw& what,
               const gl::ProgramHandle& program,
               glm::ivec2 size,
               std::uint32_t channelId) {
    glBindFramebuffer(GL_FRAMEBUFFER, what.framebuffer);
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDisable(GL_DITHER);
    glUseProgram(program.name());
    glUniform2i(shaders::kSizeLocation, size.x, size.y);
    glUniform1ui(shaders::kSeedLocation,
                 channelId * 2U + static_cast<GLuint>(what.frame.value % 2));
    glUniform1i(shaders::kDitheredLocation, what.encoding == Encoding::Dithered8 ? 1 : 0);
    glUniform1i(shaders::kBlendMaskLocation, what.blendMask ? 1 : 0);
    glUniform1f(shaders::kBrightnessLocation, what.brightness);
    glUniform1i(shaders::kColouredLocation, what.codes != nullptr ? 1 : 0);
    if (what.codes != nullptr) what.codes->use();
}

// Bilinear filtering without wrapping. A sampler object leaves the texture's own state alone.
void makeBilinear(const gl::Sampler& sampler) {
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace

ProjectorCodes::ProjectorCodes(const formats::ChannelColour& colour) : ownFromLight_{colour.mix} {
    std::vector<glm::vec3> codes;
    for (int i = 0; i < shaders::kCodeTexels; ++i) {
        const double root = i / double{shaders::kCodeTexels - 1};
        glm::vec3& code = codes.emplace_back();
        for (int c = 0; c < 3; ++c)
            code[c] = static_cast<float>(
                formats::codeFor(colour.response[static_cast<std::size_t>(c)], root * root));
    }
    glTextureStorage1D(table_.name(), 1, GL_RGB32F, shaders::kCodeTexels);
    glTextureSubImage1D(table_.name(), 0, 0, shaders::kCodeTexels, GL_RGB, GL_FLOAT, codes.data());
    glObjectLabel(GL_TEXTURE, table_.name(), -1, "codes of the projector");
}

void ProjectorCodes::use() const {
    glBindTextureUnit(shaders::kCodesUnit, table_.name());
    glUniformMatrix3fv(shaders::kMixLocation, 1, GL_FALSE, glm::value_ptr(ownFromLight_));
}

Projection::Projection(const ProjectionMap& map, std::uint32_t channelId)
    : size_{map.sizePixels},
      channelId_{channelId},
      program_{gl::makeProgram({"quad.vert", "project.frag"})},
      map_{GL_TEXTURE_2D} {
    assert(map.placeAndWeight.size() ==
           static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y));
    glTextureStorage2D(map_.name(), 1, GL_RGBA32F, size_.x, size_.y);
    glTextureSubImage2D(
        map_.name(), 0, 0, 0, size_.x, size_.y, GL_RGBA, GL_FLOAT, map.placeAndWeight.data());
    glObjectLabel(GL_TEXTURE, map_.name(), -1, "projection map");
    for (const auto& [texture, light] : {std::pair{&blend_, &map.blend}, {&black_, &map.black}}) {
        if (light->empty()) continue;
        texture->emplace(GL_TEXTURE_2D);
        glTextureStorage2D((*texture)->name(), 1, GL_RGB32F, size_.x, size_.y);
        glTextureSubImage2D(
            (*texture)->name(), 0, 0, 0, size_.x, size_.y, GL_RGB, GL_FLOAT, light->data());
    }
    makeBilinear(bilinear_);
}

void Projection::draw(const Draw& what) const {
    beginPass(what, program_, size_, channelId_);
    glBindTextureUnit(shaders::kSceneUnit, what.sceneTexture);
    glBindSampler(shaders::kSceneUnit, bilinear_.name());
    glBindTextureUnit(shaders::kPlacesUnit, map_.name());
    bindMasks();
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindSampler(shaders::kSceneUnit, 0);
}

void Projection::bindMasks() const {
    if (blend_) glBindTextureUnit(shaders::kBlendUnit, blend_->name());
    if (black_) glBindTextureUnit(shaders::kBlackUnit, black_->name());
    glUniform2i(shaders::kMasksLocation, blend_.has_value(), black_.has_value());
}

PairProjection::PairProjection(glm::ivec2 sizePixels,
                               std::uint32_t channelId,
                               config::StereoMode mode)
    : size_{sizePixels},
      channelId_{channelId},
      mode_{mode},
      program_{gl::makeProgram({"quad.vert", "project_pair.frag"})} {
    assert(mode != config::StereoMode::Mono);
    assert(mode != config::StereoMode::QuadBuffer);
    makeBilinear(bilinear_);
}

void PairProjection::draw(const Eye& left, const Eye& right, const Projection::Draw& both) const {
    beginPass(both, program_, size_, channelId_);
    glUniform1i(shaders::kModeLocation, static_cast<GLint>(mode_));
    glBindTextureUnit(shaders::kSceneUnit, left.sceneTexture);
    glBindTextureUnit(shaders::kPlacesUnit, left.projection.mapTexture());
    glBindTextureUnit(shaders::kRightSceneUnit, right.sceneTexture);
    glBindTextureUnit(shaders::kRightPlacesUnit, right.projection.mapTexture());
    left.projection.bindMasks();
    glBindSampler(shaders::kSceneUnit, bilinear_.name());
    glBindSampler(shaders::kRightSceneUnit, bilinear_.name());
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindSampler(shaders::kSceneUnit, 0);
    glBindSampler(shaders::kRightSceneUnit, 0);
}

glm::vec2 pixelOfEye(config::StereoMode mode, glm::ivec2 sizePixels, glm::vec2 pixel) {
    const glm::vec2 half = glm::vec2(sizePixels) / 2.0F;
    if (mode == config::StereoMode::SideBySide)
        pixel.x = 2 * (pixel.x < half.x ? pixel.x : pixel.x - half.x);
    if (mode == config::StereoMode::TopBottom)
        pixel.y = 2 * (pixel.y < half.y ? pixel.y : pixel.y - half.y);
    return pixel;
}

namespace {

glm::u8vec4 codeOf(glm::vec3 light) {
    const auto code = [](float part) {
        return static_cast<std::uint8_t>(std::lround(255 * srgbFromLinear(double{part})));
    };
    return {code(light.r), code(light.g), code(light.b), 255};
}

// The light along both axes; except for the tag, each depends on one axis alone.
std::vector<glm::u8vec4> codesAlong(config::ScanPattern pattern,
                                    std::size_t channel,
                                    glm::ivec2 size) {
    pattern.tagged = false;
    std::vector<glm::u8vec4> codes;
    for (int i = 0; i < std::max(size.x, size.y); ++i)
        codes.push_back(codeOf(wall::scanLight(pattern, channel, size, {i, i})));
    return codes;
}

}  // namespace

std::vector<glm::u8vec4> scanCodes(const config::ScanPattern& pattern,
                                   std::size_t channel,
                                   glm::ivec2 size,
                                   config::StereoMode mode) {
    const std::vector<glm::u8vec4> along = codesAlong(pattern, channel, size);
    const auto [cell, corner] = wall::scanTagPlace(size);
    const glm::ivec2 end = corner + glm::ivec2(wall::kScanTagCells * cell, cell);
    const bool rows = isOfRows(pattern.kind);
    const bool isDots = pattern.kind == config::ScanPattern::Kind::Dots;
    std::vector<glm::u8vec4> codes;
    codes.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::ivec2 at(pixelOfEye(mode, size, glm::vec2(x, y) + 0.5F));
            const bool isTag =
                glm::all(glm::greaterThanEqual(at, corner)) && glm::all(glm::lessThan(at, end));
            codes.push_back(isTag || isDots ? codeOf(wall::scanLight(pattern, channel, size, at))
                                            : along[static_cast<std::size_t>(rows ? at.y : at.x)]);
        }
    return codes;
}

void ScanPass::draw(unsigned framebuffer,
                    const config::ScanPattern& pattern,
                    config::StereoMode mode) {
    const glm::ivec2 size = picture_.sizePixels();
    if (drawn_ != std::pair(pattern, mode)) {
        const std::vector<glm::u8vec4> codes = scanCodes(pattern, channel_, size, mode);
        glTextureSubImage2D(
            picture_.texture(), 0, 0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, codes.data());
        drawn_.emplace(pattern, mode);
    }
    glDisable(GL_SCISSOR_TEST);
    // The codes have the top row first, a framebuffer the bottom row.
    glBlitNamedFramebuffer(picture_.framebuffer(),
                           framebuffer,
                           0,
                           size.y,
                           size.x,
                           0,
                           0,
                           0,
                           size.x,
                           size.y,
                           GL_COLOR_BUFFER_BIT,
                           GL_NEAREST);
}

namespace {

// Perspective projection of a screen point: tangents at distance 1, scaled to 0 .. 1 across the
// frustum.
glm::vec4 place(const glm::vec4& pointAndWeight, const wall::ChannelFrustum& frustum) {
    if (pointAndWeight.w <= 0) return glm::vec4(0);
    const glm::dvec4 seen = frustum.cameraFromWall * glm::dvec4(glm::dvec3(pointAndWeight), 1);
    const glm::dvec2 tangent = glm::dvec2(seen) / -seen.z;
    const double u = (tangent.x - frustum.left) / (frustum.right - frustum.left);
    const double v = (tangent.y - frustum.bottom) / (frustum.top - frustum.bottom);
    return {u, v, pointAndWeight.w, 0};
}

}  // namespace

ProjectionMap projectionMap(const wall::WarpMap& warp, const wall::ChannelFrustum& frustum) {
    assert(frustum.right > frustum.left);
    assert(frustum.top > frustum.bottom);
    ProjectionMap map{.sizePixels = warp.sizePixels,
                      .placeAndWeight = {},
                      .blend = warp.blend,
                      .black = warp.black};
    map.placeAndWeight.reserve(warp.pointAndWeight.size());
    for (const glm::vec4& point : warp.pointAndWeight)
        map.placeAndWeight.push_back(place(point, frustum));
    return map;
}

namespace {

// The pixel nearest to the middle that lights the screen at another place than its neighbours to
// the right and below, which light it too; the number of pixels where there is none.
std::size_t litNearMiddle(const ProjectionMap& map) {
    const glm::ivec2 size = map.sizePixels;
    const auto isLit = [&](std::size_t i) { return map.placeAndWeight[i].z > 0; };
    std::size_t best = map.placeAndWeight.size();
    int least = std::numeric_limits<int>::max();
    for (int y = 0; y + 1 < size.y; ++y)
        for (int x = 0; x + 1 < size.x; ++x) {
            const glm::ivec2 off = glm::ivec2(x, y) - size / 2;
            const int distance = off.x * off.x + off.y * off.y;
            if (distance >= least) continue;
            const auto i = static_cast<std::size_t>(y * size.x + x);
            const std::size_t below = i + static_cast<std::size_t>(size.x);
            if (!isLit(i) || !isLit(i + 1) || !isLit(below)) continue;
            const glm::vec2 here(map.placeAndWeight[i]);
            if (here.x == map.placeAndWeight[i + 1].x || here.y == map.placeAndWeight[below].y)
                continue;
            best = i;
            least = distance;
        }
    return best;
}

}  // namespace

glm::ivec2 scenePictureSize(const ProjectionMap& map) {
    if (map.sizePixels.x < 2 || map.sizePixels.y < 2)
        throw Error("channel: a picture of less than 2 x 2 pixels; give it the projector's size");
    const auto width = static_cast<std::size_t>(map.sizePixels.x);
    const std::size_t middle = litNearMiddle(map);
    if (middle == map.placeAndWeight.size())
        throw Error("channel: no part of its picture meets the screen; aim its projector at it");
    const glm::vec4& at = map.placeAndWeight[middle];
    const glm::vec4& right = map.placeAndWeight[middle + 1];
    const glm::vec4& below = map.placeAndWeight[middle + width];
    // The derivative of the map in the middle. The size along an axis of the scene's picture is 1 /
    // (the length of the step, along that axis, for one projector pixel).
    const glm::dvec2 acrossColumns = glm::dvec2(right) - glm::dvec2(at);
    const glm::dvec2 acrossRows = glm::dvec2(below) - glm::dvec2(at);
    return {std::ceil(1 / std::hypot(acrossColumns.x, acrossRows.x)),
            std::ceil(1 / std::hypot(acrossColumns.y, acrossRows.y))};
}

namespace {

// Value of greyLight for pattern.frag that selects the grid.

constexpr float kNoGrey = -1;

}  // namespace

PatternPass::PatternPass(const wall::ChannelFrustum& frustum, const wall::PatternGround& ground)
    : frustum_{frustum},
      ground_{ground},
      eyeAndSize_{ground.localFromWall * glm::dvec3(glm::inverse(frustum.cameraFromWall)[3]),
                  ground.size},
      program_{gl::makeProgram({"quad.vert", "pattern.frag"})} {}

void PatternPass::drawGrid(unsigned framebuffer, glm::ivec2 sizePixels) const {
    draw(framebuffer, sizePixels, kNoGrey);
}

void PatternPass::drawGrey(unsigned framebuffer, glm::ivec2 sizePixels) const {
    draw(framebuffer, sizePixels, static_cast<float>(wall::kGreyLight));
}

void PatternPass::addGrid(unsigned framebuffer, glm::ivec2 sizePixels) const {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    draw(framebuffer, sizePixels, kNoGrey);
    glDisable(GL_BLEND);
}

void PatternPass::draw(unsigned framebuffer, glm::ivec2 sizePixels, float greyLight) const {
    // The transpose of a rotation is its inverse.
    const glm::mat3 wallFromCamera(glm::transpose(glm::dmat3(frustum_.cameraFromWall)));
    const glm::vec4 extents(frustum_.left, frustum_.bottom, frustum_.right, frustum_.top);
    const glm::vec4 gridLines(wall::kGridDegrees,
                              wall::kGridMajorDegrees,
                              wall::kGridMinorLight,
                              wall::kGridSigmaDegrees);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, sizePixels.x, sizePixels.y);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glUseProgram(program_.name());
    glUniformMatrix3fv(
        shaders::kWallFromCameraLocation, 1, GL_FALSE, glm::value_ptr(wallFromCamera));
    glUniform4fv(shaders::kExtentsLocation, 1, glm::value_ptr(extents));
    glUniform1f(shaders::kGreyLightLocation, greyLight);
    glUniform4fv(shaders::kGridLinesLocation, 1, glm::value_ptr(gridLines));
    const glm::mat3 localFromWall(ground_.localFromWall);
    glUniformMatrix3fv(shaders::kLocalFromWallLocation, 1, GL_FALSE, glm::value_ptr(localFromWall));
    glUniform1i(shaders::kGroundLocation, static_cast<GLint>(ground_.kind));
    glUniform4fv(shaders::kEyeAndSizeLocation, 1, glm::value_ptr(eyeAndSize_));
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace aquarama::show
