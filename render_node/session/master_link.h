// SPDX-License-Identifier: Apache-2.0
// A node's standing with the master, kept by its net thread: hello until welcomed, fetch what is
// missing, speak often enough to be counted, and notice when the master is gone or another.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <variant>

#include "common/net/blob.h"
#include "common/net/bounded_queue.h"
#include "common/net/channels.h"
#include "common/wire/envelope.h"
#include "render_node/session/meeting.h"

namespace aquarama {

class MasterLink {
  public:
    // Connects once, so that a malformed address is refused here.
    MasterLink(std::string name, Connect connect, BlobCache cache, Meeting& meeting);

    // The render thread's wishes.
    struct Join {};
    struct Finished {  // the picture of this frame
        Frame frame;
        std::optional<ReleaseReport> released;  // in this machine's clock
    };
    using Wish = std::variant<Join, Prepared, Finished, Input, ExplainRequest>;
    void wish(const Wish& wish);
    void stop();  // from any thread

    // The net thread; returns after stop(), having said farewell.
    void run();

  private:
    enum class Phase : std::uint8_t { Outside, Greeting, Fetching, Building, Listening, Member };

    void turn();
    void say(const Message& message);
    void obey(const Join& join);
    void obey(const Prepared& prepared);
    void obey(const Finished& finished);
    void obey(const Input& input);
    void obey(const ExplainRequest& request);

    void readControl(const ByteVector& bytes);
    void readState(const ByteVector& bytes);
    // Messages that mean nothing to a node fall through to the last.
    void take(const Pong& pong);
    void take(const BlobChunk& chunk);
    void take(const Joined& joined);
    void take(const Present& present);
    void take(const Dismissed& dismissed);
    void take(const Farewell& farewell);
    void take(const Explanation& explanation);
    template <class Other>
    void take(const Other&) {}

    void beWelcomed(std::uint64_t session, const Welcome& welcome);
    void fetchNext();
    void requestChunk();
    void admit();
    void sayReady();
    void lose(const std::string& why);
    void keepTime(Instant now);
    void greet(Instant now);

    std::string name_;
    Connect connect_;
    BlobCache cache_;
    Meeting& meeting_;

    std::mutex channelsMutex_;  // held to replace or wake the channels, never to use them
    std::unique_ptr<NodeChannels> channels_;
    BoundedQueue<Wish> wishes_{64};
    std::atomic<bool> stopped_ = false;

    bool connectionUsed_ = false;
    Phase phase_ = Phase::Outside;
    std::uint64_t session_ = 0;
    Admitted admitted_;
    std::optional<BlobAssembly> assembly_;  // of the blob that is being fetched
    int spoiltBlobs_ = 0;
    bool hearsStates_ = false;
    Prepared prepared_;
    std::optional<Finished> finished_;  // and not released yet, as far as we know
    ClockOffset clock_;
    std::string lastDismissal_;
    Instant lastHeard_{}, lastPing_{}, lastHello_{}, lastReady_{}, lastRequest_{}, lastComplaint_{};
};

}  // namespace aquarama
