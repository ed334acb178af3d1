// SPDX-License-Identifier: Apache-2.0
// The show: one loop hears what peers say, carries it to the parts of the show, and has all nodes
// present each frame together.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/base/log.h"
#include "common/config/rig.h"
#include "common/machine/service_notifier.h"
#include "common/net/channels.h"
#include "common/wire/parts.h"
#include "master/conductor/drawings.h"
#include "master/conductor/gauges.h"
#include "master/conductor/journal_report.h"
#include "master/conductor/looks.h"
#include "master/conductor/orders.h"
#include "master/conductor/presentation.h"
#include "master/conductor/roster.h"
#include "master/conductor/scene_day.h"
#include "master/conductor/sender.h"
#include "master/conductor/simulation.h"
#include "master/conductor/simulation_thread.h"
#include "master/conductor/standby_feed.h"
#include "master/conductor/visitor_inputs.h"

namespace aquarama::conductor {

// How a show is conducted.
struct ConductorOptions {
    wire::Pace pace = wire::Pace::Live;
    v1::WantedShow wanted = {};        // at first
    v1::WantedShow kept = {};          // what was set in earlier runs, part of `wanted`
    std::filesystem::path keptAt;      // where that is kept; empty: nowhere
    std::filesystem::path drawingsAt;  // folder of visitors' drawings; empty: nowhere
    LookSources looks;
    std::string whyOneScene = "this master has one scene only";  // without LookSources::makeWorld
    std::optional<std::uint64_t> frames;                         // the show ends after so many
    std::vector<std::string> expected;     // the channels that take part; empty: all of the rig
    std::filesystem::path traceDirectory;  // for master.csv; empty: none
    std::string guestsKey;          // public key of the guests' program; empty: a rig without keys
    std::filesystem::path hoursAt;  // hours of the hall, for scenes that follow it
    std::shared_ptr<const JournalReport> journal;  // of the world; null: nothing is known of it
    LogFile* log = nullptr;                        // of the whole show; null: none
    machine::ServiceNotifier* service = nullptr;   // hears of every turn of the loop; null: nobody
    // Of a rig with a standby: the name of this machine; whether another one goes on as the master,
    // so that the show ends here and no node is told; gives up being the master.
    std::string machine = {};
    std::function<bool()> isSuperseded = [] { return false; };
    std::function<void()> resign = {};
    // Lockstep: silence of a node that ends the show.
    net::Duration patience = std::chrono::seconds(60);
};

// The light of the wall, and its way through black to the next scene.
struct Dimming {
    float brightness = 1.0F;           // of the last frame
    std::optional<net::Moment> since;  // on that way
    std::optional<Frame> black;        // the first without light, on that way
};

// Conducts one show in the thread that calls run(); the world advances in a thread of its own.
class Conductor final : private FrameSource {
  public:
    // `simulation` is the world of these assets and this school, and outlives the conductor. Throws
    // Error where the trace cannot be written.
    Conductor(const config::Rig& rig,
              ConductorOptions options,
              Simulation& simulation,
              const wire::AssetBundle& assets,
              std::span<const motion::FishTraits> school,
              std::unique_ptr<net::MasterChannels> channels);
    ~Conductor() override;
    Conductor(const Conductor&) = delete;
    Conductor& operator=(const Conductor&) = delete;

    // Until the frames are done, a node asks to quit, or stop(). Throws Error where a node of a
    // lockstep show stays silent.
    ShowReport run();
    void stop();  // from any thread

  private:
    std::optional<Snapshot> takeTick() override;
    const v1::Show& showOf(Frame frame, net::Moment now) override;
    void onReleased(Frame frame) override;

    // Messages. `node` is a place in the roster.
    void hear(net::Moment now);  // all that has arrived, within bounds
    void take(const net::FromPeer& from, const v1::Envelope& message, net::Moment now);
    void takeOfNode(std::size_t node, const v1::Envelope& message, net::Moment now);
    void takePart(const net::FromPeer& from, const v1::PacketPart& part, net::Moment now);
    void takeInput(const net::FromPeer& from,
                   std::optional<std::size_t> node,
                   const v1::Input& input,
                   net::Moment now);
    // Answers a hello: welcome, refusal, or a dismissal while another node has the channel.
    void greet(const net::PeerId& peer, const v1::Hello& hello, net::Moment now);
    [[nodiscard]] std::string objectionTo(const v1::Hello& hello) const;
    void pong(const net::PeerId& peer, std::int64_t sentNs) const;
    // A line of a node's log, into the log of the show.
    void note(NodeSeat& seat, const v1::LogLine& line) const;
    // The node has built a look. The one that is shown: from the next frame on it is waited for.
    void prepared(std::size_t node, const v1::Prepared& prepared, net::Moment now);
    void admit(std::size_t node, net::Moment now);
    void leave(std::size_t node);
    void giveKeyframe(const net::PeerId& peer);
    void giveChunk(const net::PeerId& peer, const v1::BlobRequest& request);
    void obey(const net::FromPeer& from, const v1::Order& order, net::Moment now);
    // Makes the answer *waiting* where what an order has set is not on the disk yet.
    void awaitDisk(const v1::WantedShow& change, v1::OrderReply& reply, net::Moment now);
    // The standby is to be the master from now on.
    [[nodiscard]] v1::OrderReply changeMaster(const std::string& user, const v1::Order& order);
    void resign();
    void tellDrawings(const net::PeerId& peer, const v1::DrawingsRequest& request) const;
    [[nodiscard]] v1::Envelope status(net::Moment now) const;
    // A packet counts as refused unless it was accepted.
    void countRefused(bool isAccepted) { report_.refusedPackets += isAccepted ? 0U : 1U; }

    // A step of the change that is under way.
    void changeShow(net::Moment now);
    void startSimulation(std::uint32_t fish);
    // Sends the standby what there is for it.
    void feedStandby(net::Moment now);
    // What becomes of visitors' drawings, once a second, by where the fish of a tick are.
    void turnDrawings(const Snapshot& newest);
    // Brings an input to the world; `what` is logged where too many wait already.
    bool bring(const world::WorldInput& input, const char* what);
    // What the wall shows now, with the brightness of the last frame.
    [[nodiscard]] v1::Show shown(net::Moment now) const;
    // The channel of the window that steers, "pilot" for anybody else, empty for nobody.
    [[nodiscard]] std::string pilotName(net::Moment now) const;
    // In the log, every few seconds: nodes of other machines are started by other hands.
    void nameMissing(net::Moment now);
    void sayFarewell();
    [[nodiscard]] bool isLockstep() const { return options_.pace == wire::Pace::Lockstep; }

    ConductorOptions options_;
    std::unique_ptr<net::MasterChannels> channels_;
    Sender sender_;
    Roster roster_;
    wire::PartAssembly parts_;
    Drawings drawings_;
    SceneDay day_;
    Orders orders_;
    Looks looks_;
    ShowKeeper keeper_;
    Gauges gauges_;
    ShowReport report_;
    Presentation presentation_;
    VisitorInputs visitors_;
    StandbyFeed standby_;
    Watchdog watchdog_;
    Simulation* simulation_;
    std::unique_ptr<Simulation> own_;  // simulation_, after a change of scene
    std::future<void> retiring_;       // of the world before
    bool windowsEndShow_;
    std::atomic<bool> isOver_ = false;
    net::Moment lastRoll_ = net::monotonicNow();  // when missing nodes were last named
    v1::Show shown_;                              // of the frame that was last published
    Dimming dimming_;
    std::unique_ptr<SimulationThread> simulationThread_;  // last: it uses all of the above
};

}  // namespace aquarama::conductor
