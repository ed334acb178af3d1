// SPDX-License-Identifier: Apache-2.0
// The file that one part of a work leaves, and the check that parts make a whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/base/digest.h"
#include "common/parts/part.h"

namespace aquarama::parts {

// The works that are done in parts. The values are part of the file's format.
enum class WorkKind : std::uint8_t { Capture, Study, Search, Clip };
inline constexpr std::size_t kWorkKinds = 4;
// "capture", "study", "search", "clip".
[[nodiscard]] const char* nameOf(WorkKind kind);

// What is computed: parts fit together where all of this is the same.
struct WorkName {
    WorkKind kind = WorkKind::Capture;
    // Version and commit of the program.
    std::string build;
    // Of everything that the result follows from: files and options.
    Digest inputs;
    // arithmeticOfThisMachine().
    std::uint64_t arithmetic = 0;
    // Number of parts.
    std::uint32_t of = 1;
};

// A hash over values of the C library's functions: it differs where two machines' sines do, as they
// may in the last bit.
[[nodiscard]] std::uint64_t arithmeticOfThisMachine();

// A part that is done. What the content is is known to the command that wrote it.
struct FinishedPart {
    WorkName work;
    std::uint32_t number = 1;
    std::vector<std::byte> content;
    // The file that it was read from.
    std::string path = {};
};

// The bytes of the file, with their SHA-256 at the end.
[[nodiscard]] std::vector<std::byte> encodePart(const FinishedPart& part);
// Throws Error, which begins with `path`, where it is no part, of another version of the format, or
// damaged. Takes no more memory than the bytes.
[[nodiscard]] FinishedPart decodePart(std::span<const std::byte> bytes, const std::string& path);

// Parts of this size are read at most: all repertoires that a scene may have take less.
inline constexpr std::uintmax_t kMostPartBytes = std::uintmax_t{1} << 30U;

// Reads parts and returns them in order. Throws Error, which names the file, where one cannot be
// read, belongs to another work than the first or was made by another build than `build`, and where
// one is there twice or missing.
[[nodiscard]] std::vector<FinishedPart> readWork(const std::vector<std::string>& paths,
                                                 const std::string& build);

// Identifies a file of any size: the digest of the digests of its pieces. Throws Error where it
// cannot be read.
[[nodiscard]] Digest digestOfFile(const std::string& path);

}  // namespace aquarama::parts
