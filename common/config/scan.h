// SPDX-License-Identifier: Apache-2.0
// A scan of a wall: the patterns that its channels show, and the pictures that a camera takes of
// them.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace aquarama::config {

// The bit of a channel (its index in the rig, below 64) in a set of channels.
[[nodiscard]] constexpr std::uint64_t bitOf(std::size_t channel) {
    assert(channel < 64);
    return std::uint64_t{1} << channel;
}
[[nodiscard]] constexpr bool contains(std::uint64_t channels, std::size_t channel) {
    return (channels & bitOf(channel)) != 0;
}

// The pattern that the channels show in one picture, in the projectors' own pixels, without warp,
// blend and correction. common/wall/scan_pattern.h has the formula.
struct ScanPattern {
    // What a pattern is for.
    enum class Kind : std::uint8_t {
        Level = 1,    // even light
        GrayColumns,  // a bit of the Gray code of the column
        GrayRows,
        PhaseColumns,  // a cosine along the columns
        PhaseRows,
        Room,  // black; the screen's outline is lit by the lamps of the room
        Dots   // step 0: all dots; step n: those with bit n - 1 in their number
    };
    Kind kind = Kind::Level;
    // Gray: the bit, the coarsest is 0. Phase: the step, of kScanPhaseSteps. Level: the exposure is
    // 4^-step of the others'.
    std::uint8_t step = 0;
    std::uint16_t finestPixels = 16;  // width of the finest stripe of the Gray code
    bool inverse = false;             // Gray: dark and lit are swapped
    glm::vec3 light{1};               // linear, of the lit parts
    std::uint64_t lit = 0;            // the set of channels that show it; the others are black
    std::uint16_t number = 0;         // of the picture in its scan, shown in its tag
    bool tagged = true;

    friend bool operator==(const ScanPattern&, const ScanPattern&) = default;
};

// Whether the pattern is a level without light.
[[nodiscard]] inline bool isBlack(const ScanPattern& pattern) {
    return pattern.kind == ScanPattern::Kind::Level &&
           (pattern.lit == 0 || pattern.light == glm::vec3(0));
}
[[nodiscard]] constexpr bool isGray(ScanPattern::Kind kind) {
    return kind == ScanPattern::Kind::GrayColumns || kind == ScanPattern::Kind::GrayRows;
}
[[nodiscard]] constexpr bool isPhase(ScanPattern::Kind kind) {
    return kind == ScanPattern::Kind::PhaseColumns || kind == ScanPattern::Kind::PhaseRows;
}
// Whether the pattern changes only from row to row, so that it measures rows.
[[nodiscard]] constexpr bool isOfRows(ScanPattern::Kind kind) {
    return kind == ScanPattern::Kind::GrayRows || kind == ScanPattern::Kind::PhaseRows;
}

// A place of the camera. Lens, exposure and focus are the same in all its pictures.
struct ScanCamera {
    // How a camera's numbers follow from light.
    enum class Response : std::uint8_t { Srgb = 1, Linear };
    Response response = Response::Srgb;
    std::optional<double> focalPixels = {};  // about
};

// A picture of a scan.
struct ScanPicture {
    std::string file;  // in the folder of the scan
    std::uint32_t camera = 0;
    double exposureSeconds = 1;
    std::uint64_t frame = 0;  // of the show; 0: not known
    ScanPattern pattern;
};

// A whole scan, as scan.txtpb has it.
struct Scan {
    std::string rig;  // its name
    std::vector<ScanCamera> cameras;
    std::vector<ScanPicture> pictures;
};

// To and from scan.txtpb, where channels have names; `channels` has the names in the rig's order.
// Throws Error with file:line:column.
[[nodiscard]] Scan parseScan(const std::string& text,
                             const std::string& source,
                             const std::vector<std::string>& channels);
[[nodiscard]] std::string textOf(const Scan& scan, const std::vector<std::string>& channels);

}  // namespace aquarama::config
