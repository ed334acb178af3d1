// SPDX-License-Identifier: Apache-2.0
// The stream that a standby gets: parts, in their order, and what they make.
#pragma once

#include <cstdint>
#include <optional>

#include "common/wire/messages.h"
#include "common/wire/recording.h"

namespace aquarama::standby {

// Used by one thread.
class Parts {
  public:
    // False: it is of a stream that was given up, or one before it was lost, and another stream is
    // wanted.
    [[nodiscard]] bool take(const v1::Journalled& part);
    // What the last parts make, where they are whole: a recording, or entries that go on with it.
    [[nodiscard]] std::optional<wire::Packet> takePiece();
    // Asks for another stream, which begins with a save.
    void askAnew();

    // 0: none.
    [[nodiscard]] std::uint64_t stream() const { return stream_; }
    // Another one for each stream that is asked for.
    [[nodiscard]] std::uint64_t request() const { return request_; }
    // How many were taken, and how many of them the master was not told of yet.
    [[nodiscard]] std::uint64_t taken() const { return taken_; }
    [[nodiscard]] std::uint64_t untold() const { return taken_ - told_; }
    // The master was told of all of them.
    void told() { told_ = taken_; }
    // Of a piece a part has yet to come.
    [[nodiscard]] bool goesOn() const { return !buffer_.empty(); }

  private:
    void forget();

    std::uint64_t stream_ = 0, request_ = 1, taken_ = 0, told_ = 0;
    wire::Packet buffer_;
    bool isWhole_ = false;
};

}  // namespace aquarama::standby
