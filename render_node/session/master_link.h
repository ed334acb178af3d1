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
#include "render_node/session/mailbox.h"

namespace aquarama::session {

class MasterLink {
  public:
    // Connects once, so that a malformed address is refused here.
    MasterLink(std::string name, net::Connect connect, net::BlobCache cache, Mailbox& mailbox);

    // Requests of the render thread.
    struct Join {};
    struct Finished {  // the picture of this frame
        Frame frame;
        std::optional<wire::ReleaseReport> released;  // in this machine's clock
    };
    using Request = std::variant<Join, wire::Prepared, Finished, wire::Input, wire::ExplainRequest>;
    void post(const Request& request);
    void stop();  // from any thread

    // The net thread; returns after stop(), having said farewell.
    void run();

  private:
    enum class Phase : std::uint8_t { Outside, Greeting, Fetching, Building, Listening, Member };

    void turn();
    void say(const wire::Message& message);
    void handle(const Join& join);
    void handle(const wire::Prepared& prepared);
    void handle(const Finished& finished);
    void handle(const wire::Input& input);
    void handle(const wire::ExplainRequest& request);

    void readControl(const net::ByteVector& bytes);
    void readState(const net::ByteVector& bytes);
    // Messages that mean nothing to a node fall through to the last.
    void take(const wire::Pong& pong);
    void take(const wire::BlobChunk& chunk);
    void take(const wire::Joined& joined);
    void take(const wire::Present& present);
    void take(const wire::Dismissed& dismissed);
    void take(const wire::Farewell& farewell);
    void take(const wire::Explanation& explanation);
    template <class Other>
    void take(const Other&) {}

    void beWelcomed(std::uint64_t session, const wire::Welcome& welcome);
    void fetchNext();
    void requestChunk();
    void admit();
    void sayReady();
    void lose(const std::string& why);
    void keepTime(net::Instant now);
    void greet(net::Instant now);

    std::string name_;
    net::Connect connect_;
    net::BlobCache cache_;
    Mailbox& mailbox_;

    std::mutex channelsMutex_;  // held to replace or wake the channels, never to use them
    std::unique_ptr<net::NodeChannels> channels_;
    net::BoundedQueue<Request> requests_{64};
    std::atomic<bool> stopped_ = false;

    bool connectionUsed_ = false;
    Phase phase_ = Phase::Outside;
    std::uint64_t session_ = 0;
    Admitted admitted_;
    std::optional<net::BlobAssembly> assembly_;  // of the blob that is being fetched
    int spoiltBlobs_ = 0;
    bool hearsStates_ = false;
    wire::Prepared prepared_;
    std::optional<Finished> finished_;  // and not released yet, as far as we know
    net::ClockOffset clock_;
    std::string lastDismissal_;
    net::Instant lastHeard_{}, lastPing_{}, lastHello_{}, lastReady_{}, lastRequest_{},
        lastComplaint_{};
};

}  // namespace aquarama::session
