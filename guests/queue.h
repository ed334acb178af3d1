// SPDX-License-Identifier: Apache-2.0
// The line of visitors who want to steer: one of them is the pilot, for a turn. A value without
// clock and socket: times are seconds of the caller's clock, which only goes on.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace aquarama::guests {

// Who is in the line: the name of a session.
using GuestId = std::string;

// Seconds.
struct QueueTimes {
    double turn = 60;
    double rest = 1;   // between two pilots, without a hand at the helm
    double held = 45;  // how long a seat is kept for somebody who is away
    double grace = 5;  // how long the helm is kept for a pilot who is away while others wait
};

// One place in the line. Who has had his turn has none.
struct GuestSeat {
    GuestId guest;
    double left = 0;                  // of the turn, until it ends or the helm goes to another
    std::optional<double> awaySince;  // nothing: present
};

// All seats in their order, and who of them steers.
class VisitorQueue {
  public:
    static constexpr std::size_t kMostSeats = 12;  // with the pilot's

    explicit VisitorQueue(const QueueTimes& times = {}) : times_{times} {}

    // Takes a seat behind all others. False: there is none, or the guest has one.
    bool join(const GuestId& guest);
    void leave(const GuestId& guest, double now);
    // The guest's connection is lost, and is there again. Others than those in line change nothing.
    void lost(const GuestId& guest, double now);
    void back(const GuestId& guest);
    // Brings the line up to now, and says who steers.
    std::optional<GuestId> pilot(double now);

    // In the order of the line, as of the last call of pilot().
    [[nodiscard]] const std::vector<GuestSeat>& seats() const { return seats_; }
    // Whom pilot() named last.
    [[nodiscard]] const std::optional<GuestId>& steering() const { return pilot_; }
    // Seconds until the guest's turn at the latest, if nothing is rotated until then; 0 for the
    // pilot, nothing for who is not in line.
    [[nodiscard]] std::optional<double> waitOf(const GuestId& guest, double now) const;
    // Seconds left of the turn of a seat.
    [[nodiscard]] double leftOf(const GuestSeat& seat, double now) const;

    // Seats of an earlier run, all of them away since now.
    void restore(std::vector<GuestSeat> seats, double now);

  private:
    [[nodiscard]] std::vector<GuestSeat>::iterator seatOf(const GuestId& guest);
    // His turn is over, or he was away for too long.
    [[nodiscard]] bool isGivenUp(const GuestSeat& seat, double now) const;
    // Or he is away while somebody else is there.
    [[nodiscard]] bool mustYield(const GuestSeat& pilot, double now) const;
    // The pilot gives the helm back; his seat keeps what is left of his turn.
    void endTurn(double now);

    QueueTimes times_;
    std::vector<GuestSeat> seats_;
    std::optional<GuestId> pilot_;
    double began_ = 0;  // of the pilot's turn
    double free_ = 0;   // when the next may begin
};

}  // namespace aquarama::guests
