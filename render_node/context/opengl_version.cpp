// SPDX-License-Identifier: Apache-2.0
#include "render_node/context/opengl_version.h"

#include <epoxy/gl.h>

#include "common/units/error.h"

namespace aquarama {

namespace {

std::string driverText(GLenum name) {
    const auto* text = reinterpret_cast<const char*>(glGetString(name));
    return text != nullptr ? text : "unknown";
}

}  // namespace

void requireOpenGl45(const std::string& where) {
    if (epoxy_gl_version() < 45) {
        throw Error(where + ": OpenGL 4.5 is needed, " + rendererAndVersion() +
                    " has less; update its driver or choose another device");
    }
}

std::string rendererAndVersion() {
    return driverText(GL_RENDERER) + ", OpenGL " + driverText(GL_VERSION);
}

}  // namespace aquarama
