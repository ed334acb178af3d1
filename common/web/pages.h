// SPDX-License-Identifier: Apache-2.0
// Files that browsers are served, compiled into the program that serves them.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "common/web/server.h"

namespace aquarama::web {

// A file of the pages.
struct EmbeddedPage {
    std::string_view path;    // "/index.html"
    std::string_view digest;  // SHA-256
    std::string_view text;
};

// The file at the path of a request, of "/" the page itself; nothing where there is none.
[[nodiscard]] std::optional<HttpReply> pageAt(std::span<const EmbeddedPage> pages,
                                              const HttpRequest& request);

}  // namespace aquarama::web
