// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/gpu/shader_log.h"

#include <epoxy/gl.h>

#include "common/base/log.h"

namespace aquarama::bench {

namespace {

// The parameters are those of OpenGL.
// NOLINTNEXTLINE(readability-function-size)
void APIENTRY onMessage(GLenum /*source*/,
                        GLenum /*type*/,
                        GLuint /*id*/,
                        GLenum /*severity*/,
                        GLsizei /*length*/,
                        const GLchar* message,
                        const void* log) {
    // The type of OpenGL's callback is that of a constant.
    const_cast<ShaderLog*>(static_cast<const ShaderLog*>(log))->add(message);
}

}  // namespace

ShaderLog::ShaderLog(const std::filesystem::path& file) : file_{file} {
    if (!file_) throw Error(file.string() + ": cannot be written; choose another --out");
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    glDebugMessageCallback(onMessage, this);
}

ShaderLog::~ShaderLog() {
    glDebugMessageCallback(nullptr, nullptr);
    glDisable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDisable(GL_DEBUG_OUTPUT);
}

void ShaderLog::add(const char* message) {
    file_ << message << '\n';
    isBelonging_ = false;
}

void ShaderLog::belongsTo(const std::string& program) {
    if (!isBelonging_) file_ << "=== program " << program << '\n';
    isBelonging_ = true;
}

}  // namespace aquarama::bench
