// SPDX-License-Identifier: Apache-2.0
// How often something may happen: so many times at once, and then at a rate.
#pragma once

#include <algorithm>

namespace aquarama::guests {

// A bound for one kind of thing. Times are seconds of the caller's clock.
class Allowance {
  public:
    // `most` at once, and `rate` a second.
    Allowance(double most, double rate) : most_{most}, rate_{rate}, left_{most} {}
    // Whether it may happen now, in seconds; takes one if so.
    [[nodiscard]] bool take(double now) {
        left_ = std::min(left_ + (now - last_) * rate_, most_);
        last_ = now;
        if (left_ < 1) return false;
        --left_;
        return true;
    }

  private:
    double most_, rate_, left_;
    double last_ = 0;
};

}  // namespace aquarama::guests
