// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "common/base/characters.h"

namespace aquarama {

// Stops the program where a promise is broken, so that every driver notices.
inline void promise(bool kept, const char* what) {
    if (kept) return;
    std::fprintf(stderr, "broken promise: %s\n", what);
    std::abort();
}

// Of errors and remarks, which go into logs and pages: nothing of the bytes that were read comes
// through raw.
inline void promiseLine(const std::string& text) {
    promise(text.find('\n') == std::string::npos, "a message is one line");
    promise(legible(text) == text, "a message is UTF-8 without controls");
}

}  // namespace aquarama
