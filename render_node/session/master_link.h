// SPDX-License-Identifier: Apache-2.0
// The net thread of a node, and the mailbox by which it meets the render thread.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "common/base/log.h"
#include "common/motion/motor.h"
#include "common/net/blob.h"
#include "common/net/channels.h"
#include "common/wire/messages.h"
#include "render_node/session/session.h"

namespace aquarama::session {

// A state, and when it arrived.
struct ArrivedState {
    wire::StateFrame state;
    net::Instant arrival{};
};

// The master releases a frame, for all nodes at the same instant.
struct ReleaseOrder {
    Frame frame;
    net::Instant at{};  // on this machine's clock; past instants mean at once
};

// What the master gave to a node that it welcomed.
struct Admitted {
    v1::Welcome welcome;
    std::map<Digest, net::Blob> blobs;  // all that the welcome names
};
// The master refuses the node, or no connection could be made.
struct Refused {
    std::string reason;
};
// The show is over, or this process is.
struct Ended {};
using JoinOutcome = std::variant<Admitted, Refused, Ended>;

// The exchange between a node's net thread and its render thread: states and releases one way,
// bounded, and the end of either. The lock is held for a move only.
class Mailbox {
  public:
    // The net thread's side.
    void admit(Admitted admitted);
    void refuse(const std::string& reason);
    void start(wire::Pace pace, Frame first);  // frames are taken from this one on
    void put(ArrivedState arrived);
    void release(const ReleaseOrder& order);
    void tellMind(ExplainedMind explanation);
    void offerNextLook(Admitted next);
    void interrupt(Release why);  // Rejoin or Quit; nothing comes back after Quit

    // The render thread's side. Each blocks until there is an answer.
    // Called while one of them waits, without the lock.
    void whileWaiting(std::function<void()> call) { whileWaiting_ = std::move(call); }
    void expectJoin();  // forgets everything that came before
    [[nodiscard]] JoinOutcome awaitJoin();
    [[nodiscard]] std::optional<ArrivedState> takeState();  // empty: interrupted
    // The newest release, of this frame or a later one; empty: interrupted.
    [[nodiscard]] std::optional<ReleaseOrder> awaitRelease(Frame frame);
    [[nodiscard]] Release interruption() const;
    // The next look that all blobs are there for, once; does not block.
    [[nodiscard]] std::optional<Admitted> takeNextLook();
    // The last that was told in this run of the master; does not block.
    [[nodiscard]] std::optional<ExplainedMind> latestMind() const;

  private:
    [[nodiscard]] std::optional<ArrivedState> takeNext();
    // Returns with the lock held, once this is true.
    void await(std::unique_lock<std::mutex>& lock, const std::function<bool()>& isDone);

    static constexpr std::size_t kStates = 8;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::function<void()> whileWaiting_;  // of the render thread
    std::optional<JoinOutcome> join_;
    std::optional<Release> interruption_;
    std::optional<wire::Pace> pace_;  // set once frames are expected
    Frame next_;
    std::deque<ArrivedState> states_;
    std::optional<ReleaseOrder> release_;
    std::optional<ExplainedMind> mind_;
    std::optional<Admitted> nextLook_;
};

// When a node let go of a frame, in this machine's clock.
struct ReleaseReport {
    Frame frame;
    net::Instant at{};
};

// A node's membership with the master, kept by its net thread: hello until welcomed, fetch what is
// missing, speak often enough to be counted, and notice when the master is gone or another.
class MasterLink {
  public:
    // Connects once, so that a malformed address is refused here.
    MasterLink(std::string name, net::Connect connect, net::BlobCache cache, Mailbox& mailbox);

    // Requests of the render thread.
    struct Join {};
    struct Built {  // a look; the node keeps up with this tier
        std::uint32_t look = 0;
        config::QualityTier quality = config::QualityTier::Low;
    };
    struct Finished {  // the picture of this frame
        Frame frame;
        std::optional<ReleaseReport> released;  // of an earlier frame
        std::optional<net::Blanks> blanks;      // of its display, in this machine's clock
        net::Instant took{};                    // from the frame's state to its finished picture
    };
    struct Logged {  // a line of this process's log, for that of the show
        Severity severity;
        std::string text;
    };
    struct Obtained {  // what came of looking for a blob, beside the net thread
        Digest digest;
        net::Blob blob;  // null: not in the cache, or what was sent is another
        bool wasSent = false;
    };
    // Inputs and questions; dropped while the node is not welcomed.
    using Request = std::variant<Join,
                                 Built,
                                 Finished,
                                 NodeFacts,
                                 Logged,
                                 Obtained,
                                 v1::Input,
                                 v1::Order,
                                 v1::ExplainRequest>;
    void post(const Request& request);
    // From any thread, also the net thread; where too many wait, the line is lost.
    void log(Severity severity, const std::string& line);
    // For figures, as the net thread knows it now; from any thread.
    struct Traffic {
        std::atomic<double> clockOffsetSeconds = 0;  // the master's clock minus this machine's
        std::atomic<std::uint64_t> receivedBytes = 0;
        std::atomic<std::uint64_t> mismatches = 0;  // states that were not what was sent
        std::atomic<float> gpuCelsius = 0;          // 0: not told
    };
    [[nodiscard]] const Traffic& traffic() const { return traffic_; }
    void stop();  // from any thread
    [[nodiscard]] bool isToRestart() const { return isToRestart_; }
    // Whether the net thread has looked for messages in the last seconds; from any thread.
    [[nodiscard]] bool isAtWork() const;

