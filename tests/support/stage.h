// SPDX-License-Identifier: Apache-2.0
// A show in one process: a conductor and nodes in threads of their own, over real sockets or in
// memory, and what happened in which order.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <unistd.h>

#include "common/base/log.h"
#include "common/config/rig.h"
#include "common/motion/repertoire.h"
#include "master/conductor/conductor.h"
#include "render_node/session/session.h"
#include "tests/support/memory_channels.h"
#include "tests/support/messages.h"

namespace aquarama::test {

// Fish whose position is the tick.
class CountingWorld final : public conductor::Simulation {
  public:
    void advance() override { ++tick_.value; }
    Tick tick() const override { return tick_; }
    // One pellet where each was dropped, while there is room; a hand moves the eye.
    void apply(const world::WorldInput& input) override {
        if (const auto* steering = std::get_if<Steering>(&input)) ahead_ = steering->ahead;
        const auto* drop = std::get_if<world::DropFood>(&input);
        const auto room = std::ranges::find(food_, wire::FoodRecord{});
        if (drop != nullptr && room != food_.end())
            *room =
                wire::foodRecord(wire::FoodRecord::Kind::Pellet, drop->position - kFoodOrigin, 0);
    }
    std::uint64_t hash() const override { return hashAt(tick_); }
    // The eye is as many metres ahead as the last hand asked for.
    conductor::Snapshot snapshot() const override {
        const motion::FishRecord fish{.x = static_cast<std::int32_t>(tick_.value)};
        return {.tick = tick_,
                .hash = hashAt(tick_),
                .eye = {.positionMetres = {0, 0, -static_cast<float>(ahead_)}},
                .timeOfDay = timeOfDayAt(tick_),
                .fish = {fish, fish, fish},
                .food = {kFoodOrigin, food_}};
    }
    conductor::Explanation explain(std::uint32_t /*fish*/) const override {
        using Kind = conductor::NearestSeen::Kind;
        return {.lines = {"at tick " + std::to_string(tick_.value)},
                .intention = fish::Intention::AvoidFish,
                .target = "#1 tang",
                .pursuedSeconds = 1.5F,
                .feelings = {.hunger = 0.25F, .libido = 0.5F, .fear = 0.75F},
                .seen = {{Kind::Food, "particle 7", 4, -90}, {Kind::Prey, "#1 tang", 2, 30}}};
    }
    static float timeOfDayAt(Tick tick) { return 1.0F / static_cast<float>(1 + tick.value); }
    static constexpr glm::vec3 kFoodOrigin{1, 2, 3};
    static std::uint64_t hashAt(Tick tick) { return tick.value * 0x9E3779B97F4A7C15U + 1; }

  private:
    Tick tick_;
    std::int8_t ahead_ = 0;
    std::vector<wire::FoodRecord> food_{8};
};

struct Event {
    enum class Kind : std::uint8_t { Ready, Presented, Built } kind;  // Built: a look
    std::string node;
    wire::StateFrame state;
};

// What all nodes did, in the order in which they did it: ready is noted before it is said,
// presented after the release has come.
class Journal {
  public:
    void note(Event event) {
        const std::lock_guard lock(mutex_);
        events_.push_back(std::move(event));
        grown_.notify_all();
    }
    // Of frames.
    std::vector<Event> events() const {
        std::vector<Event> events = allEvents();
        std::erase_if(events, [](const Event& event) { return event.kind == Event::Kind::Built; });
        return events;
    }
    std::vector<Event> allEvents() const {
        const std::lock_guard lock(mutex_);
        return events_;
    }
    std::uint64_t presentedBy(const std::string& node) const {
        const std::lock_guard lock(mutex_);
        return presented(node);
    }
    // Waits until an event of this kind is noted. False: none came within half a minute.
    template <class IsIt>
    bool await(IsIt isIt) {
        std::unique_lock lock(mutex_);
        return grown_.wait_for(
            lock, std::chrono::seconds(30), [&] { return std::ranges::any_of(events_, isIt); });
    }
    // False: it did not come to it within half a minute.
    bool awaitPresented(const std::string& node, std::uint64_t frames) {
        std::unique_lock lock(mutex_);
        return grown_.wait_for(
            lock, std::chrono::seconds(30), [&] { return presented(node) >= frames; });
    }

