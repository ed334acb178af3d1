// SPDX-License-Identifier: Apache-2.0
// Whole files: read up to a limit, written so that a reader sees the old file or the new one, never
// a part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace aquarama {

// The content of a file of at most `mostBytes`. Throws Error when it is larger or cannot be read.
[[nodiscard]] std::vector<std::byte> readWhole(const std::filesystem::path& path,
                                               std::uintmax_t mostBytes);

// Writes a temporary file beside it and renames that. Makes the folder of the file where there is
// none. Throws Error when it cannot be written.
void writeWhole(const std::filesystem::path& path, std::span<const std::byte> content);

// The same, and returns when the disk has it: a power cut leaves the old file or the new one.
void writeDurably(const std::filesystem::path& path, std::span<const std::byte> content);

// What this user may still write on the disk of a path, which need not be there yet; 0 where it
// cannot be told.
[[nodiscard]] std::uint64_t freeBytesAt(std::filesystem::path path);

// A folder of this user for our files, after the XDG base directories: the environment's `variable`
// or else `underHome` in the home folder, and "aquarama" in that; in the folder for temporary files
// where neither is set.
[[nodiscard]] std::filesystem::path userFolder(const char* variable, const char* underHome);
// For data that can be made again.
[[nodiscard]] std::filesystem::path cacheFolder();

}  // namespace aquarama