    // The net thread; returns after stop(), having said farewell.
    void run();

  private:
    // From outside to member: says hello, fetches blobs, builds (the render thread does), waits for
    // the first state, and is waited for.
    enum class Phase : std::uint8_t { Outside, Greeting, Fetching, Building, Listening, Member };

    void turn();                     // all requests and messages that are there, then what is due
    void say(v1::Envelope message);  // of the run that welcomed us
    void sayFarewell();
    void handle(const Join& join);
    void handle(const Built& built);
    void handle(const Finished& finished);
    void handle(const NodeFacts& facts);
    void handle(const Logged& line);
    void handle(const Obtained& obtained);
    void handle(const v1::Input& input);
    void handle(const v1::Order& order);
    void handle(const v1::ExplainRequest& request);

    // Whatever cannot be decoded is ignored.
    void readControl(const net::ByteVector& bytes);
    void readState(const net::ByteVector& bytes);
    void compareHash(const wire::StateFrame& state);
    void take(const v1::Envelope& message);
    void beWelcomed(const v1::Envelope& message);
    // From the run of the master that welcomed us.
    void takeOfRun(const v1::Envelope& message);
    // The look that comes next: its blobs are fetched beside the frames.
    void prepare(const v1::Look& look);
    void takeChunk(const v1::BlobChunk& chunk);
    void beReleased(const v1::Present& present);
    void beDismissed(const std::string& reason);
    void end();
    void carryOut(const v1::Order& order);
    void switchMachine(const v1::Order& order);

    [[nodiscard]] bool isFetching() const;
    // Of what is fetched.
    [[nodiscard]] std::optional<Digest> firstMissing() const;
    void fetchNext();
    // A large blob takes a second to read, to check or to write, and the master would take us for
    // gone: a thread of its own does the work, one at a time.
    void obtain(const Digest& digest,
                bool wasSent,
                std::function<std::optional<net::ByteVector>()> work);
    void requestChunk();
    void admit();  // every blob is there
    void sayPrepared();
    void sayReady();
    void sayPing(net::Instant now);
    void hearPong(const v1::Pong& pong, net::Instant now);
    void sayReport(net::Instant now);
    void reportPings(v1::NodeReport& report, net::Instant now) const;
    void sayLog();
    // The master is gone or another: joins again.
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
    std::atomic<bool> stopped_ = false, isToRestart_ = false;
    std::atomic<net::Instant> lastTurn_{net::monotonicNow()};

    bool connectionUsed_ = false;
    Phase phase_ = Phase::Outside;
    std::uint64_t session_ = 0;
    Admitted admitted_;  // what is fetched, or was last
    bool fetchesNextLook_ = false;
    std::uint64_t calibration_ = 0;              // of the rig that we were welcomed with
    std::optional<net::BlobAssembly> assembly_;  // of the blob that is being fetched
    bool isObtaining_ = false;
    int spoiltBlobs_ = 0;
    bool hearsStates_ = false;
    Built built_;
    std::optional<Finished> finished_;  // and not released yet, as far as we know
    net::ClockOffset clock_;
    NodeFacts facts_;
    bool isInRealTime_ = false;  // the net thread
    // When pings of the last ten seconds were sent, and how long their answers took.
    std::deque<std::pair<net::Instant, std::optional<net::Instant>>> pings_;
    Traffic traffic_;
    Frame lastFinished_;
    net::RecentTimes pictures_;       // how long each took
    std::deque<v1::LogLine> unsaid_;  // lines of the log that the master has not been told
    std::string lastDismissal_;
    net::Instant lastHeard_{}, lastPing_{}, lastHello_{}, lastReady_{}, lastRequest_{},
        lastReport_{}, lastComplaint_{}, lastCompared_{};
    std::future<void> obtaining_;  // last: it uses all of the above
};

}  // namespace aquarama::session
