// SPDX-License-Identifier: Apache-2.0
// The show: welcomes nodes, publishes states, and has all nodes present each frame together.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/base/digest.h"
#include "common/base/log.h"
#include "common/base/output_file.h"
#include "common/config/keys.h"
#include "common/config/rig.h"
#include "common/machine/service_notifier.h"
#include "common/motion/motor.h"
#include "common/net/blob.h"
#include "common/net/channels.h"
#include "common/net/metrics.h"
#include "common/wire/recording.h"
#include "master/conductor/present_barrier.h"
#include "master/conductor/show_control.h"
#include "master/conductor/simulation.h"
#include "master/conductor/simulation_thread.h"
#include "master/conductor/steering.h"

namespace aquarama::v1 {  // generated: only the sources of this folder see more of them
class BlobRequest;
class Envelope;
class Hello;
class HeldScan;
class Input;
class LogLine;
class Look;
class NodeReport;
class Order;
class OrderReply;
class Prepared;
class Ready;
class Welcome;
}  // namespace aquarama::v1

namespace aquarama::conductor {

// A world that a show changes to, and the files that it was made from.
struct NextWorld {
    wire::AssetBundle assets;
    std::vector<motion::FishTraits> school;
    std::unique_ptr<Simulation> simulation;
};

// How a show is conducted.
struct ConductorOptions {
    wire::Pace pace = wire::Pace::Live;
    WantedShow wanted = {};        // at first
    ShowChange kept = {};          // what was set in earlier runs, part of `wanted`
    std::filesystem::path keptAt;  // where that is kept; empty: nowhere
    // Of a scene, by its name; called from a thread of its own, throws Error. Null: the show keeps
    // its scene, for the reason that follows.
    std::function<NextWorld(const std::string& scene)> makeWorld;
    std::string whyOneScene = "this master has one scene only";
    // The rig with the files that it names, where they are others than at the call before; called
    // once a second from a thread of its own. Throws Error where they cannot be used. Null: they
    // never change.
    std::function<std::optional<config::Rig>()> changedRig;
    std::optional<std::uint64_t> frames;   // the show ends after so many
    std::vector<std::string> expected;     // the channels that take part; empty: all of the rig
    std::filesystem::path traceDirectory;  // for master.csv; empty: none
    LogFile* log = nullptr;                // of the whole show; null: none
    machine::ServiceNotifier* service =
        nullptr;  // hears of every turn of the frame loop; null: nobody
    net::Instant patience =
        std::chrono::seconds(60);  // lockstep: silence of a node that ends the show
};

// What nodes fetch, by digest.
using Blobs = std::map<Digest, net::Blob>;
// The species files and repertoires of a show.
[[nodiscard]] Blobs blobsOf(const wire::AssetBundle& assets);

// What nodes build for a scene; the conductor adds number, quality and whether the world is drawn.
// `school` has the fish of all species of the assets, in their order.
[[nodiscard]] v1::Look lookOf(const wire::AssetBundle& assets,
                              std::span<const motion::FishTraits> school);

// Whose key a connection has shown.
struct User {
    config::KeyRole role = config::KeyRole::Watcher;
    std::string name;  // of a node: its channel
};
// As the channels name it (net::Allowed): "node left", and back.
[[nodiscard]] std::string userOf(config::KeyRole role, const std::string& name);
[[nodiscard]] std::optional<User> userIn(const std::string& text);
// Whether the holder of a key may say this to the master.
[[nodiscard]] bool maySay(const User& user, const v1::Envelope& message);

// What a show came to.
struct ShowReport {
    std::uint64_t frames = 0;  // presented
    Tick tick;                 // the last that was shown
    std::uint64_t worldHash = 0;
    std::uint64_t refusedPackets = 0;
};

// Conducts one show in the thread that calls run(); the world advances in a thread of its own.
class Conductor {
  public:
    // `simulation` is the world of these assets and this school, and outlives the conductor. Throws
    // Error where the trace cannot be written.
    Conductor(const config::Rig& rig,
              ConductorOptions options,
              Simulation& simulation,
              const wire::AssetBundle& assets,
              std::span<const motion::FishTraits> school,
              std::unique_ptr<net::MasterChannels> channels);
    ~Conductor();
    Conductor(const Conductor&) = delete;
    Conductor& operator=(const Conductor&) = delete;

