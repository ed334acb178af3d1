// SPDX-License-Identifier: Apache-2.0
// Whole files: read up to a limit, written so that a reader sees the old file or the new one, never
// a part. Folders of this user: for what is kept, and for the time of a work.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace aquarama {

// The content of a file of at most `mostBytes`. Throws Error when it is larger or cannot be read.
[[nodiscard]] std::vector<std::byte> readWhole(const std::filesystem::path& path,
                                               std::uintmax_t mostBytes);

// By the rules of OutputFile (output_file.h). Returns when the disk has it: a power cut leaves the
// old file or the new one. Throws Error when it cannot be written.
void writeWhole(const std::filesystem::path& path, std::span<const std::byte> content);
// The same, and nobody but this user may read it.
void writePrivate(const std::filesystem::path& path, std::span<const std::byte> content);

// What only saves time, or is only told: where it cannot be written, a warning says so, once for
// each folder of a process, with what is lost ("fish are captured anew at each start"), and the
// work goes on. Whether it was written. From any thread.
bool keepIfPossible(const std::filesystem::path& path,
                    std::span<const std::byte> content,
                    const std::string& loss);
// That warning, for a file that is written otherwise.
void warnOnceOf(const std::filesystem::path& folder,
                const std::string& problem,
                const std::string& loss);

// Files of a folder that were not used for longest are removed until `mostBytes` are left, and
// those older than `mostAge`. The time of last write counts as that of last use. What cannot be
// removed stays.
void trimFolder(const std::filesystem::path& folder,
                std::uintmax_t mostBytes,
                std::chrono::hours mostAge);
// Marks a file of such a folder as used.
void markUsed(const std::filesystem::path& path);

// A folder for the time of a work, in that for temporary files: aquarama.PURPOSE.LETTERS. It goes
// with the object. Folders that killed processes have left are removed at the next start of any
// program (removeLeftFolders()): the process that uses one holds a lock on it.
class TemporaryFolder {
  public:
    // Throws Error where it cannot be made.
    explicit TemporaryFolder(const std::string& purpose);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    int lock_ = -1;
};
// Removes the temporary folders that killed processes have left. Called when a program starts.
void removeLeftFolders();

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
