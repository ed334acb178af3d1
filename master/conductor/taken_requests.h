// SPDX-License-Identifier: Apache-2.0
// Requests about drawings that were taken: who says one again is answered again, and nothing is
// done twice.
#pragma once

#include <cstdint>
#include <deque>

#include "common/ask/order_book.h"
#include "common/net/clock.h"

namespace aquarama::conductor {

// One of them.
struct TakenRequest {
    std::uint64_t request = 0;
    std::uint32_t number = 0;  // of a drawing that was offered
    std::uint64_t state = 0;   // of the files, that has it
    net::Moment at{};
};

// The newest of them. Of the conductor's thread.
class TakenRequests {
  public:
    // Null where it was not taken.
    [[nodiscard]] const TakenRequest* find(std::uint64_t request) const;
    const TakenRequest& add(const TakenRequest& taken);
    // Whether a standby has yet to write what was taken.
    void awaitCopy(bool isAwaited) { isCopyAwaited_ = isAwaited; }
    // `isKept`: the master's disk has it. A standby is waited for as well, for some seconds at
    // most.
    [[nodiscard]] ask::Answer answerOf(const TakenRequest& taken, bool isKept) const;

  private:
    std::deque<TakenRequest> requests_;  // the newest last
    bool isCopyAwaited_ = false;
};

}  // namespace aquarama::conductor
