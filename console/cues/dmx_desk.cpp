// SPDX-License-Identifier: Apache-2.0
#include "console/cues/dmx_desk.h"

#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/base/log.h"

namespace aquarama::console {

namespace {

constexpr double kBetweenTries = 1;
// Art-Net says what does not change every four seconds.
constexpr double kSilentSeconds = 10;
constexpr std::uint8_t kBlackFrom = 128;
constexpr double kFull = 255;

// What a channel has; nothing where it is not driven, or the frame is shorter.
std::optional<std::uint8_t> valueIn(const DmxFrame& frame,
                                    const std::optional<std::uint32_t>& channel) {
    if (!channel || *channel > frame.size()) return std::nullopt;
    return frame[*channel - 1];
}

// Remembers a value that has come. True: there was another before.
template <class Value>
bool isChange(std::optional<Value>& before, const std::optional<Value>& now) {
    if (!now) return false;
    const std::optional<Value> last = std::exchange(before, now);
    return last && last != now;
}

}  // namespace

DmxDesk::DmxDesk(config::DmxCues how, GiveOrder give, OpenUniverse open)
    : how_{how}, give_{std::move(give)}, open_{std::move(open)} {}

void DmxDesk::tick(double now) {
    try {
        if (!source_) openAgain(now);
        if (!source_) return;
        if (const auto frame = source_->hear()) {
            heardAt_ = now;
            problem_.clear();
            take(*frame);
        }
        if (now - heardAt_ > kSilentSeconds)
            problem_ = fmt::format(
                "no DMX in universe {} for {:.0f} s, and the wall stays as it is; look at the "
                "desk, and at olad's patch",
                how_.universe,
                kSilentSeconds);
    } catch (const Error& failure) {
        source_.reset();
        if (problem_ != failure.what()) logWarning("cues by DMX: {}", failure.what());
        problem_ = failure.what();
    }
}

void DmxDesk::openAgain(double now) {
    if (now - triedAt_ < kBetweenTries) return;
    triedAt_ = now;
    source_ = open_(how_.universe);
    heardAt_ = now;
    problem_.clear();
    logInfo("cues by DMX of olad's universe {}", how_.universe);
}

void DmxDesk::take(const DmxFrame& frame) {
    v1::Order order;
    const auto brightness = valueIn(frame, how_.brightness);
    const auto black = valueIn(frame, how_.black);
    if (isChange(brightness_, brightness))
        order.mutable_show()->set_brightness(*brightness / kFull);
    if (isChange(black_, black ? std::optional(*black >= kBlackFrom) : std::nullopt))
        order.mutable_show()->set_black(*black_);
    if (order.has_show()) give_(fmt::format("DMX universe {}", how_.universe), order);
}

}  // namespace aquarama::console
