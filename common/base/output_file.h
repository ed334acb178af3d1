// SPDX-License-Identifier: Apache-2.0
// The one way to write files. Links are followed, also to a file that does not exist yet. A FIFO, a
// device or /dev/stdout is written directly. An existing file keeps its mode and owner. Failures
// throw an Error of one line: what, why, what to do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace aquarama {

// The message for a value of errno: "cannot be written (No space left on device); make room there,
// ...".
[[nodiscard]] std::string whyNotWritten(int error);

// Checks, without any change, whether a file can be written. Throws Error where OutputFile would,
// as far as that is known now. Does not open a FIFO, since its reader would see the end.
void requireWritable(const std::filesystem::path& file);
// The same for a new file in a folder. Creates the folder where it is missing.
void requireWritableFolder(const std::filesystem::path& folder);

// Who may read a new file. An existing file keeps its mode, but Private always excludes other
// users.
enum class FileAccess : std::uint8_t { Usual, Private };
// Durable: finish() returns when the file is on the disk, so that a power cut leaves the old
// content or the new. Quick: for data that can be computed again.
enum class FileSafety : std::uint8_t { Durable, Quick };

// A file that appears complete or not at all: it is written as NAME.PID.NUMBER.part beside its
// target, then renamed. It is written in place where a rename would lose hard links, owner or
// access list, or where the folder is read-only. The next writer removes parts that ended processes
// have left. One thread uses it.
class OutputFile {
  public:
    // Creates the folder of the file where it is missing. Waits some seconds for the reader of a
    // FIFO.
    explicit OutputFile(std::filesystem::path path,
                        FileAccess access = FileAccess::Usual,
                        FileSafety safety = FileSafety::Durable);
    // Without finish(), the old file stays unchanged.
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    // Reserves disk space for the content. Otherwise a full disk would be found only after the old
    // content is lost.
    void reserve(std::uint64_t bytes);
    // Appends to what was written.
    void write(std::span<const std::byte> content);
    // Overwrites bytes at a place. Only where canSeek().
    void writeAt(std::uint64_t offset, std::span<const std::byte> content);
    [[nodiscard]] bool canSeek() const { return isRegular_; }
    // The path of the file that is being written: the part, or the target.
    [[nodiscard]] const std::filesystem::path& writtenPath() const {
        return part_.empty() ? target_ : part_;
    }
    // Completes the file. Call it once, after the last write.
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

// A file that grows by whole entries, each written with one system call. Whether the program is
// killed or the disk is full, the file ends with a complete entry. One thread uses it.
class GrowingFile {
  public:
    static constexpr std::uint64_t kAll = UINT64_MAX;

    GrowingFile() = default;  // writes nothing
    // Keeps the first `keptBytes` of an existing file. Creates the folder where it is missing.
    explicit GrowingFile(std::filesystem::path path, std::uint64_t keptBytes = 0);
    ~GrowingFile();
    GrowingFile(const GrowingFile&) = delete;
    GrowingFile& operator=(const GrowingFile&) = delete;
    GrowingFile(GrowingFile&& other) noexcept { *this = std::move(other); }
    GrowingFile& operator=(GrowingFile&& other) noexcept;

    // Whether entries reach a file.
    [[nodiscard]] bool isOpen() const { return file_ >= 0; }
    // Appends an entry; does nothing where the file is not open. Throws Error where it cannot be
    // written: the entry is then not in the file, which is closed.
    void append(std::span<const std::byte> entry);
    void append(std::string_view entry);
    // The same for loops that must not stop: an error goes to the log, and close() throws it later.
    void appendOrLog(std::span<const std::byte> entry);
    void appendOrLog(std::string_view entry);
    // Returns when all entries so far are on the disk. False: they are not.
    [[nodiscard]] bool sync();
    // Returns when all entries are on the disk. Throws Error where one is missing.
    void close();

  private:
    std::filesystem::path path_;
    int file_ = -1;
    std::string failure_;
};

}  // namespace aquarama
