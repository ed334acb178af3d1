// SPDX-License-Identifier: Apache-2.0
// The way of visitors to the master of a show: what the wall says of itself, and what they do to
// it.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <glm/vec3.hpp>

#include "common/ask/request_client.h"
#include "common/base/units.h"
#include "common/wire/state_codec.h"

namespace aquarama::guests {

// A wall that answers.
struct WallState {
    bool isOpen = false;  // to visitors
    wire::Eye eye;
};

// What visitors do to the wall. From any thread; no function waits.
class VisitedWall {
  public:
    virtual ~VisitedWall() = default;
    // How the submarine is steered, from now on for half a second; only the newest counts.
    virtual void steer(const Steering& steering) = 0;
    // Drops food at a point of the world, in metres.
    virtual void feed(const glm::vec3& position) = 0;
    // Draws this sign until the next.
    virtual void show(const wire::Sign& sign) = 0;
};

// The master's, on a thread of its own. It is asked ten times a second, and told of a hand thirty
// times at most.
class WallLink final : public VisitedWall {
  public:
    // Throws Error where the master's address or the key cannot be read.
    explicit WallLink(const ask::AskedMaster& master) : client_{master.connect()} {}
    ~WallLink() override { end(); }
    WallLink(const WallLink&) = delete;
    WallLink& operator=(const WallLink&) = delete;

    // `heard` is called from the link's thread until end(); nothing: nobody answers.
    void begin(std::function<void(const std::optional<WallState>&)> heard);
    void end();

    void steer(const Steering& steering) override;
    void feed(const glm::vec3& position) override;
    void show(const wire::Sign& sign) override;

  private:
    // What is to be said.
    struct Wishes {
        std::optional<Steering> steering;
        std::vector<glm::vec3> food;
    };
    void run();
    void work(const Wishes& wishes);
    void showSign();
    // Changes what is guarded, and wakes the thread.
    void set(const std::function<void()>& change);

    ask::RequestClient client_;
    std::function<void(const std::optional<WallState>&)> heard_;
    net::Moment signShown_{};  // of the thread
    std::mutex mutex_;         // guards what follows
    std::condition_variable changed_;
    bool ended_ = false;
    Wishes wishes_;
    wire::Sign sign_;
    bool isNewSign_ = false;
    std::thread thread_;
};

}  // namespace aquarama::guests
