// SPDX-License-Identifier: Apache-2.0
#include "common/ask/order_book.h"

#include <algorithm>
#include <cassert>

namespace aquarama::ask {

namespace {

using Entry = std::pair<std::uint64_t, Answer>;

}  // namespace

const Answer* OrderBook::find(std::uint64_t request) const {
    const auto known = std::ranges::find(orders_, request, &Entry::first);
    return known == orders_.end() ? nullptr : &known->second;
}

const Answer& OrderBook::enter(std::uint64_t request, Answer answer) {
    assert(request != 0);
    const auto known = std::ranges::find(orders_, request, &Entry::first);
    if (known != orders_.end()) return known->second = std::move(answer);
    if (orders_.size() == kMostOrders) {
        const auto ended = std::ranges::find_if(
            orders_, [](const Entry& entry) { return entry.second.outcome != Outcome::Waiting; });
        orders_.erase(ended == orders_.end() ? orders_.begin() : ended);
    }
    return orders_.emplace_back(request, std::move(answer)).second;
}

}  // namespace aquarama::ask
