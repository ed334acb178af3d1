// SPDX-License-Identifier: Apache-2.0
// How every file is written. Links are followed, also one to a file that is not there yet. What is
// no regular file (a FIFO, a device, /dev/stdout) is written straight into. A file that is there
// keeps its mode and its owner. Whatever fails is an Error of one line: what, why, what to do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace aquarama {

// "cannot be written (No space left on device); make room there, ...": of a number of errno.
[[nodiscard]] std::string whyNotWritten(int error);

// Throws Error where OutputFile would, as far as can be told now, and changes nothing: no FIFO is
// opened, as its reader would see an end.
void requireWritable(const std::filesystem::path& file);
// The same for a new file in a folder, which is made where it is missing.
void requireWritableFolder(const std::filesystem::path& folder);

// Of a new file; an old one keeps its mode, but nobody else may read what is Private.
enum class FileAccess : std::uint8_t { Usual, Private };
// Durable: finish() returns when the disk has the file, so that a power cut leaves the old content
// or the new. Quick: for what can be made again.
enum class FileSafety : std::uint8_t { Durable, Quick };

// A file that appears whole or not at all: it is written beside its place as NAME.PID.NUMBER.part,
// and renamed. Where that would change more than the content (other names of the file, its owner,
// its access list) or cannot be (a folder that is read-only), it is written in its place. Parts
// that ended processes have left are removed by the next writer of the file. One thread uses it.
class OutputFile {
  public:
    // Makes the folder of the file where there is none. Waits some seconds where a
    // FIFO has no reader yet.
    explicit OutputFile(std::filesystem::path path,
                        FileAccess access = FileAccess::Usual,
                        FileSafety safety = FileSafety::Durable);
    // Without finish(): the file is as it was before.
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    // Takes the room that the content needs, where the old content would else be lost before the
    // disk is found to be full.
    void reserve(std::uint64_t bytes);
    // At the end of what was written.
    void write(std::span<const std::byte> content);
    // Only where canSeek().
    void writeAt(std::uint64_t offset, std::span<const std::byte> content);
    [[nodiscard]] bool canSeek() const { return isRegular_; }
    // The file that grows: the part, or its place.
    [[nodiscard]] const std::filesystem::path& writtenPath() const {
        return part_.empty() ? target_ : part_;
    }
    // Once, after the last write.
    void finish();

  private:
    void cutToLength();
    [[nodiscard]] bool openPart(FileAccess access);
    [[nodiscard]] bool keepIdentity(FileAccess access) const;
    void putInPlace();
    void copyIntoPlace();
    [[noreturn]] void refuse(int error) const;

    std::filesystem::path path_;    // as it was named
    std::filesystem::path target_;  // where its links lead
    std::filesystem::path part_;    // empty: written in its place
    FileSafety safety_;
    int file_ = -1;
    bool isRegular_ = true;      // of what is written
    bool isThere_ = false;       // the target, before
    bool isRenamed_ = true;      // the part may take the target's place
    std::uint64_t written_ = 0;  // bytes
};

// A file that grows by whole entries, each of which is handed to the system at once: however the
// program ends, and when the disk is full, the file is whole up to its last entry. One thread uses
// it.
class GrowingFile {
  public:
    static constexpr std::uint64_t kAll = UINT64_MAX;

    GrowingFile() = default;  // writes nothing
    // The first `keptBytes` of a file that is there stay. Makes its folder where there is none.
    explicit GrowingFile(std::filesystem::path path, std::uint64_t keptBytes = 0);
    ~GrowingFile();
    GrowingFile(const GrowingFile&) = delete;
    GrowingFile& operator=(const GrowingFile&) = delete;
    GrowingFile(GrowingFile&& other) noexcept { *this = std::move(other); }
    GrowingFile& operator=(GrowingFile&& other) noexcept;

    // Whether entries reach a file.
    [[nodiscard]] bool isOpen() const { return file_ >= 0; }
    // Nothing where it is not open. Where it throws, the entry is not in the file, which is closed.
    void append(std::span<const std::byte> entry);
    void append(std::string_view entry);
    // The same in a loop that nothing may stop: what append() would throw is an error in the log,
    // and thrown by close().
    void appendOrLog(std::span<const std::byte> entry);
    void appendOrLog(std::string_view entry);
    // When the disk has all of it. Throws Error where an entry is missing.
    void close();

  private:
    std::filesystem::path path_;
    int file_ = -1;
    std::string failure_;
};

}  // namespace aquarama
