// SPDX-License-Identifier: Apache-2.0
#include "common/web/pages.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace aquarama::web {

namespace {

// By its ending; browsers are told not to guess.
std::string_view typeOf(std::string_view path) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kTypes{
        {{".html", "text/html; charset=utf-8"},
         {".js", "text/javascript; charset=utf-8"},
         {".css", "text/css; charset=utf-8"},
         {".json", "application/json"},
         {".svg", "image/svg+xml"}}};
    for (const auto& [ending, type] : kTypes)
        if (path.ends_with(ending)) return type;
    return "text/plain; charset=utf-8";
}

}  // namespace

// By its exact name: there is no folder to leave.
std::optional<HttpReply> pageAt(std::span<const EmbeddedPage> pages, const HttpRequest& request) {
    const std::string path =
        request.target == "/" ? "/index.html" : request.target.substr(0, request.target.find('?'));
    const auto page = std::ranges::find(pages, path, &EmbeddedPage::path);
    if (page == pages.end()) return std::nullopt;
    const std::string etag = "\"" + std::string(page->digest.substr(0, 32)) + "\"";
    HttpReply reply{.type = std::string(typeOf(path)), .headers = {{"ETag", etag}}};
    if (request.etag == etag)
        reply.status = 304;
    else
        reply.body = std::string(page->text);
    return reply;
}

}  // namespace aquarama::web
