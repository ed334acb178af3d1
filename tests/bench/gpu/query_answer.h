// SPDX-License-Identifier: Apache-2.0
// What an OpenGL query has counted.
#pragma once

#include <cstdint>

#include <epoxy/gl.h>

namespace aquarama::bench {

// The answer of an ended query; waits until the card has it.
[[nodiscard]] inline std::uint64_t answerOf(unsigned query) {
    GLuint64 answer = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &answer);
    return answer;
}

}  // namespace aquarama::bench
