// SPDX-License-Identifier: Apache-2.0
#include "tests/support/memory_channels.h"

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>

namespace aquarama::test {
namespace {

constexpr std::size_t kStateQueue = 8;

struct Parcel {
    net::Moment due;
    net::PeerId peer;
    net::ByteVector bytes;
};

// What one end has not taken yet.
struct Inbox {
    std::deque<Parcel> control;
    std::deque<Parcel> states;
    bool subscribed = false;
    bool woken = false;

    [[nodiscard]] std::optional<net::Moment> earliest() const {
        std::optional<net::Moment> due;
        for (const auto* queue : {&control, &states}) {
            if (!queue->empty() && (!due || queue->front().due < *due)) due = queue->front().due;
        }
        return due;
    }
};

std::uint32_t mixed(std::uint32_t x) {
    x = (x ^ (x >> 16U)) * 0x7FEB352DU;
    x = (x ^ (x >> 15U)) * 0x846CA68BU;
    return x ^ (x >> 16U);
}

}  // namespace

// All inboxes behind one mutex; "" is the master's.
struct MemoryNet::Hub {
    explicit Hub(const MemoryNetFaults& netFaults) : faults(netFaults) {}

    void post(const net::PeerId& to, const net::PeerId& from, net::ByteView bytes) {
        const std::lock_guard lock(mutex);
        const auto inbox = inboxes.find(to);
        if (inbox == inboxes.end()) return;
        inbox->second.control.push_back(parcel(from, bytes));
        changed.notify_all();
    }

    void publish(net::ByteView bytes) {
        const std::lock_guard lock(mutex);
        for (auto& [peer, inbox] : inboxes) {
            const bool lost = mixed(faults.seed + ++published) % 64 < faults.lostStatesPer64;
            if (!inbox.subscribed || lost || inbox.states.size() >= kStateQueue) continue;
            inbox.states.push_back(parcel("", bytes));
        }
        changed.notify_all();
    }

    std::optional<Parcel> take(const net::PeerId& owner, std::deque<Parcel> Inbox::*queue) {
        const std::lock_guard lock(mutex);
        auto& parcels = inboxes[owner].*queue;
        if (parcels.empty() || parcels.front().due > net::monotonicNow()) return std::nullopt;
        Parcel first = std::move(parcels.front());
        parcels.pop_front();
        return first;
    }

    void wait(const net::PeerId& owner, net::Duration atMost) {
        std::unique_lock lock(mutex);
        const net::Moment end = net::monotonicNow() + atMost;
        Inbox& inbox = inboxes[owner];
        while (!inbox.woken) {
            const net::Moment now = net::monotonicNow();
            const auto due = inbox.earliest();
            if (now >= end || (due && *due <= now)) break;
            changed.wait_for(lock, (due ? std::min(*due, end) : end) - now);
        }
        inbox.woken = false;
    }

    void wake(const net::PeerId& owner) {
        const std::lock_guard lock(mutex);
        inboxes[owner].woken = true;
        changed.notify_all();
    }

    [[nodiscard]] Parcel parcel(const net::PeerId& from, net::ByteView bytes) const {
        return {net::monotonicNow() + faults.delay, from, {bytes.begin(), bytes.end()}};
    }

    MemoryNetFaults faults;
    std::mutex mutex;
    std::condition_variable changed;
    std::map<net::PeerId, Inbox> inboxes;
    std::uint32_t published = 0;
    std::uint32_t nodes = 0;
};

namespace {

class MemoryMaster final : public net::MasterChannels {
  public:
    explicit MemoryMaster(std::shared_ptr<MemoryNet::Hub> hub) : hub_(std::move(hub)) {
        const std::lock_guard lock(hub_->mutex);
        hub_->inboxes[""] = {};
    }
    ~MemoryMaster() override {
        const std::lock_guard lock(hub_->mutex);
        hub_->inboxes.erase("");
    }
    MemoryMaster(const MemoryMaster&) = delete;
    MemoryMaster& operator=(const MemoryMaster&) = delete;

    void sendControl(const net::PeerId& peer, net::ByteView bytes) override {
        hub_->post(peer, "", bytes);
    }
    std::optional<net::FromPeer> receiveControl() override {
        auto parcel = hub_->take("", &Inbox::control);
        if (!parcel) return std::nullopt;
        return net::FromPeer{std::move(parcel->peer), std::move(parcel->bytes)};
    }
    void publishState(net::ByteView bytes) override { hub_->publish(bytes); }
    std::size_t discardNoise() override { return 0; }
    void wait(net::Duration atMost) override { hub_->wait("", atMost); }
    void wake() override { hub_->wake(""); }
    [[nodiscard]] std::string controlAddress() const override { return "memory:control"; }
    [[nodiscard]] std::string stateAddress() const override { return "memory:state"; }

  private:
    std::shared_ptr<MemoryNet::Hub> hub_;
};

class MemoryNode final : public net::NodeChannels {
  public:
    explicit MemoryNode(std::shared_ptr<MemoryNet::Hub> hub) : hub_(std::move(hub)) {
        const std::lock_guard lock(hub_->mutex);
        name_ = "node " + std::to_string(++hub_->nodes);
        hub_->inboxes[name_] = {};
    }
    ~MemoryNode() override {
        const std::lock_guard lock(hub_->mutex);
        hub_->inboxes.erase(name_);
    }
    MemoryNode(const MemoryNode&) = delete;
    MemoryNode& operator=(const MemoryNode&) = delete;

    void sendControl(net::ByteView bytes) override { hub_->post("", name_, bytes); }
    std::optional<net::ByteVector> receiveControl() override { return taken(&Inbox::control); }
    void subscribeState(const std::string&) override {
        const std::lock_guard lock(hub_->mutex);
        hub_->inboxes[name_].subscribed = true;
    }
    std::optional<net::ByteVector> receiveState() override { return taken(&Inbox::states); }
    void wait(net::Duration atMost) override { hub_->wait(name_, atMost); }
    void wake() override { hub_->wake(name_); }

  private:
    std::optional<net::ByteVector> taken(std::deque<Parcel> Inbox::*queue) {
        auto parcel = hub_->take(name_, queue);
        if (!parcel) return std::nullopt;
        return std::move(parcel->bytes);
    }

    std::shared_ptr<MemoryNet::Hub> hub_;
    net::PeerId name_;
};

}  // namespace

MemoryNet::MemoryNet(const MemoryNetFaults& faults) : hub_(std::make_shared<Hub>(faults)) {}
std::unique_ptr<net::MasterChannels> MemoryNet::master() {
    return std::make_unique<MemoryMaster>(hub_);
}
std::unique_ptr<net::NodeChannels> MemoryNet::node() {
    return std::make_unique<MemoryNode>(hub_);
}

}  // namespace aquarama::test
