// SPDX-License-Identifier: Apache-2.0
// Buffers of GL, labelled for debuggers. Their size never changes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "render_node/gl/handle.h"

namespace aquarama::gl {

// Uninitialised. A buffer of nothing is an error in GL: it has 16 bytes at least.
[[nodiscard]] inline Buffer makeBuffer(std::size_t bytes, const char* label, GLbitfield flags = 0) {
    Buffer buffer;
    const auto size = static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 16));
    glNamedBufferStorage(buffer.name(), size, nullptr, flags);
    glObjectLabel(GL_BUFFER, buffer.name(), -1, label);
    return buffer;
}

// With the values.
template <class T>
[[nodiscard]] Buffer makeBuffer(std::span<const T> values,
                                const char* label,
                                GLbitfield flags = 0) {
    if (values.empty()) return makeBuffer(0, label, flags);
    Buffer buffer;
    const auto size = static_cast<GLsizeiptr>(values.size_bytes());
    glNamedBufferStorage(buffer.name(), size, values.data(), flags);
    glObjectLabel(GL_BUFFER, buffer.name(), -1, label);
    return buffer;
}
template <class T>
[[nodiscard]] Buffer makeBuffer(const std::vector<T>& values,
                                const char* label,
                                GLbitfield flags = 0) {
    return makeBuffer(std::span<const T>{values}, label, flags);
}

}  // namespace aquarama::gl
