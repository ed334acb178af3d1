// SPDX-License-Identifier: Apache-2.0
// A zip archive in memory. Archives are untrusted: how many entries there are, what they claim to
// hold and how they are named is checked before anything of them is read. Nothing is written to a
// disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace aquarama::formats {

// The most that is read of an archive: entries, bytes of one, and bytes of all of them.
inline constexpr std::int64_t kMostEntries = 8192;
inline constexpr std::uint64_t kMostEntryBytes = std::uint64_t{1} << 29;
inline constexpr std::uint64_t kMostArchiveBytes = std::uint64_t{1} << 32;

// A file for an archive: its name, with '/' between folders, and its content.
using ArchiveFile = std::pair<std::string, std::vector<std::byte>>;

class Archive {
  public:
    // `bytes` must outlive it; `source` names it in errors. Throws Error where this is no archive,
    // or one that is refused.
    Archive(std::span<const std::byte> bytes, std::string source);
    ~Archive();
    Archive(const Archive&) = delete;
    Archive& operator=(const Archive&) = delete;

    // Of the files in it, not of folders: with '/' between them also where the archive has '\\',
    // and without "./" before them.
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    // As the entry is named that has this name but for upper and lower case and a "./" before it.
    [[nodiscard]] std::optional<std::string> find(std::string_view name) const;
    // `name` is one of names(). Throws Error where it is damaged, or where everything that was read
    // until now has too many bytes: a manifest may name one entry a thousand times.
    [[nodiscard]] std::vector<std::byte> read(const std::string& name);

  private:
    struct Zip;
    void listNames();
    // Refuses what is too much, and what deflate could not pack so.
    [[nodiscard]] std::uint64_t sizeToRead(std::uint64_t size, std::uint64_t packed) const;
    std::unique_ptr<Zip> zip_;
    std::string source_;
    std::vector<std::string> names_;
    std::vector<std::uint64_t> indices_;  // of the names, in the archive
    std::uint64_t readBytes_ = 0;
};

// Whether bytes begin as an archive does.
[[nodiscard]] bool isArchive(std::span<const std::byte> bytes);

// Deflated; the same files give the same bytes. Throws Error where a name would be refused.
[[nodiscard]] std::vector<std::byte> encodeArchive(const std::vector<ArchiveFile>& files);

// For names that ignore the case of ASCII letters.
[[nodiscard]] std::string lowered(std::string_view text);
[[nodiscard]] bool sameName(std::string_view a, std::string_view b);
// A text of a file on one line of an error: without control characters, what is no UTF-8 as \xE9,
// and not too long.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace aquarama::formats
