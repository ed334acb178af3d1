// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/present_barrier.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace aquarama::conductor {

PresentBarrier::PresentBarrier(std::size_t nodes, const BarrierLimits& limits, net::Moment start)
    : limits_(limits), nodes_(nodes) {
    for (Node& node : nodes_) node.lastHeard = start;
}

void PresentBarrier::heard(std::size_t node, net::Moment now) {
    assert(node < nodes_.size());
    nodes_[node].lastHeard = now;
}

void PresentBarrier::join(std::size_t node, Frame first) {
    assert(node < nodes_.size());
    Node& joining = nodes_[node];
    joining.member = true;
    joining.late = false;
    joining.readyFor.reset();
    joining.first = first;
}

void PresentBarrier::leave(std::size_t node) {
    nodes_[node].member = false;
    nodes_[node].readyFor.reset();
}

std::vector<std::size_t> PresentBarrier::expelSilent(net::Moment now) {
    std::vector<std::size_t> expelled;
    if (limits_.lockstep) return expelled;
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
        if (!isMember(node) || now - nodes_[node].lastHeard <= limits_.membership) continue;
        leave(node);
        expelled.push_back(node);
    }
    return expelled;
}

void PresentBarrier::begin(Frame frame) {
    frame_ = frame;
    anyReady_ = false;
    deadline_.reset();
}

void PresentBarrier::ready(std::size_t node, Frame frame, net::Moment now) {
    Node& speaker = nodes_[node];
    if (!frame_ || !speaker.member) return;
    const bool isAhead = frame.value == frame_->value + 1;
    const bool isOnlyJustLate = frame.value + 1 == frame_->value;
    if (frame == *frame_ || isAhead || isOnlyJustLate) speaker.late = false;
    if (frame != *frame_ && !isAhead) return;
    // It evidently saw that state; one that is ahead has left out the frame that is drawn now.
    speaker.first = isAhead ? frame : std::min(speaker.first, frame);
    speaker.readyFor = frame;
    if (isAhead) return;
    if (!std::exchange(anyReady_, true)) deadline_ = now + limits_.deadline;
}

bool PresentBarrier::isWaitedFor(std::size_t node) const {
    const Node& n = nodes_[node];
    return n.member && !n.late && frame_ && n.first <= *frame_;
}

std::optional<Frame> PresentBarrier::nextAwaited() const {
    std::optional<Frame> next;
    for (const Node& node : nodes_) {
        const bool isNewcomer = node.member && !node.late && (!frame_ || *frame_ < node.first);
        if (isNewcomer) next = std::min(next.value_or(node.first), node.first);
    }
    return next;
}

bool PresentBarrier::allPrepared() const {
    return std::ranges::all_of(nodes_, &Node::member);
}

bool PresentBarrier::hasMembers() const {
    return std::ranges::any_of(nodes_, &Node::member);
}

PresentBarrier::Decision PresentBarrier::decide(net::Moment now) {
    return limits_.lockstep ? decideLockstep(now) : decideLive(now);
}

PresentBarrier::Decision PresentBarrier::decideLive(net::Moment now) {
    std::size_t waitedFor = 0;
    std::size_t missing = 0;
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
        if (!isWaitedFor(node)) continue;
        ++waitedFor;
        if (!isReady(nodes_[node])) ++missing;
    }
    if (waitedFor == 0) return {};
    if (missing == 0) return {Verdict::Present, {}, 0};
    if (missing == waitedFor) return {Verdict::Wait, {}, 0};
    // Who is ready was ahead: the others have only just begun.
    if (!deadline_) deadline_ = now + limits_.membership;
    if (now < *deadline_) return {Verdict::Wait, deadline_, 0};
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
        if (!isWaitedFor(node) || isReady(nodes_[node])) continue;
        nodes_[node].late = true;
        ++nodes_[node].timesLate;
    }
    return {Verdict::Present, {}, 0};
}

