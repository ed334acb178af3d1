// SPDX-License-Identifier: Apache-2.0
// Reads and writes portable float maps, and converts their numbers in each profile of MPCDI.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/formats/vendors.h"
#include "common/formats/wall_file.h"

namespace aquarama::formats {

// The contents of a file.
struct Pfm {
    glm::ivec2 size{};
    std::vector<glm::vec3> texels;  // bottom row first
    double scale = 1;               // of the header, without its sign; not applied
};

// Reads both byte orders, and any white space between the parts of the header. Throws Error, which
// names the source, where the header is wrong or does not fit the number of bytes, before it
// allocates; at most 16384 texels each way.
[[nodiscard]] Pfm decodePfm(std::span<const std::byte> bytes, const std::string& source);
// Writes "PF\nW H\n-1.000000\n" and the texels, little-endian and exact.
[[nodiscard]] std::vector<std::byte> encodePfm(const Pfm& pfm);

// The remark about a scale that is not 1, which other tools may apply; empty: none.
[[nodiscard]] std::string scaleRemark(const Pfm& pfm);

// The map upside down: the first row becomes the last.
void turnOver(Pfm& pfm);

// The meaning of the texels of a map.
struct TexelMeaning {
    Profile profile = Profile::Content;
    glm::dvec2 corner{0, 0}, extent{1, 1};  // of the channel (Content), from the top left
    double unitMetres = 1;                  // Screen
    Stored stored = Stored::Places;
    Sampling sampling = Sampling::Centres;
};

// Sets `stored` and `sampling` by the values themselves, as files of other programs do not say it:
// values of Content that cover the channel's part of the buffer are of the whole buffer; values of
// a View around zero are offsets from a grid of nodes.
void guessMeaning(TexelMeaning& meaning, const Pfm& pfm);

// Texels are unlit where red or green is no finite number, or all three are zero to 1e-5; the third
// counts for the Screen alone.
[[nodiscard]] Warp warpOf(Pfm pfm, const TexelMeaning& meaning);
// The texels that the warp was read from, where they still give its samples. Else texels for which
// warpOf() gives the same samples, or the nearest that floats can express: at most 2^-24 of the
// picture or buffer away. A texel that would be zero, and so unlit, becomes 1e-4.
[[nodiscard]] Pfm pfmOf(const Warp& warp, const TexelMeaning& meaning);

// A map without a manifest is the warp of one channel. It has points of the screen where third
// numbers are used and numbers lie outside a picture; else places of the picture of the frustum, or
// of content where there is no frustum.
[[nodiscard]] bool isPfm(std::span<const std::byte> bytes);
[[nodiscard]] WallFile readPfm(std::span<const std::byte> bytes,
                               const std::string& source,
                               const ReadOptions& options,
                               const FrustumFile& frustum = {});

}  // namespace aquarama::formats
