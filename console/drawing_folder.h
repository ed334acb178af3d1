// SPDX-License-Identifier: Apache-2.0
// A folder where a scanner or a mail program puts pictures of sheets: each is offered, and removed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "common/ask/order_book.h"

namespace aquarama::console {

// Where pictures go, and where one hears what became of them.
struct PictureTaker {
    // Begins to read and offer a picture; the number of its command. 0: not now.
    std::function<std::uint64_t(const std::string& name, std::string picture)> take;
    // Null: it is not known.
    std::function<const ask::Answer*(std::uint64_t command)> answerTo;
    // Says that a picture is refused, and why.
    std::function<void(const std::string& name, const std::string& why)> refuse;
};

// Of the server's thread; what touches the disk is done on a thread of its own. One picture at a
// time, the oldest first: it is removed when its drawing was offered, and goes to the subfolder
// `refused` where it was refused, of which the last hundred stay. Names that begin with a dot,
// links and folders are passed over.
class DrawingFolder {
  public:
    static constexpr std::size_t kMostRefused = 100;

    DrawingFolder(std::filesystem::path folder, PictureTaker taker)
        : folder_{std::move(folder)}, taker_{std::move(taker)} {}

    // Ten times a second. `isOpen`: drawings may be offered now; else pictures lie where they are.
    void tick(bool isOpen);
    // Why pictures are not taken, with what to do; empty: nothing is wrong.
    [[nodiscard]] const std::string& problem() const { return problem_; }

  private:
    // What tells whether somebody still writes a file.
    using FileState = std::pair<std::uintmax_t, std::filesystem::file_time_type>;
    using Seen = std::map<std::string, FileState>;
    // What an errand to the disk has found or done.
    struct Result {
        std::string problem = {};
        Seen seen = {};
        std::string name = {}, picture = {};  // of a file that is complete; empty: none is
    };
    static Seen seenIn(const std::filesystem::path& folder);
    static Result lookInto(const std::filesystem::path& folder, const Seen& before);
    static Result takeAway(const std::filesystem::path& folder,
                           const std::string& name,
                           bool isRefused);
    [[nodiscard]] bool isDue(bool isOpen) const;
    void begin();  // an errand
    void hear(Result result);
    void offer(Result found);
    void follow();

    std::filesystem::path folder_;
    PictureTaker taker_;
    std::string problem_;
    Seen seen_;
    std::string name_;           // of the file that is under way; empty: none is
    std::uint64_t command_ = 0;  // that offers it; 0: its end is known
    bool isRefused_ = false;
    int ticksToLook_ = 0;
    std::future<Result> errand_;
};

}  // namespace aquarama::console
