// SPDX-License-Identifier: Apache-2.0
// A node's side of the cluster: hello, welcome, blobs, frames, ready and present, on a separate net
// thread.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/digest.h"
#include "common/base/units.h"
#include "common/base/wall_hands.h"
#include "common/body/side_skin.h"
#include "common/config/rig.h"
#include "common/config/scene.h"
#include "common/motion/motion_state.h"
#include "common/net/blob.h"
#include "common/net/channels.h"
#include "common/net/clock.h"
#include "common/school/school_motion.h"
#include "common/wire/recording.h"

namespace aquarama::session {

// What became of a frame that was reported ready.
enum class Release : std::uint8_t {
    Present,  // swap now: the present instant has come
    Skip,     // the wall went on without this frame; take the next one
    Rejoin,   // the master has dropped this node or was restarted: join() again
    Quit,     // the show is over
};

// A look of the show that a node takes part in: all that it builds before it can draw.
struct Admission {
    std::uint32_t look = 0;  // its number, as in wire::Show
    Digest show;             // of all that is built for it: another look has another
    config::Rig rig;
    std::string guestsKey;  // public, of the program that serves visitors; empty: none
    config::Scene scene;
    std::uint32_t seed = 0;
    bool world = true;  // false: patterns alone are drawn
    // Of the whole wall; nothing: the node measures its own.
    std::optional<config::QualityTier> quality = {};
    std::vector<motion::FishTraits> school;
    std::vector<wire::SpeciesAssets> cast;  // of all fish of the school, in its order
};
// A digest of what stays the same when a show goes on after an interruption.
[[nodiscard]] Digest showOf(v1::Welcome welcome);

// How the fish of a look move. Takes a second for a large cast. Throws Error where the master's
// files cannot be read.
[[nodiscard]] std::shared_ptr<school::SchoolMotion> motionOf(const Admission& admission);

// Facts of the node's machine that only its process knows.
struct NodeFacts {
    std::string build;                  // version and commit
    std::string renderer;               // of OpenGL
    std::vector<std::string> monitors;  // none without a display
};

// The master's explanation of the mind of a fish: lines of printable ASCII; none where there is no
// such fish.
struct ExplainedMind {
    std::uint32_t fish = 0;
    std::vector<std::string> lines;
};

// Called from the render thread; every wait also ends when stop() was called from a signal
// handler's thread.
class Session {
  public:
    virtual ~Session() = default;
    // Says hello until the master answers, then fetches the blobs it lacks (by digest, checked,
    // cached on disk). Empty: stopped, or the master ended the show. Throws Error where the master
    // refuses the node, saying why.
    virtual std::optional<Admission> join() = 0;
    // This look is built, and this is the finest tier that the node keeps up with. After join().
    // From now on the master waits for the node. `motion`: motionOf() the look; the session alone
    // uses it from now on. Without it frames come without fish.
    virtual void prepared(std::uint32_t look,
                          config::QualityTier quality,
                          std::shared_ptr<school::SchoolMotion> motion) = 0;
    // The look that the master will show next, to be built while frames are drawn; each is returned
    // once. Does not block. Throws Error where the master's scene cannot be read.
    [[nodiscard]] virtual std::optional<Admission> nextLook() = 0;
    // The skins that visitors have painted, whenever others are there than before; else null. Does
    // not block. After prepared() the first frame finds all that its list names, unless the master
    // is slow to send them.
    [[nodiscard]] virtual std::shared_ptr<const body::SkinsByNumber> newSkins() = 0;
    // The next frame to draw: in lockstep every one in order, live the newest. Empty: see
    // `interruption`.
    virtual std::optional<wire::StateFrame> nextFrame() = 0;
    // Of the frame that nextFrame() gave: the node has made it itself, as the master is silent.
    [[nodiscard]] virtual bool isReckoned() const = 0;
    // The number that the look has from that frame on, where the node has joined another run of the
    // master, which shows the same. A look that was offered before is not shown any more.
    [[nodiscard]] virtual std::optional<std::uint32_t> renumbered() const = 0;
    // When the state of the frame that nextFrame() gave had arrived, on CLOCK_MONOTONIC.
    [[nodiscard]] virtual net::Moment stateArrival() const = 0;
    // Why nextFrame() was empty.
    [[nodiscard]] virtual Release interruption() const = 0;
    // The picture of this frame is finished (its fence has signalled). Blocks until it is released
    // or overtaken.
    virtual Release readyThenWait(Frame frame) = 0;
    // A vertical blank of the node's display, as its driver counts and dates it (CLOCK_MONOTONIC).
    virtual void sawBlank(std::uint64_t count, net::Moment at) = 0;
    // Requests of a window's keys: end the show, or freeze the world.
    virtual void quit() = 0;
    virtual void freeze(bool frozen) = 0;
    virtual void dropFood(glm::vec3 positionMetres) = 0;  // world frame
    virtual void touch(const WallHands& hands) = 0;       // all that this window sees
    // Steers the submarine; valid until the next call, half a second at most.
    virtual void steer(const Steering& steering) = 0;
    // Reported to the master every few seconds, with the state of the network. May be called by any
    // thread.
    virtual void describe(const NodeFacts& facts) = 0;
    // Asks the master to explain the mind of a fish; latestMind() returns the answer once it has
    // come.
    virtual void askMind(std::uint32_t fish) = 0;
    [[nodiscard]] virtual std::optional<ExplainedMind> latestMind() const = 0;
    // Called four times a second while the render thread waits in one of the functions above, as
    // long as the net thread is at work.
    virtual void whileWaiting(std::function<void()> call) = 0;
    virtual void stop() = 0;
    // Whether the session has ended because this node is to be started again.
    [[nodiscard]] virtual bool isToRestart() const = 0;
};

// A session of the channel of this name, over any channels, also those in memory. Blobs are kept in
// this directory. Throws Error where the first connection cannot be made.
[[nodiscard]] std::unique_ptr<Session> makeSession(const std::string& name,
                                                   net::Connect connect,
                                                   const std::filesystem::path& blobDirectory);
// The same over ZeroMQ, to the master at the first address; where it is silent, at the next one.
// Throws Error where the first is malformed.
[[nodiscard]] std::unique_ptr<Session> connectSession(
    const std::string& name,
    const std::vector<std::string>& controlAddresses,
    const std::optional<net::PeerKeys>& keys = {},
    const std::filesystem::path& blobDirectory = net::defaultBlobDirectory());

}  // namespace aquarama::session
