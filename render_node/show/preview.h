// SPDX-License-Identifier: Apache-2.0
// Pictures of a channel for the operator's console, and answers to what it asks of them: beside the
// frames, never before one.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <glm/vec2.hpp>

#include "common/base/units.h"
#include "common/net/channels.h"
#include "common/wire/state_codec.h"
#include "render_node/gl/handle.h"

namespace aquarama::show {

// A small copy of what a projector got.
struct ReducedPicture {
    glm::ivec2 sizePixels{};
    std::vector<std::uint8_t> rgba;  // sRGB codes of 8 bits, bottom row first
};

// Fetches a small copy of a picture from the GPU without waiting for it: begun after a frame, taken
// frames later. Owns GL objects; used and destroyed with the same workspace current.
class PictureReader {
  public:
    // As wide as asked for, in the picture's proportions, never wider than it. Not while one is on
    // its way.
    void begin(const gl::Target& from, int widthPixels);
    [[nodiscard]] bool isBusy() const { return fence_ != nullptr; }
    // Empty while the GPU still writes it, and where none was begun.
    [[nodiscard]] std::optional<ReducedPicture> take();
    PictureReader() = default;
    ~PictureReader();
    PictureReader(const PictureReader&) = delete;
    PictureReader& operator=(const PictureReader&) = delete;

  private:
    std::optional<gl::Target> reduced_;
    std::optional<gl::Buffer> pixels_;
    GLsync fence_ = nullptr;
};

// JPEG of at most wire::kMostJpegBytes, of quality 75 or as little less as that takes. Throws Error
// where the encoder fails.
[[nodiscard]] std::string encodeJpeg(const ReducedPicture& picture);

// What the console asks of a picture: which fish is at this place, as shares of its size from the
// top left corner.
struct FishQuestion {
    std::uint64_t number = 0;
    Frame frame;
    glm::vec2 place{};
};

// A node's link to the console, on a thread of low priority that also encodes. The drawing thread
// calls the functions below; none of them waits.
class ConsoleLink {
  public:
    // Throws Error where the address is malformed.
    ConsoleLink(std::string channel,
                const std::string& watchAddress,
                const std::optional<net::PeerKeys>& keys);
    ~ConsoleLink();
    ConsoleLink(const ConsoleLink&) = delete;
    ConsoleLink& operator=(const ConsoleLink&) = delete;

    // The width of a picture that is asked for: at most five times a second, and not while the last
    // one is encoded. Empty where nobody looks.
    [[nodiscard]] std::optional<int> wantedWidth();
    void put(Frame frame, ReducedPicture picture);
    [[nodiscard]] std::optional<FishQuestion> nextQuestion();
    void answer(const FishQuestion& question, Frame frame, std::optional<std::uint32_t> fish);

  private:
    struct Taken {
        std::uint64_t number = 0;
        Frame frame;
        ReducedPicture picture;
    };
    void run();
    void hear(const net::ByteVector& bytes);
    void sayWhatIsThere();

    std::string channel_;
    std::unique_ptr<net::NodeChannels> channels_;
    std::atomic<bool> ended_ = false;
    std::mutex mutex_;                                      // guards all below but the thread
    std::optional<std::pair<std::uint64_t, int>> request_;  // number, width
    net::Instant requestedAt_{}, lastPicture_{};
    std::uint64_t beingMade_ = 0;  // its number; 0: none
    std::optional<Taken> taken_;
    std::deque<FishQuestion> questions_;
    std::deque<wire::Packet> answers_;
    std::thread thread_;
};

}  // namespace aquarama::show
