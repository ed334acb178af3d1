// SPDX-License-Identifier: Apache-2.0
#include "render_node/context/driver.h"

#include <array>

#include <epoxy/gl.h>

#include "common/units/error.h"

namespace aquarama::context {

namespace {

struct Need {
    const char* what;
    GLenum limit;
    int least;
};

// OpenGL 4.5 leaves these to the driver, some down to none.
constexpr std::array kNeeds{
    Need{"storage blocks in vertex shaders", GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, 4},
    Need{"storage blocks in compute shaders", GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, 8},
    Need{"texture units", GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, 32},
    Need{"invocations in a work group", GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, 128},
    Need{"bytes of shared memory", GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, 16384},
    Need{"pixels along a texture", GL_MAX_TEXTURE_SIZE, 8192},
};

std::string driverText(GLenum name) {
    const auto* text = reinterpret_cast<const char*>(glGetString(name));
    return text != nullptr ? text : "unknown";
}

int limitOfDriver(unsigned limit) {
    GLint value = 0;
    glGetIntegerv(limit, &value);
    return value;
}

}  // namespace

void requireDriver(const std::string& where) {
    if (epoxy_gl_version() < 45)
        throw Error(where + ": OpenGL 4.5 is needed, " + rendererAndVersion() +
                    " has less; update its driver or choose another device");
    if (const auto lack = lackOf(limitOfDriver))
        throw Error(where + ": " + rendererAndVersion() + " lacks what is needed: " + *lack +
                    "; update its driver or choose another device");
}

std::optional<std::string> lackOf(const std::function<int(unsigned limit)>& limitOf) {
    for (const Need& need : kNeeds)
        if (const int has = limitOf(need.limit); has < need.least)
            return std::to_string(need.least) + " " + need.what + ", it has " + std::to_string(has);
    return std::nullopt;
}

std::string rendererAndVersion() {
    return driverText(GL_RENDERER) + ", OpenGL " + driverText(GL_VERSION);
}

std::optional<std::string> lossOfContext() {
    switch (glGetGraphicsResetStatus()) {
        case GL_NO_ERROR:
            return std::nullopt;
        case GL_GUILTY_CONTEXT_RESET:
            return "our own work made the graphics card stop";
        case GL_INNOCENT_CONTEXT_RESET:
            return "another program made the graphics card stop";
        default:
            return "the graphics card stopped";
    }
}

}  // namespace aquarama::context