    // Until the frames are done, a node asks to quit, or stop(). Throws Error where a node of a
    // lockstep show stays silent.
    ShowReport run();
    void stop();  // from any thread

  private:
    // A channel of the rig, and who drives it.
    struct ChannelSlot {
        std::string name;
        net::PeerId peer;  // empty: nobody
        bool prepared = false;
        std::uint32_t builtLook = 0;               // the newest that its node has built
        std::optional<config::QualityTier> bears;  // the finest tier that its node has kept up with
        net::Instant lastHeard{};
        std::string machine;  // empty: the master's
        std::uint64_t dropped = 0;
        std::uint64_t mismatches = 0;  // states that its node decoded to another hash
        std::shared_ptr<const v1::NodeReport> report;  // its node's last
        std::optional<net::Blanks> blanks;             // of its display, in the master's clock
        net::Instant lastFed{};      // when a visitor last dropped food in its window
        std::uint64_t logLines = 0;  // of its node, in this second
        net::RecentPeak pictures;    // how long those of its node take
        Frame released;              // the newest that its node says it has shown
    };

    // What is counted for Prometheus.
    struct NodeFigures {
        net::Record condition, late, dropped, mismatches, roundTrip, drift, celsius;
    };
    struct Figures {
        net::Record frameSeconds, skewSeconds, frames, fish, bytes, refused, black;
        std::vector<NodeFigures> nodes;
    };
    [[nodiscard]] Figures makeFigures();
    // Once a second.
    void count(net::Instant now);
    // To the service manager, as long as ticks come.
    void sayAlive(net::Instant now);

    // Messages (reception.cpp). `node` is a place in slots_; a peer may be none of them.
    void hear(net::Instant now);  // all that has arrived, within bounds
    // `user`: whose key the peer has shown; empty where no keys are needed.
    void take(const net::FromPeer& from, const v1::Envelope& message, net::Instant now);
    // Counts and names what a user may not say.
    void refuse(const std::string& user, const v1::Envelope& message);
    // Whether the holder of a key may ask or be welcomed once more in this second.
    [[nodiscard]] bool isWithinRate(const std::string& user, net::Instant now);
    // The place of the node that speaks. A node that shows its key and knows this run is the same
    // one over another connection.
    [[nodiscard]] std::optional<std::size_t> speaker(const net::FromPeer& from,
                                                     const v1::Envelope& message);
    // Steering and food of a peer that is no node.
    void takeOfVisitor(const net::FromPeer& from, const v1::Input& input, net::Instant now);
    // Of a node that takes part in this run.
    void takeOfNode(std::size_t node, const v1::Envelope& message, net::Instant now);
    // Answers a hello: welcome, refusal, or a dismissal while another node has the channel.
    void greet(const net::PeerId& peer, const v1::Hello& hello, net::Instant now);
    [[nodiscard]] std::string objectionTo(const v1::Hello& hello) const;
    void pong(std::size_t node, std::int64_t sentNs);
    // Its picture of a frame is finished.
    void ready(std::size_t node, const v1::Ready& ready, net::Instant now);
    // A line of its log, into the log of the show.
    void note(std::size_t node, const v1::LogLine& line);
    // It has built a look. The one that is shown: from the next frame on it is waited for.
    void prepared(std::size_t node, const v1::Prepared& prepared);
    void admit(std::size_t node);
    void giveChunk(const net::PeerId& peer, const v1::BlobRequest& request);
    void dismiss(const net::PeerId& peer, const std::string& why);
    // The node is counted no more: it has fallen silent, or has said farewell.
    void vacate(std::size_t node);
    void leave(std::size_t node);
    void handle(std::size_t node, const v1::Input& input, net::Instant now);
    // What the show shall be.
    void obey(const net::FromPeer& from, const v1::Order& order, net::Instant now);
    [[nodiscard]] Answer carryOut(const std::string& user,
                                  const v1::Order& order,
                                  net::Instant now);
    [[nodiscard]] Answer change(const std::string& user, const v1::Order& order);
    // Why a change is refused; empty where it is not.
    [[nodiscard]] std::string objectionTo(const v1::WantedShow& show) const;
    // A scan takes the wall, says its pattern again, or gives the wall back.
    [[nodiscard]] Answer scan(const std::string& user, const v1::HeldScan& scan, net::Instant now);
    // A node is to end; the same request again does nothing more.
    [[nodiscard]] Answer restart(const std::string& user, const v1::Order& order);
    // Why a node cannot be ended by a word; empty where it can.
    [[nodiscard]] std::string objectionToEnding(const std::string& channel) const;
    // A node leaves the word for its machine; the same request again hears what became of it.
    struct PowerRequest {
        std::uint64_t request = 0;
        std::size_t node = 0;
        net::Instant said{};
        std::optional<Answer> answer = {};  // of the node; none: not answered yet
    };
    [[nodiscard]] Answer switchMachine(const std::string& user,
                                       const v1::Order& order,
                                       net::Instant now);
    // Why no machine is told; empty where it is.
    [[nodiscard]] std::string objectionToPower(const v1::Order& order) const;
    // What has become of it.
    [[nodiscard]] Answer answerTo(const PowerRequest& request, net::Instant now) const;
    // The node has left the word, or says why it has not.
    void switched(std::size_t node, const v1::OrderReply& reply);
    [[nodiscard]] std::string objectionToScan() const;
    // The channels that have not shown the pattern of the scan yet; empty where all have.
    [[nodiscard]] std::string notShowingScan() const;
    [[nodiscard]] Frame newestReleased() const;
    [[nodiscard]] std::string objectionToScene(const std::string& scene) const;
    [[nodiscard]] std::string objectionToQuality(v1::WantedShow::Tier quality) const;
    // Inputs, passed on to the tick thread where they are in bounds.
    void feed(net::Instant& lastFed, glm::vec3 positionMetres, net::Instant now);
    void steer(const net::PeerId& peer, const Steering& steering, net::Instant now);
    // A question about a mind goes to the tick thread; answer() sends what came back.
    void ask(const net::PeerId& peer, std::uint32_t fish);
    void answer();
    [[nodiscard]] v1::Envelope status(net::Instant now) const;
    // The channel of the window that steers, "pilot" for anybody else, empty for nobody.
    [[nodiscard]] std::string pilotName(net::Instant now) const;
    // The tier of the whole wall: as chosen, or the finest that every node bears.
    [[nodiscard]] config::QualityTier quality() const;

