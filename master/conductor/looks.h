// SPDX-License-Identifier: Apache-2.0
// What nodes build before they can draw: the look that is shown, the next one on its way, and the
// files of both, which nodes fetch by digest.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/base/digest.h"
#include "common/config/rig.h"
#include "common/motion/motor.h"
#include "common/net/blob.h"
#include "common/wire/messages.h"
#include "common/wire/recording.h"
#include "master/conductor/journal_report.h"
#include "master/conductor/roster.h"
#include "master/conductor/sender.h"
#include "master/conductor/show_control.h"
#include "master/conductor/simulation.h"

namespace aquarama::conductor {

// A world that a show changes to, and the files that it was made from.
struct NextWorld {
    wire::AssetBundle assets;
    std::vector<motion::FishTraits> school;
    std::unique_ptr<Simulation> simulation;
    std::shared_ptr<const JournalReport> journal = {};  // null: nothing is known of it
};

// Where looks come from.
struct LookSources {
    // Of a scene, by its name; called from a thread of its own, throws Error. Null: there is one
    // scene only.
    std::function<NextWorld(const std::string& scene)> makeWorld;
    // The rig with the files that it names, where they are others than at the call before; called
    // once a second from a thread of its own. Throws Error where they cannot be used. Null: they
    // never change.
    std::function<std::optional<config::Rig>()> changedRig;
};

// What nodes fetch, by digest.
using Blobs = std::map<Digest, net::Blob>;
// The species files and repertoires of a show.
[[nodiscard]] Blobs blobsOf(const wire::AssetBundle& assets);

// What nodes build for a scene; number, quality and whether the world is drawn are added by Looks.
// `school` has the fish of all species of the assets, in their order.
[[nodiscard]] v1::Look lookOf(const wire::AssetBundle& assets,
                              std::span<const motion::FishTraits> school);

// Of the conductor's thread. Another world is made and another look is built while the present one
// is shown; a look that is given up leaves the wall as it is.
class Looks {
  public:
    // `welcome`: has the rig's text, the state address and the pace. `control`, `roster` and
    // `sender` outlive this.
    Looks(LookSources sources,
          v1::Welcome welcome,
          const std::map<std::string, net::Blob>& rigFiles,
          v1::Look look,
          Blobs blobs,
          ShowControl& control,
          Roster& roster,
          const Sender& sender);

    // The look that is shown, and the message that tells it to a node that says hello.
    [[nodiscard]] const v1::Look& shown() const { return welcome_.look(); }
    [[nodiscard]] const wire::Packet& welcome() const { return welcomePacket_; }
    // Its scene's name, and what names the geometry of its wall, as in each frame.
    [[nodiscard]] const std::string& sceneName() const { return sceneName_; }
    [[nodiscard]] std::uint64_t calibration() const { return calibration_; }
    // The share of the water's colour that is given back: as it was set, or the scene's own.
    [[nodiscard]] double colourReturned() const;
    // The tier of the whole wall: as chosen, or the finest that every node bears.
    [[nodiscard]] config::QualityTier quality() const;
    // Null where nothing of this digest is shown or prepared.
    [[nodiscard]] net::Blob blob(const Digest& digest) const;

    // Watches the rig's files, and goes on with the change that is under way. Once a turn.
    void step(net::Moment now);
    // Tells nodes of the next look once more at the next step: one has come that did not hear it.
    void prepareAgain() { lastPrepare_ = {}; }
    // In phase Switching: the next look is shown from now on. Returns its world; nothing where it
    // is the same one.
    [[nodiscard]] std::optional<NextWorld> switchToNext();

  private:
    using RigFiles = std::map<std::string, Digest>;  // that the rig names, by name
    using ReadFiles = std::map<std::string, std::pair<Digest, net::Blob>>;

    void watchRigFiles(net::Moment now);
    void makeNextWorld();
    void announceNext(net::Moment now);
    void prepareNodes(net::Moment now);
    void giveUpNext(const std::string& missing);
    // Large, and asked for no more: what `old` names and `kept` does not.
    void forgetRigFiles(const RigFiles& old, const RigFiles& kept);
    // Encodes what nodes are told of the look that is shown.
    void tellShown();

    LookSources sources_;
    ShowControl& control_;
    Roster& roster_;
    const Sender& sender_;
    v1::Welcome welcome_;         // with the look that is shown
    wire::Packet welcomePacket_;  // encoded once for many
    std::string sceneName_;
    double ownColour_ = 0;  // of the scene: SceneWater::colourReturned
    std::uint64_t calibration_ = 0;
    Blobs blobs_;
    RigFiles rigFiles_;                     // of the look that is shown
    std::optional<RigFiles> nextRigFiles_;  // of the next one, where they are others
    std::future<ReadFiles> rereading_;
    net::Moment lastReread_{};
    std::future<NextWorld> making_;
    std::optional<NextWorld> made_;
    std::optional<v1::Look> next_;  // that nodes are told to build
    wire::Packet prepare_;          // tells it
    net::Moment preparingSince_{}, lastPrepare_{};
};

// Keeps on the disk what was set of a show, beside the frames: a disk may take its time.
class ShowKeeper {
  public:
    // Empty path: nothing is kept. `kept`: is there already.
    ShowKeeper(std::filesystem::path path, v1::WantedShow kept);
    // Waits for what is being written.
    ~ShowKeeper();
    ShowKeeper(const ShowKeeper&) = delete;
    ShowKeeper& operator=(const ShowKeeper&) = delete;

    // Begins to write it where it has changed. What cannot be written is one warning.
    void keep(const v1::WantedShow& show, net::Moment now);
    // Since when these values are being written; nothing where the disk has them, does not take
    // them, or others were set meanwhile.
    [[nodiscard]] std::optional<net::Moment> writesSince(const v1::WantedShow& change) const;
    // The last time: returns when it is written.
    void finish(const v1::WantedShow& show);

  private:
    std::filesystem::path path_;
    v1::WantedShow newest_;         // as keep() had it last
    v1::WantedShow begun_, tried_;  // goes to the disk; is there, or could not be written
    net::Moment begunAt_{};
    std::future<std::string> writing_;  // why it could not be written; empty: it was
};

}  // namespace aquarama::conductor
