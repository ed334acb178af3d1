// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/snapshot_buffer.h"

#include <algorithm>
#include <utility>

#include <glm/gtc/quaternion.hpp>

namespace aquarama::conductor {
namespace {

wire::StateFrame showingOne(Frame frame, const Snapshot& snapshot) {
    return {frame,
            snapshot.tick,
            1.0F,
            snapshot.eye,
            snapshot.hash,
            {},
            snapshot.fish,
            snapshot.food.originMetres,
            {},
            snapshot.food.particles,
            snapshot.daylight};
}

wire::Eye between(const wire::Eye& before, const wire::Eye& after, float fraction) {
    return {glm::mix(before.positionMetres, after.positionMetres, fraction),
            glm::slerp(before.worldFromWall, after.worldFromWall, fraction)};
}

}  // namespace

void SnapshotBuffer::add(Snapshot snapshot) {
    snapshots_.push_back(std::move(snapshot));
    if (snapshots_.size() > kKept) snapshots_.pop_front();
}

std::optional<Tick> SnapshotBuffer::newest() const {
    return snapshots_.empty() ? std::nullopt : std::optional{snapshots_.back().tick};
}

std::optional<wire::StateFrame> SnapshotBuffer::showing(Frame frame, Tick tick) const {
    const auto found = std::ranges::find(snapshots_, tick, &Snapshot::tick);
    if (found == snapshots_.end()) return std::nullopt;
    return showingOne(frame, *found);
}

std::optional<wire::StateFrame> SnapshotBuffer::showing(Frame frame, net::Instant moment) const {
    if (snapshots_.empty()) return std::nullopt;
    const auto after = std::ranges::lower_bound(snapshots_, moment, {}, &Snapshot::due);
    if (after == snapshots_.end()) return showingOne(frame, snapshots_.back());
    if (after == snapshots_.begin()) return showingOne(frame, *after);
    const Snapshot& before = *std::prev(after);
    // After a pause two ticks lie far apart; the world stood still until one period before the
    // second.
    const net::Instant sinceBefore = moment - (after->due - kTickPeriod);
    const float fraction = static_cast<float>(sinceBefore.count()) / float{kTickPeriod.count()};
    if (fraction <= 0.0F) return showingOne(frame, before);
    if (fraction >= 1.0F) return showingOne(frame, *after);
    return wire::StateFrame{frame,
                            after->tick,
                            fraction,
                            between(before.eye, after->eye, fraction),
                            after->hash,
                            before.fish,
                            after->fish,
                            after->food.originMetres,
                            before.food.particles,
                            after->food.particles,
                            glm::mix(before.daylight, after->daylight, fraction)};
}

}  // namespace aquarama::conductor