    // Changes of the show (changes.cpp), a step at each turn of the loop.
    void changeShow(net::Instant now);
    void makeNextWorld();
    // Measured screens and wall files are looked at once a second, and taken where they changed.
    void watchRigFiles(net::Instant now);
    // The files that the rig names, by name.
    using RigFiles = std::map<std::string, Digest>;
    static void nameRigFiles(v1::Look& look, const RigFiles& files);
    // Large, and asked for no more: what `old` names and `kept` does not.
    void forgetRigFiles(const RigFiles& old, const RigFiles& kept);
    void announceNextLook(net::Instant now);
    void prepareNodes(net::Instant now);
    void giveUpNextLook(const std::string& missing);
    void switchLook();
    void startSimulation();
    void keepWhatWasSet();
    // What nodes are told of the look that is shown: in a welcome, and its name in each frame.
    void welcomeToLook();
    // What the wall shows now, with the brightness of the last frame; and of a frame to be
    // published.
    [[nodiscard]] wire::Show shown(net::Instant now) const;
    void dim(net::Instant now, Frame frame);
    // The tier that every node has measured that it bears; nothing where one has not.
    [[nodiscard]] std::optional<config::QualityTier> measuredTier() const;

    // Frames. `now` is the moment at which this turn of the loop began.
    void noteEye(const wire::StateView& state);
    void takeTicks();                  // from the tick thread into snapshots_
    void conduct(net::Instant now);    // asks the barrier, and does what it decides
    void beginNext(net::Instant now);  // as soon as there is somebody to draw it
    void release(net::Instant now);    // of the frame that is drawn, to all prepared nodes
    bool publish(Frame frame, net::Instant now);
    // Sends the last two states once more, for nodes that missed them.
    void publishAgain(net::Instant now);
    // When a frame that is ready now is shown, not before the release can have reached every node:
    // releaseTime() for the displays of those who are waited for.
    [[nodiscard]] net::Instant nextRelease(net::Instant now) const;
    [[nodiscard]] net::Instant releaseOf(Frame frame, net::Instant now) const;
    [[nodiscard]] net::Instant untilDue() const;
    // Of a node's display, where they can be believed.
    [[nodiscard]] std::optional<net::Blanks> blanksIn(const v1::Ready& ready) const;
    [[nodiscard]] bool isLast(Frame frame) const;