  private:
    std::uint64_t presented(const std::string& node) const {
        return static_cast<std::uint64_t>(std::ranges::count_if(events_, [&](const Event& event) {
            return event.kind == Event::Kind::Presented && event.node == node;
        }));
    }
    mutable std::mutex mutex_;
    std::condition_variable grown_;
    std::vector<Event> events_;
};

// A connection that can be cut without either end noticing: what a frozen or dead process is like.
class Cable {
  public:
    explicit Cable(net::Connect connect) : connect_(std::move(connect)) {}
    std::unique_ptr<net::NodeChannels> plug() { return std::make_unique<Cut>(connect_(), cut_); }
    void cut(bool isCut) { *cut_ = isCut; }

  private:
    class Cut final : public net::NodeChannels {
      public:
        Cut(std::unique_ptr<net::NodeChannels> inner, std::shared_ptr<std::atomic<bool>> cut)
            : inner_(std::move(inner)), cut_(std::move(cut)) {}
        void sendControl(net::ByteView bytes) override {
            if (!*cut_) inner_->sendControl(bytes);
        }
        std::optional<net::ByteVector> receiveControl() override {
            return *cut_ ? std::nullopt : inner_->receiveControl();
        }
        void subscribeState(const std::string& address) override {
            inner_->subscribeState(address);
        }
        std::optional<net::ByteVector> receiveState() override {
            return *cut_ ? std::nullopt : inner_->receiveState();
        }
        void wait(net::Duration atMost) override {
            if (*cut_) std::this_thread::sleep_for(std::min(atMost, net::Duration{5'000'000}));
            if (!*cut_) inner_->wait(atMost);
        }
        void wake() override { inner_->wake(); }

      private:
        std::unique_ptr<net::NodeChannels> inner_;
        std::shared_ptr<std::atomic<bool>> cut_;
    };

    net::Connect connect_;
    std::shared_ptr<std::atomic<bool>> cut_ = std::make_shared<std::atomic<bool>>(false);
};

inline std::filesystem::path freshDirectory() {
    static std::atomic<int> count = 0;
    auto path = std::filesystem::temp_directory_path() /
                ("aquarama-stage-" + std::to_string(getpid()) + "-" + std::to_string(++count));
    std::filesystem::create_directories(path);
    return path;
}

// Of fish that are all placed at every tick, as those of CountingWorld: no motor moves them.
inline std::shared_ptr<school::SchoolMotion> stillMotion(const session::Admission& admission) {
    return std::make_shared<school::SchoolMotion>(std::vector<school::Swimmers>{},
                                                  admission.school,
                                                  place::Obstacles{},
                                                  config::SceneCurrent{});
}

// A render node that draws nothing.
class StageNode {
  public:
    struct Habits {
        net::Duration drawing{};   // a frame
        net::Duration starting{};  // before it says hello at all
        net::Duration building{};  // between welcome and prepared
    };

    StageNode(std::string name, net::Connect connect, Journal& journal)
        : StageNode(std::move(name), std::move(connect), journal, Habits{}) {}
    StageNode(std::string name, net::Connect connect, Journal& journal, Habits habits)
        : name_(std::move(name)),
          journal_(journal),
          habits_(habits),
          cable_(std::move(connect)),
          blobs_(freshDirectory()),
          session_(session::makeSession(
              name_, [this] { return cable_.plug(); }, blobs_)),
          thread_([this] { live(); }) {}
    ~StageNode() {
        session_->stop();
        thread_.join();
        session_.reset();
        std::filesystem::remove_all(blobs_);
    }
    StageNode(const StageNode&) = delete;
    StageNode& operator=(const StageNode&) = delete;

    void freeze() { cable_.cut(true); }
    void thaw() { cable_.cut(false); }
    session::Session& session() { return *session_; }
    // How often a master has welcomed it.
    int joins() const { return joins_; }
    // Why it was refused; empty while it was not.
    std::string refusal() const {
        const std::lock_guard lock(mutex_);
        return refusal_;
    }

  private:
    void live() try {
        std::this_thread::sleep_for(habits_.starting);
        while (const auto admission = session_->join()) {
            ++joins_;
            build(*admission);
            if (show() == session::Release::Quit) return;
        }
    } catch (const Error& error) {
        const std::lock_guard lock(mutex_);
        refusal_ = error.what();
    }

