// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/frame_reports.h"

#include <chrono>

namespace aquarama::session {
namespace {

// A report may be lost with its connection, for all nodes at once where a key is revoked: the wall
// then stands still for as long, so it is less than a node may be silent.
constexpr net::Duration kReportRepeat = std::chrono::milliseconds(100);

}  // namespace

void FrameReports::finish(const FinishedFrame& finished) {
    finished_ = finished;
    said_.reset();
    lastFinished_ = finished.frame;
    pictures_.add(finished.took);
}

void FrameReports::release(Frame frame) {
    if (finished_ && finished_->frame <= frame) finished_.reset();
}

std::optional<v1::Envelope> FrameReports::due(const Pings& clock,
                                              net::Moment now,
                                              std::uint64_t mismatches) {
    if (!finished_ || (said_ && now - *said_ <= kReportRepeat)) return std::nullopt;
    said_ = now;
    v1::Envelope message;
    v1::Ready& ready = *message.mutable_ready();
    ready.set_frame(finished_->frame.value);
    ready.set_hash_mismatches(mismatches);
    ready.set_picture_us(
        static_cast<std::uint32_t>(finished_->took / std::chrono::microseconds(1)));
    const auto masters = [&](net::Moment own) {
        return (own + clock.offset(own).value_or(net::Duration{})).time_since_epoch().count();
    };
    if (const auto& released = finished_->released) {
        ready.set_released_frame(released->frame.value);
        ready.set_released_ns(masters(released->at));
    }
    if (const auto& blanks = finished_->blanks) {
        ready.set_blank_ns(masters(blanks->last));
        ready.set_blank_period_ns(static_cast<std::uint32_t>(blanks->period.count()));
    }
    return message;
}

void FrameReports::report(v1::NodeReport& report) const {
    report.set_picture_median_ms(pictures_.quantileMs(0.5));
    report.set_picture_p99_ms(pictures_.quantileMs(0.99));
}

}  // namespace aquarama::session
