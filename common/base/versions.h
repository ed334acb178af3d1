// SPDX-License-Identifier: Apache-2.0
// Earlier versions of a file, in a folder beside it: those of hall.mpcdi in hall.history. A power
// cut leaves the file and each version either unchanged or complete.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace aquarama {

// One earlier version of a file.
struct FileVersion {
    std::string name;  // when it was kept, in UTC: "2026-11-24T210301"
    std::filesystem::path path;
    std::string note;  // what was said of it; may be empty
    bool isInUse = false;
};

// The number of versions that are kept. Beyond it the oldest is removed, but never the one in use.
inline constexpr std::size_t kMostVersions = 30;

// The versions of a file, the newest first. Throws Error where the file or a version cannot be
// read.
[[nodiscard]] std::vector<FileVersion> versionsOf(const std::filesystem::path& file);

// Keeps the present content as a version. A version that is already kept gets the note, unless it
// is empty. Throws Error where it cannot be read or written.
void keepVersion(const std::filesystem::path& file, const std::string& note);

// Replaces the file by a version; the present content is kept first. Throws Error as keepVersion()
// does.
void useVersion(const std::filesystem::path& file, const FileVersion& version);

}  // namespace aquarama