PresentBarrier::Decision PresentBarrier::decideLockstep(net::Moment now) const {
    const auto quietest = std::ranges::min_element(nodes_, {}, &Node::lastHeard);
    if (quietest == nodes_.end()) return {};
    const net::Moment end = quietest->lastHeard + limits_.patience;
    const auto name = static_cast<std::size_t>(quietest - nodes_.begin());
    const bool allReady =
        std::ranges::all_of(nodes_, [&](const Node& node) { return isReady(node); });
    if (allReady) return {Verdict::Present, {}, 0};
    if (now >= end) return {Verdict::Silent, {}, name};
    return {Verdict::Wait, end, name};
}

namespace {

// When to release: from `begin` on for `length`, and again every period.
struct Gap {
    net::Moment begin{};
    net::Duration length{};
};

// The time to the next blank.
net::Duration toNextBlank(const net::Blanks& display, net::Moment from) {
    const net::Duration since = (from - display.last) % display.period;
    return since > net::Duration{0} ? display.period - since : -since;
}

// From a display's next blank to the first of any other.
Gap gapAfter(const net::Blanks& display,
             net::Moment from,
             net::Duration period,
             std::span<const net::Blanks> displays) {
    const net::Duration toBegin = toNextBlank(display, from);
    net::Duration length = period;
    for (const net::Blanks& other : displays) {
        const net::Duration after = (toNextBlank(other, from) - toBegin + 2 * period) % period;
        if (after > net::Duration{0}) length = std::min(length, after);
    }
    return {from + toBegin, length};
}

// The widest gap; but that of `last` as long as no other is much wider: between two gaps of one
// width there is no going to and fro.
Gap gapFor(net::Moment last,
           net::Moment from,
           net::Duration period,
           std::span<const net::Blanks> displays) {
    Gap best;
    net::Duration most{};
    for (const net::Blanks& display : displays) {
        const Gap gap = gapAfter(display, from, period, displays);
        const net::Duration place = ((last - gap.begin) % period + period) % period;
        const net::Duration worth = place < gap.length ? gap.length * 5 / 4 : gap.length;
        if (worth > most) best = gap;
        most = std::max(most, worth);
    }
    return best;
}

// Without the guard at either end, or its middle alone.
Gap guarded(const Gap& gap) {
    if (gap.length <= 2 * kBlankGuard) return {gap.begin + gap.length / 2, {}};
    return {gap.begin + kBlankGuard, gap.length - 2 * kBlankGuard};
}

}  // namespace

net::Moment releaseTime(net::Moment earliest,
                        net::Moment last,
                        net::Duration refresh,
                        std::span<const net::Blanks> displays) {
    if (displays.empty()) return std::max(earliest, last + refresh);
    net::Duration period{};
    for (const net::Blanks& display : displays)
        period += display.period / static_cast<std::int64_t>(displays.size());
    Gap gap = guarded(gapFor(last, earliest, period, displays));
    gap.begin -= 2 * period;
    // What is known of the phases wavers a little: a gap that begins just after `last` is its own.
    while (gap.begin + gap.length < earliest || gap.begin <= last + kBlankGuard)
        gap.begin += period;
    return std::max(gap.begin, earliest);
}

std::optional<net::Duration> SkewMeter::add(Frame frame, net::Moment at) {
    const auto span = std::ranges::find(spans_, frame, &Span::frame);
    if (span != spans_.end()) {
        span->earliest = std::min(span->earliest, at);
        span->latest = std::max(span->latest, at);
        ++span->nodes;
        return std::nullopt;
    }
    spans_.push_back({frame, at, at, 1});
    if (spans_.size() <= kOpen) return std::nullopt;
    const Span closed = spans_.front();
    spans_.pop_front();
    if (closed.nodes < 2) return std::nullopt;
    const net::Duration skew = closed.latest - closed.earliest;
    skews_.add(skew);
    return skew;
}

}  // namespace aquarama::conductor
