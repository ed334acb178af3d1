// SPDX-License-Identifier: Apache-2.0
// The way of visitors to the master of a show: what the wall says of itself, and what they do to
// it.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <glm/vec3.hpp>

#include "common/ask/request_client.h"
#include "common/base/units.h"
#include "common/wire/state_codec.h"
#include "guests/deed.h"

namespace aquarama::guests {

// A visitor's drawing, as the wall has it.
struct WallDrawing {
    // Waiting: for the crew. Homeless: let in, but the scene has no room for its species.
    enum class Condition : std::uint8_t { Waiting, Swimming, Homeless, Leaving };
    Condition condition = Condition::Waiting;
    std::optional<std::uint32_t> fish;  // that wears it
};
// By their numbers.
using WallDrawings = std::map<std::uint32_t, WallDrawing>;

// A wall that answers.
struct WallState {
    bool isOpen = false;  // to visitors
    wire::Eye eye;
    std::shared_ptr<const WallDrawings> drawings = {};  // null: visitors' drawings may not swim
};

// A drawing that is to swim.
struct OfferedSkin {
    std::uint64_t request = 0;  // ask::freshRequest()
    std::string species, skin;
    int aside = 0;  // where its maker stands: -1 left, 0 middle, 1 right
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
    // Lets a drawing swim; WallListener::offered has the answer.
    virtual void offer(OfferedSkin skin) = 0;
    // From now on WallListener::does says what these fish do.
    virtual void watch(const std::set<std::uint32_t>& fish) = 0;
};

// What the wall says, from the link's thread.
struct WallListener {
    // Ten times a second; nothing: nobody answers.
    std::function<void(const std::optional<WallState>&)> heard;
    // The number of a drawing; 0: there is no room for it.
    std::function<void(std::uint64_t request, std::uint32_t number)> offered;
    // Of one fish, once a second at most.
    std::function<void(std::uint32_t fish, const FishDeed&)> does;
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

    // The listener is called until end().
    void begin(WallListener listener);
    void end();

    void steer(const Steering& steering) override;
    void feed(const glm::vec3& position) override;
    void show(const wire::Sign& sign) override;
    void offer(OfferedSkin skin) override;
    void watch(const std::set<std::uint32_t>& fish) override;

  private:
    // What is to be said.
    struct Wishes {
        std::optional<Steering> steering;
        std::vector<glm::vec3> food;
    };
    void run();
    void work(const Wishes& wishes);
    void showSign();
    void lookAtDrawings(const v1::StatusReply& status);
    void offerNext();
    void explainNext();
    // Changes what is guarded, and wakes the thread.
    void set(const std::function<void()>& change);

    ask::RequestClient client_;
    WallListener listener_;
    // Of the thread.
    net::Moment signShown_{};
    std::shared_ptr<const WallDrawings> drawings_;
    std::uint64_t drawingsVersion_ = 0;               // of drawings_
    std::map<std::uint32_t, net::Moment> explained_;  // when each fish was asked for last
    std::mutex mutex_;                                // guards what follows
    std::condition_variable changed_;
    bool ended_ = false;
    Wishes wishes_;
    wire::Sign sign_;
    bool isNewSign_ = false;
    std::deque<OfferedSkin> offers_;  // without an answer
    std::set<std::uint32_t> watched_;
    std::thread thread_;
};

}  // namespace aquarama::guests
