// SPDX-License-Identifier: Apache-2.0
#include "master/journal/relay.h"

#include <utility>

#include "master/world/world_state.h"

namespace aquarama::journal {

namespace {

// Hours of a quiet show; a standby that has stood still for so long needs another save.
constexpr std::size_t kMostRelayedBytes = std::size_t{16} << 20U;

}  // namespace

Relay::Relay(wire::Packet beginning)
    : beginning_{std::move(beginning)}, thread_{"relay", kMostRelayedBytes} {}

// Another beginning while the one before is encoded is that one.
void Relay::begin(const world::World& world, const std::vector<wire::Packet>& ahead) {
    {
        const std::lock_guard lock(mutex_);
        if (isEncoding_) return;
        isOn_ = isEncoding_ = true;
        first_.reset();
        waiting_.clear();
        tick_ = world.tick();
    }
    world.save(state_);
    for (const wire::Packet& entry : ahead) add(entry);
    if (thread_.put(0, [this] { addBeginning(); })) return;
    const std::lock_guard lock(mutex_);
    isOn_ = isEncoding_ = false;
}

void Relay::addBeginning() {
    wire::Packet first = beginning_;
    const wire::Packet save = wire::entryOf(state_.tick, world::encodeState(state_));
    first.insert(first.end(), save.begin(), save.end());
    const std::lock_guard lock(mutex_);
    first_ = std::move(first);
    isEncoding_ = false;
}

void Relay::add(const wire::Packet& entry) {
    const std::lock_guard lock(mutex_);
    if (!isOn_) return;
    waiting_.insert(waiting_.end(), entry.begin(), entry.end());
    if (waiting_.size() <= kMostRelayedBytes) return;
    isOn_ = false;
    waiting_ = {};
}

void Relay::reach(Tick tick) {
    const std::lock_guard lock(mutex_);
    tick_ = tick;
}

std::optional<conductor::JournalPiece> Relay::take() {
    const std::lock_guard lock(mutex_);
    if (!isOn_ || isEncoding_) return std::nullopt;
    conductor::JournalPiece piece{std::exchange(waiting_, {}), tick_, first_.has_value()};
    if (first_) {
        first_->insert(first_->end(), piece.entries.begin(), piece.entries.end());
        piece.entries = *std::exchange(first_, {});
    }
    return piece;
}

}  // namespace aquarama::journal
