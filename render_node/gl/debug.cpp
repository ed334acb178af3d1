// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/debug.h"

#include <epoxy/gl.h>

#include "common/units/log.h"

namespace aquarama::gl {

namespace {

void APIENTRY onMessage(GLenum /*source*/,
                        GLenum type,
                        GLuint /*id*/,
                        GLenum severity,
                        GLsizei length,
                        const GLchar* message,
                        const void* /*user*/) {
    const std::string_view text{message, static_cast<std::size_t>(length)};
    if (type == GL_DEBUG_TYPE_ERROR)
        logError("OpenGL: {}", text);
    else if (severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM)
        logWarning("OpenGL: {}", text);
}

}  // namespace

void logMessages() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onMessage, nullptr);
}

Stage::Stage(const char* name) {
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name);
}

Stage::~Stage() {
    glPopDebugGroup();
}

}  // namespace aquarama::gl
