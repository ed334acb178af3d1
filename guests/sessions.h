// SPDX-License-Identifier: Apache-2.0
// Who was let in, each by a secret of 128 bits of which only the SHA-256 is kept; and the file that
// lets them and their seats survive a restart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "guests/queue.h"

namespace aquarama::guests {

class Phone;

// One visitor. Times in seconds.
struct Visit {
    static constexpr std::size_t kMostDrawings = 3;  // that its page shows
    Phone* phone = nullptr;                          // where one is connected
    double seen = 0;                                 // when it was last connected
    double mayFeed = 0, mayDraw = 0;                 // from then on
    bool isBeingRead = false;                        // a picture that it has sent
    std::string refusedDrawing = {};                 // why the last one was; empty: it was not
    std::vector<std::uint32_t> drawings = {};        // numbers, the newest last
};

// All of them, by the SHA-256 of their secrets.
class Sessions {
  public:
    static constexpr std::size_t kMost = 1500;
    // Seconds after a phone was last connected; where it has sent a drawing.
    static constexpr double kForgotten = 900, kForgottenDrawn = 4 * 3600;

    // The secret of a new one. Where there are too many, who is away longest is forgotten; nothing
    // where all of them are there.
    [[nodiscard]] std::optional<std::string> admit(double now);
    // Whose secret this is; empty: nobody's.
    [[nodiscard]] GuestId guestOf(const std::string& secret) const;
    // Nothing where there is none of this name.
    [[nodiscard]] Visit* find(const GuestId& guest);
    // Forgets those who have been away for long, and names them.
    std::vector<GuestId> forget(double now);

    // Whole or not at all: a line for each, with what is left of the turn, 0 for who has no seat,
    // "reading" where a picture is being read, and the numbers of drawings.
    void keep(const std::filesystem::path& file, const VisitorQueue& queue, double now) const;
    // What a file has; returns the seats, in their order. Damaged lines are passed over. Pictures
    // that were being read are lost, and their senders told so.
    std::vector<GuestSeat> restore(const std::filesystem::path& file, double now);

  private:
    std::map<GuestId, Visit> visits_;
};

}  // namespace aquarama::guests
