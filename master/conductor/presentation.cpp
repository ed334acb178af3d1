// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/presentation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <span>

#include <spdlog/fmt/fmt.h>

#include "common/base/log.h"

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;

// Time for a release to reach every node: ten times the median of a busy machine's loopback.
constexpr net::Duration kLead = milliseconds(2);
// A state is published so long before the release of the frame before it: nodes begin to draw then.
constexpr net::Duration kPublishLead = milliseconds(3);
// A frame shows the world as it was so long before its release, which is a refresh after the one
// before: the two ticks on either side are simulated when it is published.
constexpr net::Duration kShownAge = 2 * kTickPeriod + kPublishLead + milliseconds(1);
constexpr net::Duration kBeacon = milliseconds(50);
constexpr net::Duration kLongestRepeat = std::chrono::seconds(1);
constexpr net::Duration kLongestWait = milliseconds(10);
constexpr std::size_t kMostNodes = 64;  // as many as a rig has channels

GrowingFile openTrace(const std::filesystem::path& directory) {
    if (directory.empty()) return {};
    GrowingFile trace(directory / "master.csv");
    trace.append("frame,state_ns,ready_ns,present_ns\n");
    return trace;
}

wire::Packet beaconOf(const Sender& sender) {
    v1::Envelope beacon;
    beacon.mutable_beacon();
    return sender.packetOf(std::move(beacon));
}

}  // namespace

Presentation::Presentation(const PresentationLimits& limits,
                           Roster& roster,
                           const Sender& sender,
                           net::MasterChannels& channels,
                           Gauges& gauges,
                           ShowReport& report,
                           FrameSource& source,
                           net::Moment start)
    : limits_{limits},
      roster_{roster},
      sender_{sender},
      channels_{channels},
      gauges_{gauges},
      report_{report},
      source_{source},
      barrier_{roster.seats().size(), limits.barrier, start},
      trace_{openTrace(limits.traceDirectory)},
      beacon_{beaconOf(sender)},
      isOver_{limits.frames == 0U} {
    assert(roster.seats().size() <= kMostNodes);
}

void Presentation::turn(net::Moment now) {
    takeTicks();
    expelSilent(now);
    conduct(now);
    sendBeacon(now);
}

bool Presentation::isLast(Frame frame) const {
    return limits_.frames && frame.value + 1 >= *limits_.frames;
}

// Lockstep takes a tick when its frame comes up, so that the tick thread waits for the frames.
void Presentation::takeTicks() {
    while (!isLockstep() || snapshots_.newest() < tickOf(unpublished_)) {
        auto snapshot = source_.takeTick();
        if (!snapshot) return;
        school_.add(*snapshot);
        snapshots_.add(std::move(*snapshot));
    }
}

void Presentation::enterWorld(std::vector<school::RecordedRates> rates) {
    snapshots_ = {};
    school_.begin(std::move(rates));
}

void Presentation::expelSilent(net::Moment now) {
    for (const std::size_t node : barrier_.expelSilent(now)) {
        NodeSeat& seat = roster_.seats()[node];
        ++seat.dropped;
        logWarning("node {} is not counted any more: silent", seat.name);
        sender_.dismiss(seat.peer, "you were silent for too long");
        seat.vacate();
    }
}

void Presentation::conduct(net::Moment now) {
    const auto decision = barrier_.decide(now);
    if (decision.verdict == PresentBarrier::Verdict::Silent) {
        failure_ = "node \"" + roster_.seats()[decision.node].name + "\" has been silent for " +
                   std::to_string(limits_.barrier.patience / std::chrono::seconds(1)) +
                   " s; see its own output, and start the show again";
        isOver_ = true;
        return;
    }
    if (!isDrawing_) return beginNext(now);
    // As late as possible, so that what it shows is fresh; early enough to be there on time.
    const bool isDue = isLockstep() || now + kPublishLead >= nextRelease(now);
    if (barrier_.anyReady() && isDue && !isLast(next_)) publish({next_.value + 1}, now);
    if (decision.verdict == PresentBarrier::Verdict::Present) return release(now);
    if (decision.verdict == PresentBarrier::Verdict::Idle) {
        if (const auto awaited = barrier_.nextAwaited()) {
            next_ = *awaited;
            beginNext(now);
        }
    }
    if (now - lastRepeat_ > repeatAfter_) publishAgain(now);
}

void Presentation::beginNext(net::Moment now) {
    const bool mayBegin = isLockstep()
                              ? barrier_.allPrepared()
                              : barrier_.hasMembers() && now + kPublishLead >= lastRelease_;
    isDrawing_ = mayBegin && publish(next_, now);
    if (isDrawing_) barrier_.begin(next_);
}

net::Duration Presentation::untilDue(net::Moment now) const {
    const net::Duration due = lastRelease_ - kPublishLead - now;
    return isDrawing_ || isLockstep() || due < net::Duration{0} ? kLongestWait
                                                                : std::min(due, kLongestWait);
}

