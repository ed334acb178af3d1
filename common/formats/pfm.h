// SPDX-License-Identifier: Apache-2.0
// Portable float maps, and what their numbers say in each profile of MPCDI.
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

// A map as its file has it.
struct Pfm {
    glm::ivec2 size{};
    std::vector<glm::vec3> texels;  // bottom row first
    double scale = 1;               // as the header has it, without its sign; not applied
};

// Takes both byte orders, and any white space between the parts of the header. Throws Error, which
// names the source, where the header is none or promises other bytes than there are, before it
// takes memory; at most 16384 texels each way.
[[nodiscard]] Pfm decodePfm(std::span<const std::byte> bytes, const std::string& source);
// "PF\nW H\n-1.000000\n" and the texels, little-endian, every bit of them.
[[nodiscard]] std::vector<std::byte> encodePfm(const Pfm& pfm);

// What is to be said of a scale that is not 1, which other tools may apply; empty: nothing.
[[nodiscard]] std::string scaleRemark(const Pfm& pfm);

// The other way round: the first row becomes the last.
void turnOver(Pfm& pfm);

// How the texels of a map are to be understood.
struct TexelMeaning {
    Profile profile = Profile::Content;
    glm::dvec2 corner{0, 0}, extent{1, 1};  // of the channel (Content), from the top left
    double unitMetres = 1;                  // Screen
    Stored stored = Stored::Places;
    Sampling sampling = Sampling::Centres;
};

// Sets `stored` and `sampling` to what the values themselves tell, as the files of others do not
// say it: values of Content that lie as the channel does in the buffer are of the whole buffer;
// those of a View about zero are offsets, from a grid of nodes.
void guessMeaning(TexelMeaning& meaning, const Pfm& pfm);

// Texels are unlit where red or green is no finite number, or all three are zero to 1e-5; the third
// counts for the Screen alone.
[[nodiscard]] Warp warpOf(Pfm pfm, const TexelMeaning& meaning);
// The texels that the warp was read from, where they still give its samples; else such that
// warpOf() gives the same samples where floats of this meaning can say them, else the nearest that
// they can, 2^-24 of the picture or the buffer away at most. What would come out as zero, and so as
// unlit, is moved to 1e-4.
[[nodiscard]] Pfm pfmOf(const Warp& warp, const TexelMeaning& meaning);

// A map alone is the warp of one channel: points of the screen where its third numbers are any and
// numbers reach beyond a picture, else places of the picture of the frustum, or of content where
// there is none.
[[nodiscard]] bool isPfm(std::span<const std::byte> bytes);
[[nodiscard]] WallFile readPfm(std::span<const std::byte> bytes,
                               const std::string& source,
                               const ReadOptions& options,
                               const FrustumFile& frustum = {});

}  // namespace aquarama::formats
