// SPDX-License-Identifier: Apache-2.0
// One of the parts of a long computation that several machines share: which it is, and which units
// of the work are its.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace aquarama::parts {

// Part `number` of `of`, counted from 1.
struct Part {
    std::uint32_t number = 1, of = 1;
    friend bool operator==(const Part&, const Part&) = default;
};
// Into so many parts a work is divided at most.
inline constexpr std::uint32_t kMostParts = 10000;

// "2/5": the second of five. Throws Error for anything else.
[[nodiscard]] Part parsePart(const std::string& text);
// The name of the file of a part: "film.mp4" or "repertoires/" becomes
// "film.mp4.2-of-5.aqpart", beside what the whole work writes.
[[nodiscard]] std::string partPath(std::string out, Part part);

// Units of work from `first` up to `last`, which is not among them.
struct UnitRange {
    std::size_t first = 0, last = 0;
    friend bool operator==(const UnitRange&, const UnitRange&) = default;
};
// The units of one part of a work of so many: each unit is in one part, in order, and parts differ
// by one unit at most. Parts beyond the number of units are empty.
[[nodiscard]] UnitRange unitsOf(Part part, std::size_t units);

// A clip is encoded in pieces of so many pictures, each by itself: they are the units of its parts.
// Even, as the noise of a picture's last bit changes with the parity of the frame.
inline constexpr std::uint32_t kPicturesOfPiece = 60;

}  // namespace aquarama::parts
