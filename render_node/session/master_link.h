// SPDX-License-Identifier: Apache-2.0
// A node's membership with the master, kept by its net thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/base/log.h"
#include "common/net/blob.h"
#include "common/net/channels.h"
#include "common/wire/messages.h"
#include "render_node/session/blob_fetch.h"
#include "render_node/session/connection.h"
#include "render_node/session/convergence.h"
#include "render_node/session/dead_reckoning.h"
#include "render_node/session/frame_reports.h"
#include "render_node/session/mailbox.h"
#include "render_node/session/pings.h"
#include "render_node/session/school_follower.h"
#include "render_node/session/session.h"
#include "render_node/session/skin_fetch.h"

namespace aquarama::session {

// The net thread's figures, for Prometheus. May be read from any thread.
struct LinkFigures {
    std::atomic<double> clockOffsetSeconds = 0;  // the master's clock minus this machine's
    std::atomic<std::uint64_t> receivedBytes = 0;
    std::atomic<std::uint64_t> mismatches = 0;  // states that differ from what the master sent
    std::atomic<float> gpuCelsius = 0;          // 0: unknown
};

// When the master was last heard, when it was last told of this node, and since when states are
// heard of this welcome.
struct LinkMoments {
    net::Moment heard{}, report{};
    std::optional<net::Moment> statesSince;
};

// What a node tells the master of itself beside its frames.
struct OwnFacts {
    NodeFacts facts;
    bool isInRealTime = false;            // the net thread
    std::deque<v1::LogLine> unsaid = {};  // lines of the log
};

// Requests of the render thread: to join, and a look that is built, with the tier that the node
// keeps up with.
struct JoinRequest {};
struct PreparedLook {
    std::uint32_t look = 0;
    config::QualityTier quality = config::QualityTier::Low;
    std::shared_ptr<school::SchoolMotion> motion = {};
    Digest show = {};  // showOf() its welcome: of the net thread
};
// A line of this process's log, for that of the show.
struct LoggedLine {
    Severity severity;
    std::string text;
};

// It says hello until a master welcomes the node, fetches the blobs that are missing, sends pings
// and reports, and joins again when the master is lost or restarted. Functions are of the net
// thread, unless they say otherwise.
class MasterLink {
  public:
    // Connects once, to the first address. Throws Error where it is malformed.
    MasterLink(std::string name,
               std::vector<std::string> addresses,
               net::ConnectTo connect,
               net::BlobCache cache,
               Mailbox& mailbox);

    // What the render thread asks for. An envelope is sent to the master; it is dropped while the
    // node is not welcomed.
    using Request = std::variant<JoinRequest, PreparedLook, NodeFacts, LoggedLine, v1::Envelope>;
    // From any thread, in this order; waits while too many requests are posted.
    void post(const Request& request);
    // From any thread. The line is lost where too many wait.
    void log(Severity severity, const std::string& line);
    // From any thread: the mailbox has a finished frame.
    void wake() { connection_.wake(); }
    [[nodiscard]] const LinkFigures& figures() const { return figures_; }
    // From any thread.
    void stop();
    // From any thread: the master has ended this node so that it is started again.
    [[nodiscard]] bool isToRestart() const { return isToRestart_; }
    // From any thread: whether the net thread has looked for messages in the last seconds.
    [[nodiscard]] bool isAtWork() const;

    // The net thread's loop; returns after stop(), when the master has been told.
    void run();

  private:
    // From outside to member: says hello, fetches blobs, waits for the render thread to build,
    // waits for the first state. The wall waits for the frames of a member.
    enum class Phase : std::uint8_t { Outside, Greeting, Fetching, Building, Listening, Member };

    // Handles all requests, frames and messages that have come, then the tasks that are due.
    void turn();
    void handle(const JoinRequest& join);
    void handle(const PreparedLook& built);
    void handle(const NodeFacts& facts);
    void handle(const LoggedLine& line);
    void handle(const v1::Envelope& message);

    // Packets that cannot be decoded are ignored.
    void readControl(const net::ByteVector& bytes);
    void readState(const net::ByteVector& bytes);
    void take(const v1::Envelope& message);
    void takeOfRun(const v1::Envelope& message);
    void carryOut(const v1::Order& order);
    void takeWelcome(const v1::Envelope& message);
    void takePong(const v1::Pong& pong);
    void takeDismissal(const v1::Dismissed& dismissed);
    void takeRelease(const v1::Present& present);
    void takeFarewell();
    // The next look: its blobs are fetched while frames are drawn.
    void prepare(const v1::Look& look);

    // All blobs are there.
    void admit();
    void refuse(const std::string& reason);
    // Puts frames whose fish are known into the mailbox.
    void offerFrames();
    void put(ArrivedState frame);
    // The master is silent: the node makes the frames itself, while it joins again.
    void reckon(DeadReckoning::Cause cause);
    // Whether a frame of the master is shown: the first takes the place of those that the node has
    // made.
    [[nodiscard]] bool isLedBy(const ArrivedState& frame);
    void endReckoning(const ArrivedState& first);
    void sayHello();
    // A node that has just come draws as its neighbours do: it waits for the fish and the skins
    // that they have.
    [[nodiscard]] bool mayBePrepared(net::Moment now) const;
    void sayPrepared();
    void sayReport(net::Moment now);
    void sayLog();
    // The master is lost or another: joins again.
    void lose(const std::string& why);
    void doWhatIsDue(net::Moment now);

    Mailbox& mailbox_;
    Connection connection_;
    net::BoundedQueue<Request> requests_{64};
    std::atomic<bool> isStopped_ = false, isToRestart_ = false;
    std::atomic<net::Moment> lastTurn_{net::monotonicNow()};
    LinkFigures figures_;

    Phase phase_ = Phase::Outside;
    v1::Welcome welcome_;            // with the look that was fetched last
    std::uint64_t calibration_ = 0;  // of that look
    BlobFetch fetch_;
    SkinFetch skins_;
    SchoolFollower school_;
    DeadReckoning reckoning_;
    Convergence convergence_;
    std::vector<PreparedLook> built_;  // the newest two looks; the newest last
    PreparedLook shown_;               // while the node makes the frames
    std::optional<Frame> joined_;      // the first frame for this node as a member
    // Once another run has welcomed the node beside the frames: its number of what is shown.
    std::optional<std::uint32_t> renumbered_;
    Pings pings_;
    FrameReports frames_;
    OwnFacts own_;
    LinkMoments moments_;
};

}  // namespace aquarama::session
