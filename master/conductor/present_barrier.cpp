// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/present_barrier.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace aquarama::conductor {

PresentBarrier::PresentBarrier(std::size_t nodes, const BarrierLimits& limits, net::Instant start)
    : limits_(limits), nodes_(nodes) {
    for (Node& node : nodes_) node.lastHeard = start;
}

void PresentBarrier::heard(std::size_t node, net::Instant now) {
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

std::vector<std::size_t> PresentBarrier::expelSilent(net::Instant now) {
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

void PresentBarrier::ready(std::size_t node, Frame frame, net::Instant now) {
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

PresentBarrier::Decision PresentBarrier::decide(net::Instant now) {
    return limits_.lockstep ? decideLockstep(now) : decideLive(now);
}

PresentBarrier::Decision PresentBarrier::decideLive(net::Instant now) {
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

PresentBarrier::Decision PresentBarrier::decideLockstep(net::Instant now) const {
    const auto quietest = std::ranges::min_element(nodes_, {}, &Node::lastHeard);
    if (quietest == nodes_.end()) return {};
    const net::Instant end = quietest->lastHeard + limits_.patience;
    const auto name = static_cast<std::size_t>(quietest - nodes_.begin());
    const bool allReady =
        std::ranges::all_of(nodes_, [&](const Node& node) { return isReady(node); });
    if (allReady) return {Verdict::Present, {}, 0};
    if (now >= end) return {Verdict::Silent, {}, name};
    return {Verdict::Wait, end, name};
}

std::optional<net::Instant> SkewMeter::add(Frame frame, std::int64_t atNs) {
    const auto span = std::ranges::find(spans_, frame, &Span::frame);
    if (span != spans_.end()) {
        span->earliestNs = std::min(span->earliestNs, atNs);
        span->latestNs = std::max(span->latestNs, atNs);
        ++span->nodes;
        return std::nullopt;
    }
    spans_.push_back({frame, atNs, atNs, 1});
    if (spans_.size() <= kOpen) return std::nullopt;
    const Span closed = spans_.front();
    spans_.pop_front();
    if (closed.nodes < 2) return std::nullopt;
    const net::Instant skew{closed.latestNs - closed.earliestNs};
    skews_.add(skew);
    return skew;
}

}  // namespace aquarama::conductor
