// SPDX-License-Identifier: Apache-2.0
// Pictures of a channel for whoever watches the wall, the operator's console and visitors' phones,
// and answers to their questions. They never delay a frame.
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

// A small copy of a projector's picture.
struct ReducedPicture {
    glm::ivec2 sizePixels{};
    std::vector<std::uint8_t> rgba;  // sRGB codes of 8 bits, bottom row first
};

// Whether nothing in it can be seen: no code is above 1, which the dither of black may be.
[[nodiscard]] bool isBlack(const ReducedPicture& picture);

// Reads a small copy of a picture from the GPU without waiting: it is started after a frame and
// taken some frames later. Owns GL objects; use and destroy it with the same workspace current.
class PictureReader {
  public:
    // Starts a copy of this width, in the picture's proportions and never wider than it. Not while
    // isBusy().
    void begin(const gl::Target& from, int widthPixels);
    [[nodiscard]] bool isBusy() const { return fence_ != nullptr; }
    // The copy; empty while the GPU still writes it, and where none was started.
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

// A JPEG of at most wire::kMostJpegBytes, of quality 75 or the next lower one that fits. Throws
// Error where the encoder fails.
[[nodiscard]] std::string encodeJpeg(const ReducedPicture& picture);

// A question of a watcher: which fish is at this place of a picture, as shares of its size from
// the top left corner.
struct FishQuestion {
    std::uint64_t number = 0;
    Frame frame;
    glm::vec2 place{};
};

// A node's link to one watcher, on a thread of low priority that also encodes. The drawing thread
// calls the functions below; none of them waits.
class WatcherLink {
  public:
    // Throws Error where the address is malformed.
    WatcherLink(std::string channel,
                const std::string& watchAddress,
                const std::optional<net::PeerKeys>& keys);
    ~WatcherLink();
    WatcherLink(const WatcherLink&) = delete;
    WatcherLink& operator=(const WatcherLink&) = delete;

    // The width of the picture that is asked for; empty where none is. At most
    // five times a second, and not while the last picture is encoded.
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
    std::mutex mutex_;  // guards all members below, except the thread
    std::optional<std::pair<std::uint64_t, int>> request_;  // number, width
    net::Moment requestedAt_{}, lastPicture_{};
    std::uint64_t beingMade_ = 0;  // number of the picture; 0: none
    std::optional<Taken> taken_;
    std::deque<FishQuestion> questions_;
    std::deque<wire::Packet> answers_;
    std::thread thread_;
};

}  // namespace aquarama::show
