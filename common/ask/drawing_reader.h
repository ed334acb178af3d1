// SPDX-License-Identifier: Apache-2.0
// Pictures of coloured sheets become skins in a process of their own, which may do nothing else:
// `aquarama-drawings decode`. One is started for each picture, and killed where it takes too long.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <variant>

namespace aquarama::ask {

// What a picture shows.
struct ReadDrawing {
    std::string species;
    std::string skin;  // PNG, as common/body/side_view.h says
};

// Why there is none.
struct DrawingRefused {
    // A stable name for pages to translate: "too_large", "not_a_picture", "no_sheet",
    // "several_sheets", "too_few_corners", "other_version", "unknown_species", "not_flat",
    // "cut_off", "too_small", "too_dark" (drawings/refusal.h); "unreadable": the decoder was
    // killed, or has failed.
    std::string word;
};

// What became of a picture.
using DrawingOutcome = std::variant<ReadDrawing, DrawingRefused>;

// Of what a decoder has said, which is not believed; nothing where it makes no sense.
[[nodiscard]] std::optional<DrawingOutcome> outcomeIn(std::string_view answer);

// What is read at most, of a picture in bytes; as drawings/photo.h.
inline constexpr std::size_t kMostPictureBytes = std::size_t{16} << 20U;

// Reads one picture after another, on its own thread.
class DrawingReader {
  public:
    static constexpr std::size_t kMostWaiting = 8;  // pictures, with the one that is read

    // With the decoder beside the running program, else that of PATH. Where there is none, the log
    // says which package lacks.
    DrawingReader();
    // With another one, and so many seconds for each picture.
    explicit DrawingReader(std::filesystem::path program, double mostSeconds = kMostSeconds);
    // What still waits is dropped without an answer; the decoder that runs is killed.
    ~DrawingReader();
    DrawingReader(const DrawingReader&) = delete;
    DrawingReader& operator=(const DrawingReader&) = delete;

    // Whether there is a decoder.
    [[nodiscard]] bool isInstalled() const { return !program_.empty(); }
    // Takes a picture: `done` hears once what became of it, from the reader's thread. False: too
    // many wait, it is too large, or there is no decoder.
    [[nodiscard]] bool read(std::string picture, std::function<void(const DrawingOutcome&)> done);

  private:
    static constexpr double kMostSeconds = 20;
    struct Job {
        std::string picture;
        std::function<void(const DrawingOutcome&)> done;
    };
    void run();
    [[nodiscard]] DrawingOutcome outcomeOf(const std::string& picture);
    // As far as the decoder has said it when it ends or is killed.
    [[nodiscard]] std::string answerTo(const std::string& picture);
    [[nodiscard]] bool hasEnded();

    std::filesystem::path program_;  // empty: none
    double mostSeconds_;
    std::uint64_t failures_ = 0;  // of the decoder, since the start; of the thread
    std::mutex mutex_;            // guards what follows
    std::condition_variable changed_;
    std::deque<Job> jobs_;  // the first is being read
    bool ended_ = false;
    std::thread thread_;
};

}  // namespace aquarama::ask
