// SPDX-License-Identifier: Apache-2.0
#include "guests/queue.h"

#include <algorithm>
#include <utility>

namespace aquarama::guests {

namespace {

bool isPresent(const GuestSeat& seat) {
    return !seat.awaySince;
}

}  // namespace

std::vector<GuestSeat>::iterator VisitorQueue::seatOf(const GuestId& guest) {
    return std::ranges::find(seats_, guest, &GuestSeat::guest);
}

bool VisitorQueue::join(const GuestId& guest) {
    if (seats_.size() >= kMostSeats || seatOf(guest) != seats_.end()) return false;
    seats_.push_back({guest, times_.turn, std::nullopt});
    return true;
}

void VisitorQueue::leave(const GuestId& guest, double now) {
    if (pilot_ == guest) endTurn(now);
    std::erase_if(seats_, [&](const GuestSeat& seat) { return seat.guest == guest; });
}

void VisitorQueue::lost(const GuestId& guest, double now) {
    const auto seat = seatOf(guest);
    if (seat != seats_.end() && isPresent(*seat)) seat->awaySince = now;
}

void VisitorQueue::back(const GuestId& guest) {
    const auto seat = seatOf(guest);
    if (seat != seats_.end()) seat->awaySince.reset();
}

double VisitorQueue::leftOf(const GuestSeat& seat, double now) const {
    return pilot_ == seat.guest ? std::max(seat.left - (now - began_), 0.0) : seat.left;
}

void VisitorQueue::endTurn(double now) {
    const auto seat = seatOf(*pilot_);
    seat->left = leftOf(*seat, now);
    pilot_.reset();
    free_ = now + times_.rest;
}

bool VisitorQueue::isGivenUp(const GuestSeat& seat, double now) const {
    return leftOf(seat, now) <= 0 || (seat.awaySince && now - *seat.awaySince >= times_.held);
}

bool VisitorQueue::mustYield(const GuestSeat& pilot, double now) const {
    return isGivenUp(pilot, now) || (pilot.awaySince && now - *pilot.awaySince >= times_.grace &&
                                     std::ranges::any_of(seats_, isPresent));
}

// The first who is there: a phone that is locked holds nobody up.
std::optional<GuestId> VisitorQueue::pilot(double now) {
    if (pilot_ && mustYield(*seatOf(*pilot_), now)) endTurn(now);
    std::erase_if(seats_, [&](const GuestSeat& seat) { return isGivenUp(seat, now); });
    if (pilot_ || now < free_) return pilot_;
    const auto next = std::ranges::find_if(seats_, isPresent);
    if (next == seats_.end()) return pilot_;
    pilot_ = next->guest;
    began_ = now;
    return pilot_;
}

// Those who are away are counted: they may come back.
std::optional<double> VisitorQueue::waitOf(const GuestId& guest, double now) const {
    if (pilot_ == guest) return 0;
    double wait = std::max(free_ - now, 0.0);
    for (const GuestSeat& seat : seats_)
        if (pilot_ == seat.guest) wait = leftOf(seat, now) + times_.rest;
    for (const GuestSeat& seat : seats_) {
        if (seat.guest == guest) return wait;
        if (pilot_ != seat.guest) wait += seat.left + times_.rest;
    }
    return std::nullopt;
}

void VisitorQueue::restore(std::vector<GuestSeat> seats, double now) {
    seats_ = std::move(seats);
    if (seats_.size() > kMostSeats) seats_.resize(kMostSeats);
    for (GuestSeat& seat : seats_) seat.awaySince = now;
}

}  // namespace aquarama::guests