    void build(const session::Admission& admission) {
        std::this_thread::sleep_for(habits_.building);
        wire::StateFrame built;
        built.show.look = admission.look;
        journal_.note({Event::Kind::Built, name_, built});
        session_->prepared(admission.look, config::QualityTier::Low, stillMotion(admission));
    }

    session::Release show() {
        while (auto state = session_->nextFrame()) {
            const Frame frame = state->frame;
            if (session_->renumbered()) ++joins_;  // beside the frames
            // Beside the frames, as a node does.
            if (const auto next = session_->nextLook())
                building_ = std::async(std::launch::async, [this, next = *next] { build(next); });
            std::this_thread::sleep_for(habits_.drawing);
            journal_.note({Event::Kind::Ready, name_, *state});
            const session::Release release = session_->readyThenWait(frame);
            if (release == session::Release::Rejoin || release == session::Release::Quit)
                return release;
            if (release == session::Release::Present && !session_->isReckoned()) {
                journal_.note({Event::Kind::Presented, name_, std::move(*state)});
            }
        }
        return session_->interruption();
    }

    std::string name_;
    Journal& journal_;
    Habits habits_;
    Cable cable_;
    std::filesystem::path blobs_;
    std::atomic<int> joins_ = 0;
    mutable std::mutex mutex_;
    std::string refusal_;
    std::unique_ptr<session::Session> session_;
    std::future<void> building_;
    std::thread thread_;
};

// The master of a desk, with its conductor in a thread.
class StageMaster {
  public:
    explicit StageMaster(const conductor::ConductorOptions& options,
                         const std::string& control = "tcp://127.0.0.1:*",
                         const config::Rig& rig = deskRig())
        : StageMaster(options, net::bindMaster(control, "tcp://127.0.0.1:*"), rig) {}
    StageMaster(const conductor::ConductorOptions& options,
                std::unique_ptr<net::MasterChannels> channels,
                const config::Rig& rig = deskRig())
        : control_(channels->controlAddress()),
          conductor_(rig, options, world_, assets(), school(), std::move(channels)),
          thread_([this] { conduct(); }) {}
    ~StageMaster() {
        conductor_.stop();
        if (thread_.joinable()) thread_.join();
    }
    StageMaster(const StageMaster&) = delete;
    StageMaster& operator=(const StageMaster&) = delete;

    static config::Rig deskRig() {
        config::Rig rig = config::readRig(AQUARAMA_SOURCE_DIR "/config/desk.txtpb");
        rig.timing.presentDeadlineSeconds = 0.05;  // a busy machine's scheduler, three times over
        rig.timing.membershipSeconds = 0.5;
        return rig;
    }

    const std::string& control() const { return control_; }
    net::Connect connect() const {
        return [address = control_] { return net::connectNode(address); };
    }
    conductor::Conductor& conductor() { return conductor_; }
    // Waits for the end of the show.
    conductor::ShowReport report() {
        thread_.join();
        return report_;
    }
    const std::string& failure() const { return failure_; }  // after report()

    // Several chunks long.
    static const net::ByteVector& repertoire() {
        static const net::ByteVector bytes = [] {
            motion::Repertoire still;
            still.species = "scad";
            still.recordedLengthMetres = 0.2F;
            for (motion::ActionSegment& segment : still.segments) {
                segment.periodSeconds = 1.0F;
                segment.controlPoints.resize(motion::kPhases);
            }
            return motion::encodeRepertoire(still);
        }();
        return bytes;
    }
    static wire::AssetBundle assets() {
        return {
            .seed = 77,
            .sceneFile = "reef",
            .scene = config::readTextFile(AQUARAMA_SOURCE_DIR "/config/scenes/reef.txtpb"),
            .cast = {{"scad",
                      config::readTextFile(AQUARAMA_SOURCE_DIR "/config/species/bigeye_scad.txtpb"),
                      repertoire(),
                      3}}};
    }
    static std::vector<motion::FishTraits> school() { return {{1, 200}, {2, 210}, {3, 220}}; }

  private:
    void conduct() try { report_ = conductor_.run(); } catch (const Error& error) {
        failure_ = error.what();
    }

    std::string control_;
    CountingWorld world_;
    conductor::ShowReport report_;
    std::string failure_;
    conductor::Conductor conductor_;
    std::thread thread_;
};

}  // namespace aquarama::test
