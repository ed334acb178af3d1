// SPDX-License-Identifier: Apache-2.0
// The show: welcomes nodes, publishes states, and has all nodes present each frame together.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/rig.h"
#include "common/net/bounded_queue.h"
#include "common/net/channels.h"
#include "common/net/present_barrier.h"
#include "common/wire/envelope.h"
#include "master/conductor/input_arbitration.h"
#include "master/conductor/meters.h"
#include "master/conductor/simulation.h"
#include "master/conductor/simulation_thread.h"
#include "master/conductor/snapshot_buffer.h"

namespace aquarama::conductor {

struct ConductorOptions {
    wire::Pace pace = wire::Pace::Live;
    wire::Pattern pattern = wire::Pattern::World;
    std::optional<std::uint64_t> frames;   // the show ends after so many
    std::uint32_t seed = 1;                // of what the nodes draw by themselves
    std::vector<std::string> expected;     // the channels that take part; empty: all of the rig
    std::filesystem::path traceDirectory;  // for master.csv; empty: none
    std::optional<config::QualityTier>
        quality;  // of the wall; nothing: the finest that every node bears
    net::Instant patience =
        std::chrono::seconds(60);  // lockstep: silence of a node that ends the show
};

// What nodes fetch, by digest.
using Blobs = std::map<Digest, net::ByteVector>;

struct ShowReport {
    std::uint64_t frames = 0;  // presented
    Tick tick;                 // the last that was shown
    std::uint64_t worldHash = 0;
    std::uint64_t refusedPackets = 0;
};

class Conductor {
  public:
    // Of the welcome only rig text, school and digests are taken; the rest is filled in here.
    Conductor(const config::Rig& rig,
              ConductorOptions options,
              Simulation& simulation,
              wire::Welcome welcome,
              Blobs blobs,
              std::unique_ptr<net::MasterChannels> channels);

    // Until the frames are done, a node asks to quit, or stop(). Throws Error where a node of a
    // lockstep show stays silent, and where the trace cannot be written.
    ShowReport run();
    void stop();  // from any thread

  private:
    // A channel of the rig, and who drives it.
    struct ChannelSlot {
        std::string name;
        net::PeerId peer;  // empty: nobody
        bool prepared = false;
        std::optional<config::QualityTier> bears;  // the finest tier that its node has kept up with
        net::Instant lastHeard{};
        std::uint64_t dropped = 0;
        net::Instant lastFed{};  // when a visitor last dropped food in its window
    };

    void hear(net::Instant now);
    void greet(const net::PeerId& peer, const wire::Hello& hello, net::Instant now);
    void heed(std::size_t node, const wire::Message& message, net::Instant now);
    void heed(std::size_t node, const wire::Ready& ready, net::Instant now);
    void admit(std::size_t node);
    void giveChunk(const net::PeerId& peer, const wire::BlobRequest& request);
    void vacate(std::size_t node, const std::string& why);
    void handle(std::size_t node, const wire::Input& input, net::Instant now);
    void feed(std::size_t node, glm::vec3 positionMetres, net::Instant now);
    void steer(const net::PeerId& peer, const Steering& steering, net::Instant now);
    void ask(const net::PeerId& peer, const wire::ExplainRequest& question);
    void answer();
    [[nodiscard]] wire::StatusReply status(net::Instant now) const;
    [[nodiscard]] std::string pilotName(net::Instant now) const;
    [[nodiscard]] config::QualityTier quality() const;

    void noteEye(const wire::StateFrame& state);
    void takeTicks();
    void conduct(net::Instant now);
    void beginNext(net::Instant now);
    void release(net::Instant now);
    bool publish(Frame frame, net::Instant now);
    void publishAgain(net::Instant now);
    [[nodiscard]] net::Instant nextRelease(net::Instant now) const;
    [[nodiscard]] bool isLast(Frame frame) const;

    void say(const net::PeerId& peer, const wire::Message& message);
    void sayToAll(const wire::Message& message);
    void sayFarewell();
    [[nodiscard]] std::optional<std::size_t> seatNamed(const std::string& name) const;
    [[nodiscard]] std::optional<std::size_t> seatOf(const net::PeerId& peer) const;
    [[nodiscard]] bool isLockstep() const { return options_.pace == wire::Pace::Lockstep; }

    ConductorOptions options_;
    Simulation& simulation_;
    wire::Welcome welcome_;
    Blobs blobs_;
    std::unique_ptr<net::MasterChannels> channels_;
    std::uint64_t session_;
    std::vector<ChannelSlot> slots_;
    net::PresentBarrier barrier_;
    net::Instant refresh_;
    std::ofstream trace_;
    std::atomic<bool> stopped_ = false;
    bool over_ = false;
    std::string failure_;

    // From the tick thread; whoever hears no answer asks again.
    net::BoundedQueue<std::pair<net::PeerId, wire::Explanation>> explanations_{256};
    std::unique_ptr<SimulationThread> simulationThread_;
    SnapshotBuffer snapshots_;
    Frame next_;                               // is drawn, or will be as soon as it can
    bool drawing_ = false;                     // next_ is
    Frame unpublished_;                        // the first
    std::map<Frame, wire::Packet> published_;  // the last two: sent again to whoever may lack them
    net::Instant lastPublished_{};             // of anything, also of a beacon
    net::Instant lastRepeat_{};
    InputArbitration arbitration_;
    wire::Eye eye_;        // of the last state that was published
    double eyeTicks_ = 0;  // when it was there, in ticks and parts of them
    float speedMetresPerSecond_ = 0;
    std::optional<wire::Present> lastPresent_;
    net::Instant lastRelease_{};
    ShowReport report_;
    RecentTimes frameTimes_;
    SkewMeter skew_;
};

}  // namespace aquarama::conductor
