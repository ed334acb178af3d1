// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/taken_requests.h"

#include <algorithm>
#include <chrono>

namespace aquarama::conductor {

const TakenRequest* TakenRequests::find(std::uint64_t request) const {
    const auto known = std::ranges::find(requests_, request, &TakenRequest::request);
    return known == requests_.end() ? nullptr : &*known;
}

const TakenRequest& TakenRequests::add(const TakenRequest& taken) {
    constexpr std::size_t kMost = 512;
    if (requests_.size() == kMost) requests_.pop_front();
    return requests_.emplace_back(taken);
}

ask::Answer TakenRequests::answerOf(const TakenRequest& taken, bool isKept) const {
    constexpr net::Duration kLongestCopy = std::chrono::seconds(2);
    const bool isCopied = !isCopyAwaited_ || net::monotonicNow() - taken.at >= kLongestCopy;
    if (isKept && isCopied) return {};
    return {ask::Outcome::Waiting, "the drawings are being written"};
}

}  // namespace aquarama::conductor
