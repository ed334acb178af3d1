// SPDX-License-Identifier: Apache-2.0
// Reads and writes zip archives in memory. Archives are untrusted: the number, sizes and names of
// the entries are checked before their data are read. Nothing is written to a disk.
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

// Limits of an archive: entries, bytes of one entry, and bytes of all entries.
inline constexpr std::int64_t kMostEntries = 8192;
inline constexpr std::uint64_t kMostEntryBytes = std::uint64_t{1} << 29;
inline constexpr std::uint64_t kMostArchiveBytes = std::uint64_t{1} << 32;

// A file for an archive: its name, with '/' between folders, and its content.
using ArchiveFile = std::pair<std::string, std::vector<std::byte>>;

// A ZIP archive that is read.
class Archive {
  public:
    // `bytes` must outlive it; `source` names it in errors. Throws Error where the bytes are no
    // archive, or exceed the limits.
    Archive(std::span<const std::byte> bytes, std::string source);
    ~Archive();
    Archive(const Archive&) = delete;
    Archive& operator=(const Archive&) = delete;

    // The names of its files, without folders. They have '/' also where the archive has '\\', and
    // no "./" before them.
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    // The name of the entry that differs from this one at most by case and a "./" before it.
    [[nodiscard]] std::optional<std::string> find(std::string_view name) const;
    // Reads a file; `name` is one of names(). Throws Error where it is damaged, or where all reads
    // together exceed the limit of bytes: a manifest may name one entry a thousand times.
    [[nodiscard]] std::vector<std::byte> read(const std::string& name);

  private:
    struct Zip;
    void listNames();
    // Refuses an entry that is too large, or larger than its packed bytes can be.
    [[nodiscard]] std::uint64_t sizeToRead(std::uint64_t size, std::uint64_t packed) const;
    std::unique_ptr<Zip> zip_;
    std::string source_;
    std::vector<std::string> names_;
    std::vector<std::uint64_t> indices_;  // of the names, in the archive
    std::uint64_t readBytes_ = 0;
};

// Whether bytes begin like an archive.
[[nodiscard]] bool isArchive(std::span<const std::byte> bytes);

// Makes an archive, deflated; the same files give the same bytes. Throws Error for a name that the
// reader refuses.
[[nodiscard]] std::vector<std::byte> encodeArchive(const std::vector<ArchiveFile>& files);

// For names that ignore the case of ASCII letters.
[[nodiscard]] std::string lowered(std::string_view text);
[[nodiscard]] bool sameName(std::string_view a, std::string_view b);
// A text of a file for one line of an error: shortened, without control characters, and with bytes
// that are no UTF-8 as \xE9.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace aquarama::formats
