// SPDX-License-Identifier: Apache-2.0
// What a decoder that a picture has taken over could say, as its parent, the master and the nodes
// read it.
#include <cctype>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "common/ask/drawing_reader.h"
#include "common/base/log.h"
#include "common/base/picture.h"
#include "common/body/side_view.h"
#include "common/wire/messages.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

namespace {

// Of names and words, which go into logs, pages and paths.
void promiseWord(const std::string& word) {
    promise(!word.empty() && word.size() <= 64, "a word has a bound");
    for (const unsigned char c : word)
        promise(std::islower(c) != 0 || std::isdigit(c) != 0 || c == '_', "a word has its letters");
}

// As a node decodes what its master has let through.
void readSkin(std::span<const std::byte> png) {
    if (!body::beginsAsSkin(png)) return;
    try {
        const PngPicture picture = decodePng(png, "a skin");
        promise(picture.sizePixels == body::kSideTexels && picture.bits == 8,
                "a skin has the size and depth that it begins with");
    } catch (const Error& error) {
        promiseLine(error.what());
    }
}

}  // namespace

int fuzzDecoder(const std::uint8_t* bytes, std::size_t size) {
    const auto outcome =
        ask::outcomeIn(std::string_view(reinterpret_cast<const char*>(bytes), size));
    if (!outcome) return 0;
    if (const auto* refused = std::get_if<ask::DrawingRefused>(&*outcome)) {
        promiseWord(refused->word);
        return 0;
    }
    const auto& drawing = std::get<ask::ReadDrawing>(*outcome);
    promiseWord(drawing.species);
    promise(!drawing.skin.empty() && drawing.skin.size() <= wire::kMostSkinBytes,
            "a skin has a bound");
    readSkin(std::as_bytes(std::span(drawing.skin)));
    return 0;
}

}  // namespace aquarama
