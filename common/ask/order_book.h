// SPDX-License-Identifier: Apache-2.0
// The book of orders: what became of the last ones, so that an order that is repeated is answered
// again and not carried out again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <utility>

namespace aquarama::ask {

// What became of an order; numbered as OrderReply.Outcome of aquarama.proto.
enum class Outcome : std::uint8_t {
    Done = 1,
    Waiting = 2,  // it is under way
    Refused = 3,
    Lost = 4,  // nobody answered: it may have been carried out
};

// What somebody who asks again is told of an order.
struct Answer {
    Outcome outcome = Outcome::Done;
    std::string reason = {};  // why it was refused, or what is waited for
    friend bool operator==(const Answer&, const Answer&) = default;
};

// The answer to an order that was not carried out.
[[nodiscard]] inline Answer refused(std::string why) {
    return {Outcome::Refused, std::move(why)};
}

// The last orders by their request, each with its answer. A value without clock, thread or socket.
class OrderBook {
  public:
    static constexpr std::size_t kMostOrders = 128;

    // Null where the order is not known, or no longer.
    [[nodiscard]] const Answer* find(std::uint64_t request) const;
    // Enters the order, or replaces its answer. The oldest that is not under way makes room.
    const Answer& enter(std::uint64_t request, Answer answer);

  private:
    std::deque<std::pair<std::uint64_t, Answer>> orders_;  // the newest last
};

}  // namespace aquarama::ask
