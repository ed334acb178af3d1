// SPDX-License-Identifier: Apache-2.0
// What is set by hand on top of projectors and wall files: a file of its own, which a new
// calibration leaves as it is. adjustments.proto says what each value means.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "common/config/rig.h"
#include "common/config/text_file.h"

namespace aquarama::config {

// Of which picture the pixels of a place are.
enum class PixelsOf : std::uint8_t { Picture, Panorama };

// Channels are indices of the rig's.
struct ControlPoint {
    std::size_t channel = 0;
    PixelsOf pixelsOf = PixelsOf::Panorama;
    glm::dvec2 place{};
    glm::dvec2 byPixels{};    // of the panorama, right and down
    double radiusPixels = 0;  // of the panorama
    SourcePlace source = {};
};

// An area of a picture that is dimmed or left out by hand.
struct MaskedArea {
    std::optional<std::size_t> channel = {};  // nothing: all
    PixelsOf pixelsOf = PixelsOf::Panorama;
    std::vector<glm::dvec2> corners = {};
    double softPixels = 0;
    SourcePlace source = {};
};

// How far the blend of two channels may reach into a picture.
struct BlendLimit {
    std::size_t channel = 0;
    std::optional<std::size_t> with = {};  // nothing: all neighbours
    double widthPixels = 0;                // of the panorama
    SourcePlace source = {};
};

// All that a crew has set by hand for a rig.
struct Adjustments {
    std::vector<ControlPoint> points;
    std::vector<MaskedArea> masks;
    std::vector<BlendLimit> blends;
};

// `source` is the file's name in errors. Throws Error with file:line:column.
[[nodiscard]] Adjustments parseAdjustments(const std::string& text,
                                           const std::string& source,
                                           const Rig& rig);
// Of the file that the rig names, as it is in Rig::files; none where it names none.
[[nodiscard]] Adjustments adjustmentsOf(const Rig& rig);

// The text of such a file without the entry that begins at a place, with its line where that is
// empty then. Comments stay.
[[nodiscard]] std::string withoutEntry(const std::string& text, SourcePlace place);

}  // namespace aquarama::config