net::Moment Presentation::nextRelease(net::Moment now) const {
    constexpr net::Duration kBelieved = std::chrono::seconds(2);
    std::array<net::Blanks, kMostNodes> displays;
    std::size_t count = 0;
    for (std::size_t node = 0; node < roster_.seats().size(); ++node) {
        const auto& blanks = roster_.seats()[node].blanks;
        if (blanks && blanks->last > now - kBelieved && barrier_.isWaitedFor(node))
            displays[count++] = *blanks;
    }
    return releaseTime(
        now + kLead, lastRelease_, limits_.refresh, std::span(displays).first(count));
}

// Of the frame that is drawn, or of the one after it.
net::Moment Presentation::releaseOf(Frame frame, net::Moment now) const {
    return nextRelease(now) + (next_ < frame ? limits_.refresh : net::Duration{0});
}

void Presentation::release(net::Moment now) {
    const net::Moment at = nextRelease(now);
    v1::Envelope message;
    message.mutable_present()->set_frame(next_.value);
    message.mutable_present()->set_at_ns(isLockstep() ? 0 : at.time_since_epoch().count());
    lastPresent_.emplace(next_, sender_.packetOf(std::move(message)));
    for (const NodeSeat& seat : roster_.seats())
        if (seat.prepared) sender_.send(seat.peer, lastPresent_->second);
    source_.onReleased(next_);
    if (report_.frames++ > 0) gauges_.released(now, at - lastRelease_);
    lastRelease_ = at;
    isOver_ = isOver_ || isLast(next_);
    isDrawing_ = false;
    ++next_.value;
    if (!isOver_) beginNext(now);
}

bool Presentation::publish(Frame frame, net::Moment now) {
    if (frame < unpublished_) return true;
    takeTicks();
    auto state = isLockstep() ? snapshots_.showing(frame, tickOf(frame))
                              : snapshots_.showing(frame, releaseOf(frame, now) - kShownAge);
    if (!state) return false;
    state->show = &source_.showOf(frame, now);
    const wire::Packet& packet = published_[frame] =
        wire::encodeState(sender_.session(), *state, school_.upTo(state->tick));
    channels_.publishState(packet);
    lastPublished_ = lastRepeat_ = now;
    repeatAfter_ = isLockstep() ? kLongestRepeat : limits_.barrier.deadline;
    if (trace_.isOpen())
        trace_.appendOrLog(
            fmt::format("{},{},,\n", frame.value, net::monotonicNow().time_since_epoch().count()));
    gauges_.published(*state, packet.size());
    if (published_.size() > 2) published_.erase(published_.begin());
    unpublished_ = {frame.value + 1};
    report_.tick = state->tick;
    report_.worldHash = state->worldHash;
    return true;
}

// Where all wait for a state that was lost on its way, it must come again; less and less often, as
// they may just be slow.
void Presentation::publishAgain(net::Moment now) {
    for (const auto& [frame, packet] : published_) channels_.publishState(packet);
    lastRepeat_ = now;
    repeatAfter_ = std::min(2 * repeatAfter_, kLongestRepeat);
}

// So that a fresh subscriber knows that it hears the channel.
void Presentation::sendBeacon(net::Moment now) {
    if (now - lastPublished_ <= kBeacon) return;
    channels_.publishState(beacon_);
    lastPublished_ = now;
}

Frame Presentation::admit(std::size_t node, net::Moment now) {
    const Frame first = isLockstep() ? next_ : unpublished_;
    barrier_.join(node, first);
    if (isLockstep()) publishAgain(now);
    return first;
}

void Presentation::ready(std::size_t node, const v1::Ready& ready, net::Moment now) {
    const Frame frame{ready.frame()};
    NodeSeat& seat = roster_.seats()[node];
    barrier_.ready(node, frame, now);
    seat.mismatches = ready.hash_mismatches();
    seat.blanks = blanksIn(ready);
    if (ready.has_picture_us())
        seat.pictures.add(now, std::chrono::microseconds(ready.picture_us()));
    if (ready.has_released_frame()) {
        seat.released = std::max(seat.released, Frame{ready.released_frame()});
        gauges_.nodeReleased(
            now, {ready.released_frame()}, net::Moment{net::Duration{ready.released_ns()}});
    }
    // It asks again for a release that never came.
    if (lastPresent_ && frame <= lastPresent_->first) sender_.send(seat.peer, lastPresent_->second);
}

// A display of quite another rate cannot be kept in step with the wall.
std::optional<net::Blanks> Presentation::blanksIn(const v1::Ready& ready) const {
    const net::Blanks blanks{net::Moment{net::Duration{ready.blank_ns()}},
                             net::Duration{ready.blank_period_ns()}};
    const net::Duration apart = blanks.period - limits_.refresh;
    const bool isBelieved = ready.has_blank_ns() && apart < limits_.refresh / 50 &&
                            -apart < limits_.refresh / 50 && blanks.last < net::monotonicNow();
    return isBelieved ? std::optional(blanks) : std::nullopt;
}

}  // namespace aquarama::conductor
