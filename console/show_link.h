// SPDX-License-Identifier: Apache-2.0
// The console's way to the master of a show, on a thread of its own: what it says five times a
// second, and what it is told.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/ask/order_book.h"
#include "common/ask/request_client.h"
#include "common/base/units.h"

namespace aquarama::console {

// Called from the link's thread.
struct ShowListener {
    std::function<void(const v1::StatusReply&, std::uint64_t run)> heard;
    // Nobody answers, or the master prepares its show: what it says then, else empty.
    std::function<void(const std::string& preparing)> silent;
    // What has become of an order so far; lost: nobody answered.
    std::function<void(std::uint64_t request, const ask::Answer&)> said;
    std::function<void(const v1::Explanation&)> explained;
    // Visitors' drawings: when they have changed, and with the picture that was asked for.
    std::function<void(const v1::DrawingsReply&)> listed;
};

// What the console tells the master. From any thread; no function waits.
class MasterProxy {
  public:
    virtual ~MasterProxy() = default;
    // An order, which its request names in ShowListener::said.
    virtual void give(v1::Order order) = 0;
    // How the submarine is steered; only the newest counts.
    virtual void steer(const Steering& steering) = 0;
    // The hands before the wall; only the newest count.
    virtual void touch(const WallHands& hands) = 0;
    // Asks what goes on in the mind of a fish; ShowListener::explained has the answer.
    virtual void explain(std::uint32_t fish) = 0;
    // Asks for the picture of a drawing; ShowListener::listed has the answer. Only the last counts.
    virtual void askSkin(std::uint32_t number) = 0;
};

// Asks the master for its state, and tells it what is wanted, on a thread of its own.
class ShowLink final : public MasterProxy {
  public:
    // Throws Error where the master's address or the key cannot be read.
    ShowLink(const ask::AskedMaster& master, ShowListener listener);
    ~ShowLink() override;
    ShowLink(const ShowLink&) = delete;
    ShowLink& operator=(const ShowLink&) = delete;

    void give(v1::Order order) override;
    void steer(const Steering& steering) override;
    void touch(const WallHands& hands) override;
    void explain(std::uint32_t fish) override;
    void askSkin(std::uint32_t number) override;

  private:
    void run();
    void work();
    void hearDrawings(const v1::StatusReply& status);
    void press(v1::Order& order);
    void giveAgain(v1::Order order);

    ask::RequestClient client_;
    ShowListener listener_;
    // Run of the master and version of its drawings, as they were last listed.
    std::pair<std::uint64_t, std::uint64_t> listed_{};
    std::mutex mutex_;  // guards what follows
    std::condition_variable changed_;
    bool ended_ = false;
    // Not sent yet.
    std::deque<v1::Order> wanted_;
    bool hasNew_ = false;  // one of them was not given before
    std::optional<Steering> steering_;
    std::optional<WallHands> hands_;
    std::optional<std::uint32_t> fish_;
    std::uint32_t skin_ = 0;  // of this drawing; 0: none
    std::thread thread_;
};

}  // namespace aquarama::console
