// SPDX-License-Identifier: Apache-2.0
#include "master/standby/parts.h"

#include <utility>

namespace aquarama::standby {

void Parts::forget() {
    stream_ = taken_ = told_ = 0;
    buffer_.clear();
    isWhole_ = false;
}

void Parts::askAnew() {
    forget();
    ++request_;
}

bool Parts::take(const v1::Journalled& part) {
    if (part.stream() != stream_) {
        if (part.part() != 0) return false;
        forget();
        stream_ = part.stream();
    }
    const bool isBounded = buffer_.size() + part.entries().size() <= 2 * wire::kMostSavedBytes;
    if (part.part() != taken_ || !isBounded) {
        askAnew();
        return false;
    }
    ++taken_;
    const auto* const bytes = reinterpret_cast<const std::byte*>(part.entries().data());
    buffer_.insert(buffer_.end(), bytes, bytes + part.entries().size());
    isWhole_ = !part.goes_on();
    return true;
}

std::optional<wire::Packet> Parts::takePiece() {
    if (!std::exchange(isWhole_, false)) return std::nullopt;
    return std::exchange(buffer_, {});
}

}  // namespace aquarama::standby