    void say(const net::PeerId& peer, v1::Envelope message);
    void nameMissing(net::Instant now);
    void sayFarewell();
    [[nodiscard]] std::optional<std::size_t> seatNamed(const std::string& name) const;
    [[nodiscard]] std::optional<std::size_t> seatOf(const net::PeerId& peer) const;
    [[nodiscard]] bool isLockstep() const { return options_.pace == wire::Pace::Lockstep; }

    ConductorOptions options_;
    Simulation* simulation_;
    std::unique_ptr<Simulation> own_;  // simulation_, after a change of scene
    std::uint32_t fishOfSchool_;
    std::string rigText_;
    RigFiles rigFiles_;                     // of the look that is shown
    std::optional<RigFiles> nextRigFiles_;  // of the one under way, where they are others
    std::uint64_t calibration_ = 0;         // of the shown
    ShowControl control_;
    ScanHold scan_;
    bool windowsEndShow_;
    std::deque<std::uint64_t> restarts_;  // requests that were carried out, the last few
    std::deque<PowerRequest> powerRequests_;
    std::unique_ptr<v1::Look> look_;  // that is shown
    std::string sceneName_;           // of it
    Blobs blobs_;
    std::unique_ptr<net::MasterChannels> channels_;
    std::uint64_t session_;
    wire::Packet welcome_, beacon_;  // encoded once for many
    std::vector<ChannelSlot> slots_;
    PresentBarrier barrier_;
    net::Instant refresh_, deadline_;
    GrowingFile trace_;
    std::atomic<bool> stopped_ = false;
    bool over_ = false;
    std::string failure_;

    // Written by the tick thread. A full queue drops the answer, and the client asks again.
    net::BoundedQueue<std::pair<net::PeerId, wire::Packet>> explanations_{256};
    std::unique_ptr<SimulationThread> simulationThread_;
    SnapshotBuffer snapshots_;
    Frame next_;                               // is drawn, or will be as soon as it can
    bool drawing_ = false;                     // next_ is
    Frame unpublished_;                        // the first
    std::map<Frame, wire::Packet> published_;  // the last two: sent again to whoever may lack them
    net::Instant lastPublished_{};             // of anything, also of a beacon
    net::Instant lastRepeat_{}, repeatAfter_{};
    InputArbitration arbitration_;
    std::map<std::string, net::Instant> fed_;  // by user: when one that is no node last fed
    std::set<std::string> refused_;            // users that were told of in the log
    struct Rate {
        net::Instant since{};
        int count = 0;
    };
    std::map<std::string, Rate> rates_;            // by user: what was answered in this second
    std::set<std::string> objections_;             // to hellos, that were told of in the log
    net::Instant lastRoll_ = net::monotonicNow();  // when missing nodes were last named
    float brightness_ = 1.0F;                      // of the last state that was published
    wire::Eye eye_;                                // of the last state that was published
    double eyeTicks_ = 0;                          // when it was there, in ticks and parts of them
    float speedMetresPerSecond_ = 0;
    std::optional<std::pair<Frame, wire::Packet>> lastPresent_;
    net::Instant lastRelease_{};
    // The changed files by name, with their digests.
    std::future<std::map<std::string, std::pair<Digest, net::Blob>>> rereading_;
    net::Instant lastReread_{};
    std::future<NextWorld> making_;
    std::optional<NextWorld> made_;
    std::unique_ptr<v1::Look> nextLook_;  // that nodes are told to build
    wire::Packet prepare_;                // says so
    net::Instant preparingSince_{}, lastPrepare_{};
    std::optional<net::Instant> dimmedSince_;
    std::optional<Frame> black_;        // the first without light, on the way to the next scene
    std::future<void> retiring_;        // of the world before
    std::future<std::string> keeping_;  // why it could not be written; empty: it was
    ShowChange keptOnDisk_;
    ShowReport report_;
    RecentTimes frameTimes_;
    net::RecentPeak framePeak_, skewPeak_;
    SkewMeter skew_;
    net::Metrics metrics_;
    Figures figures_;
    net::Instant lastCount_{};
    std::optional<Tick> lastTick_;  // that has come from the tick thread, and when
    net::Instant lastTickAt_{};
    std::uint64_t publishedBytes_ = 0;
};

}  // namespace aquarama::conductor
