// SPDX-License-Identifier: Apache-2.0
// Reads and writes whole files: a reader sees the old file or the new one, never a part. Also names
// the folders of this user, for caches, for state and for temporary files.
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

// Writes a file by the rules of OutputFile (output_file.h). Returns when it is on the disk: a power
// cut leaves the old file or the new one. Throws Error when it cannot be written.
void writeWhole(const std::filesystem::path& path, std::span<const std::byte> content);
// The same, readable by this user only.
void writePrivate(const std::filesystem::path& path, std::span<const std::byte> content);

// Writes a file that the program can do without. Where it cannot be written, the log has one
// warning for each folder and process, which names what is lost ("fish are captured anew at each
// start"). Returns whether it was written. Any thread.
bool keepIfPossible(const std::filesystem::path& path,
                    std::span<const std::byte> content,
                    const std::string& loss);
// Logs that warning, for a file that is written in another way.
void warnOnceOf(const std::filesystem::path& folder,
                const std::string& problem,
                const std::string& loss);

// Removes files of a folder: those older than `mostAge`, and the least recently used until
// `mostBytes` are left. The time of the last write counts as last use. Files that cannot be removed
// stay.
void trimFolder(const std::filesystem::path& folder,
                std::uintmax_t mostBytes,
                std::chrono::hours mostAge);
// Marks a file of such a folder as used.
void markUsed(const std::filesystem::path& path);

// A temporary folder aquarama.PURPOSE.LETTERS, removed with the object. The process holds a lock on
// it, so that removeLeftFolders() can tell folders in use from those of killed processes.
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

// Files that appear in a folder together: they are written into aside(), and settle() renames what
// is there into the folder. Without settle() the folder stays as it was.
class ArrivingFiles {
  public:
    // Creates the folder where it is missing. Throws Error where no file can be written into it.
    explicit ArrivingFiles(std::filesystem::path folder);
    ~ArrivingFiles();
    ArrivingFiles(const ArrivingFiles&) = delete;
    ArrivingFiles& operator=(const ArrivingFiles&) = delete;
    // A folder within the folder.
    [[nodiscard]] const std::filesystem::path& aside() const { return aside_; }
    // Throws Error where a name is a folder's there already.
    void settle() const;

  private:
    std::filesystem::path folder_, aside_;
};

// Free bytes for this user on the disk of a path, which need not exist yet; 0 where unknown.
[[nodiscard]] std::uint64_t freeBytesAt(std::filesystem::path path);

// A folder "aquarama" of this user, by the XDG base directories: in the folder that the environment
// `variable` names, else in `underHome` of the home folder, else in the folder for temporary files.
[[nodiscard]] std::filesystem::path userFolder(const char* variable, const char* underHome);
// The folder for data that can be computed again.
[[nodiscard]] std::filesystem::path cacheFolder();

}  // namespace aquarama
