// SPDX-License-Identifier: Apache-2.0
// Frames of a channel on their way to a clip, through a named pipe: nothing waits on the disk, and
// whoever draws waits for whoever encodes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "common/wall/picture.h"

namespace aquarama::wall {

// A file that is open; closed with its owner.
class OpenFile {
  public:
    explicit OpenFile(int descriptor) : descriptor_{descriptor} {}
    ~OpenFile();
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    [[nodiscard]] int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
};

struct PipedFrame {
    std::uint64_t frame = 0;
    Picture picture;  // 8 bits
};

// folder/NAME, where the frames of a channel pass.
[[nodiscard]] std::filesystem::path framePipe(const std::filesystem::path& folder,
                                              const std::string& channel);

class FramePipeWriter {
  public:
    // Waits until somebody reads. Throws Error where nobody does.
    explicit FramePipeWriter(const std::filesystem::path& pipe);
    // Waits until there is room. Throws Error when the reader has gone.
    void write(std::uint64_t frame, const Picture& picture);

  private:
    void writeAll(std::span<const std::uint8_t> bytes) const;
    OpenFile file_;
    std::vector<std::uint8_t> codes_;
};

class FramePipeReader {
  public:
    // Throws Error where there is no such pipe.
    explicit FramePipeReader(const std::filesystem::path& pipe);
    // Waits for it; nothing when the writer has closed its end, be it in the middle of a frame.
    // Throws Error where a frame has not this size.
    [[nodiscard]] std::optional<PipedFrame> read(glm::ivec2 sizePixels);

  private:
    [[nodiscard]] bool readAll(std::span<std::uint8_t> bytes) const;
    std::string name_;
    OpenFile file_;
    std::vector<std::uint8_t> codes_;
};

}  // namespace aquarama::wall
