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
#include "master/conductor/helm.h"
#include "master/conductor/meters.h"
#include "master/conductor/simulation.h"
#include "master/conductor/ticker.h"
#include "master/conductor/timeline.h"

namespace aquarama {

struct ConductorOptions {
    Pace pace = Pace::Live;
    Pattern pattern = Pattern::World;
    std::optional<std::uint64_t> frames;   // the show ends after so many
    std::uint32_t seed = 1;                // of what the nodes draw by themselves
    std::vector<std::string> expected;     // the channels that take part; empty: all of the rig
    std::filesystem::path traceDirectory;  // for master.csv; empty: none
    std::optional<QualityTier> quality;    // of the wall; nothing: the finest that every node bears
    Instant patience = std::chrono::seconds(60);  // lockstep: silence of a node that ends the show
};

// What nodes fetch, by digest.
using Blobs = std::map<Digest, ByteVector>;

struct ShowReport {
    std::uint64_t frames = 0;  // presented
    Tick tick;                 // the last that was shown
    std::uint64_t worldHash = 0;
    std::uint64_t refusedPackets = 0;
};

class Conductor {
  public:
    // Of the welcome only rig text, school and digests are taken; the rest is filled in here.
    Conductor(const Rig& rig,
              ConductorOptions options,
              Simulation& simulation,
              Welcome welcome,
              Blobs blobs,
              std::unique_ptr<MasterChannels> channels);

    // Until the frames are done, a node asks to quit, or stop(). Throws Error where a node of a
    // lockstep show stays silent, and where the trace cannot be written.
    ShowReport run();
    void stop();  // from any thread

  private:
    // A channel of the rig, and who drives it.
    struct Seat {
        std::string name;
        PeerId peer;  // empty: nobody
        bool prepared = false;
        std::optional<QualityTier> bears;  // the finest tier that its node has kept up with
        Instant lastHeard{};
        std::uint64_t dropped = 0;
        Instant lastFed{};  // when a visitor last dropped food in its window
    };

    void hear(Instant now);
    void greet(const PeerId& peer, const Hello& hello, Instant now);
    void heed(std::size_t node, const Message& message, Instant now);
    void heed(std::size_t node, const Ready& ready, Instant now);
    void admit(std::size_t node);
    void giveChunk(const PeerId& peer, const BlobRequest& request);
    void vacate(std::size_t node, const std::string& why);
    void obey(std::size_t node, const Input& input, Instant now);
    void feed(std::size_t node, glm::vec3 positionMetres, Instant now);
    void steer(const PeerId& peer, const Steering& steering, Instant now);
    void ask(const PeerId& peer, const ExplainRequest& question);
    void answer();
    [[nodiscard]] StatusReply status(Instant now) const;
    [[nodiscard]] std::string pilotName(Instant now) const;
    [[nodiscard]] QualityTier quality() const;

    void noteEye(const StateFrame& state);
    void takeTicks();
    void conduct(Instant now);
    void beginNext(Instant now);
    void release(Instant now);
    bool publish(Frame frame, Instant now);
    void publishAgain(Instant now);
    [[nodiscard]] Instant nextRelease(Instant now) const;
    [[nodiscard]] bool isLast(Frame frame) const;

    void say(const PeerId& peer, const Message& message);
    void sayToAll(const Message& message);
    void sayFarewell();
    [[nodiscard]] std::optional<std::size_t> seatNamed(const std::string& name) const;
    [[nodiscard]] std::optional<std::size_t> seatOf(const PeerId& peer) const;
    [[nodiscard]] bool isLockstep() const { return options_.pace == Pace::Lockstep; }

    ConductorOptions options_;
    Simulation& simulation_;
    Welcome welcome_;
    Blobs blobs_;
    std::unique_ptr<MasterChannels> channels_;
    std::uint64_t session_;
    std::vector<Seat> seats_;
    PresentBarrier barrier_;
    Instant refresh_;
    std::ofstream trace_;
    std::atomic<bool> stopped_ = false;
    bool over_ = false;
    std::string failure_;

    // From the tick thread; whoever hears no answer asks again.
    BoundedQueue<std::pair<PeerId, Explanation>> explanations_{256};
    std::unique_ptr<Ticker> ticker_;
    Timeline timeline_;
    Frame next_;                         // is drawn, or will be as soon as it can
    bool drawing_ = false;               // next_ is
    Frame unpublished_;                  // the first
    std::map<Frame, Packet> published_;  // the last two: sent again to whoever may lack them
    Instant lastPublished_{};            // of anything, also of a beacon
    Instant lastRepeat_{};
    Helm helm_;
    Eye eye_;              // of the last state that was published
    double eyeTicks_ = 0;  // when it was there, in ticks and parts of them
    float speedMetresPerSecond_ = 0;
    std::optional<Present> lastPresent_;
    Instant lastRelease_{};
    ShowReport report_;
    RecentTimes frameTimes_;
    SkewMeter skew_;
};

}  // namespace aquarama
