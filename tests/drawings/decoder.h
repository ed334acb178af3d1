// SPDX-License-Identifier: Apache-2.0
// Pictures through the program that decodes those of strangers.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <future>
#include <span>
#include <string>

#include "common/ask/drawing_reader.h"

namespace aquarama::test {

// As a machine with much else to do may take.
inline constexpr double kDecoderSeconds = 120;

// The one that was built.
inline std::filesystem::path decoderProgram() {
    return std::filesystem::path(std::getenv("AQUARAMA_BIN")) / "aquarama-drawings";
}

inline std::string textOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// What a reader says of a picture.
inline ask::DrawingOutcome outcomeOf(ask::DrawingReader& reader, std::string picture) {
    std::promise<ask::DrawingOutcome> said;
    if (!reader.read(std::move(picture), [&](const auto& outcome) { said.set_value(outcome); }))
        return ask::DrawingRefused{"not taken"};
    return said.get_future().get();
}

// The word of a refusal; empty: it is a drawing.
inline std::string wordOf(const ask::DrawingOutcome& outcome) {
    const auto* refused = std::get_if<ask::DrawingRefused>(&outcome);
    return refused != nullptr ? refused->word : "";
}

}  // namespace aquarama::test
