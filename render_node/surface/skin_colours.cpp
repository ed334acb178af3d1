// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/skin_colours.h"

#include "render_node/gl/handle.h"
#include "render_node/shaders/shader_interface.h"
#include "render_node/surface/school_surface.h"

namespace aquarama::surface {

namespace {

// Layout of Place in skin_colours.comp, std430.
struct PlaceOnSkin {
    glm::vec4 rest{}, fin{};
};

}  // namespace

std::vector<glm::vec4> skinColours(const body::FishSkin& skin,
                                   std::span<const skin::SkinPlace> places) {
    const gl::ProgramHandle program = skinProgram({"skin_colours.comp"}, skin, {});
    std::vector<PlaceOnSkin> asked;
    for (const skin::SkinPlace& place : places)
        asked.push_back({place.rest, {place.fin, static_cast<float>(place.part), 0}});
    std::vector<glm::vec4> colours(places.size());
    const gl::Buffer in = gl::makeBuffer(asked, "places on a skin");
    const gl::Buffer out = gl::makeBuffer(colours, "colours of a skin");
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shaders::kSkinPlacesStorage, in.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shaders::kSkinColoursStorage, out.name());
    glUseProgram(program.name());
    const auto groups = (places.size() + shaders::kGroupSize - 1) / shaders::kGroupSize;
    glDispatchCompute(static_cast<GLuint>(groups), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(
        out.name(), 0, static_cast<GLsizeiptr>(colours.size() * sizeof(glm::vec4)), colours.data());
    return colours;
}

}  // namespace aquarama::surface
