// SPDX-License-Identifier: Apache-2.0
#include "commands/standby_master.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "commands/master_shows.h"
#include "common/base/log.h"
#include "common/cli/command_line.h"
#include "common/cli/outputs.h"
#include "common/config/keys.h"
#include "common/wire/wanted_show.h"
#include "master/conductor/preparation.h"
#include "master/standby/fenced_channels.h"
#include "master/standby/follower.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// Where etcd is, and the files for it, which lie beside the keys of the rig. Throws Error where one
// is missing.
lease::Members membersOf(const config::Rig& rig, const MasterOptions& options) {
    lease::Members members{.urls = rig.standby->etcd};
    const auto isSecure = [](const std::string& url) { return url.starts_with("https"); };
    if (std::ranges::none_of(members.urls, isSecure)) return members;
    const fs::path folder = config::keyFolderOf(options.show.rigPath, options.show.keyFolder);
    const lease::Certificates files{
        folder / "etcd-ca.pem", folder / "etcd.pem", folder / "etcd-key.pem"};
    for (const fs::path& file : {files.authority, files.own, files.ownKey})
        if (!fs::is_regular_file(file))
            throw Error(file.string() +
                        ": is not there, and etcd is past this machine: put there "
                        "the certificates by which both know each other");
    config::requirePrivate(files.ownKey);
    members.certificates = files;
    return members;
}

// The files of a world that is followed. A species that is new on this machine takes minutes.
simulation::Assets followedAssets(const config::Rig& rig,
                                  const supervisor::ShowOptions& show,
                                  machine::ServiceNotifier& service,
                                  const standby::WantedWorld& wanted) {
    class LongWork {
      public:
        explicit LongWork(machine::ServiceNotifier& notified) : notified_{notified} {}
        ~LongWork() { notified_.endLongWork(); }
        LongWork(const LongWork&) = delete;
        LongWork& operator=(const LongWork&) = delete;

      private:
        machine::ServiceNotifier& notified_;
    };
    const LongWork work(service);
    service.beginLongWork("making the world of scene " + wanted.scene);
    simulation::AssetChoice choice = choiceOf(rig, show);
    choice.seed = wanted.seed;
    choice.fish = wanted.fish;
    choice.tell = [&](const std::string& what) { service.beginLongWork(what); };
    return simulation::readAssets(sceneFile(rig, show.rigPath, wanted.scene), choice);
}

// How this machine follows the other one.
standby::FollowerOptions followerOptions(const config::Rig& rig,
                                         const MasterOptions& options,
                                         const std::string& machine) {
    const std::string master = options.standsBy ? rig.controlAddress : rig.standby->controlAddress;
    std::optional<net::PeerKeys> keys;
    if (config::needsKeys(rig)) {
        const fs::path folder = config::keyFolderOf(options.show.rigPath, options.show.keyFolder);
        const config::KeyFile own = config::readKeyFile(
            config::keyFileIn(folder, config::nameOf(config::KeyRole::Standby)));
        keys = net::PeerKeys{own.masterKey, {own.publicKey, own.secretKey}};
    }
    return {.machine = machine,
            .connect = [master, keys] { return net::connectNode(master, {}, keys); },
            .journal = wire::journalOf(options.show.rigPath),
            .drawings = wire::drawingsOf(options.show.rigPath),
            .assets =
                [rig, show = options.show, service = options.service](
                    const standby::WantedWorld& wanted) {
                    return followedAssets(rig, show, *service, wanted);
                }};
}

// How long nobody may have been the master before this machine is; nothing: for ever. A standby
// with the world of the last master comes first; one that has not caught up with a new master
// waits.
std::optional<std::chrono::milliseconds> patienceOf(const standby::Follower& follower,
                                                    const lease::Mastership& mastership,
                                                    const MasterOptions& options) {
    using std::chrono::milliseconds;
    constexpr milliseconds kOfStandby{5000}, kOfMaster{300};
    if (!options.standsBy && !follower.hasWorld()) return kOfMaster;
    if (!follower.hasWorld()) return std::nullopt;
    return follower.lease() == mastership.lastRevision() ? milliseconds{0} : kOfStandby;
}

// Follows the other machine until this one is the master. False: a signal ends it.
bool standBy(standby::Follower& follower,
             lease::Mastership& mastership,
             const MasterOptions& options) {
    std::atomic<bool> isStopped = false;
    const cli::SignalWatch watch([&] { isStopped = true; });
    while (mastership.revision() == 0 && !isStopped) {
        follower.turn();
        mastership.campaign(patienceOf(follower, mastership, options));
        options.service->alive(follower.tick().value);
    }
    return !isStopped;
}

// What was set is kept on this machine's disk as well.
void keepShow(const conductor::ConductorOptions& conducting) {
    try {
        wire::keepShow(conducting.keptAt, conducting.kept);
    } catch (const Error& problem) {
        logWarning("{}", problem.what());
    }
}

// The show of the world that was followed.
void showTakenOver(const config::Rig& rig,
                   const MasterOptions& options,
                   standby::Follower::TakenOver taken,
                   const JournalPlace& place,
                   std::unique_ptr<net::MasterChannels> channels) {
    conductor::ConductorOptions conducting = conductorOptions(rig, options);
    wire::apply(conducting.wanted, taken.show.wanted);
    conducting.kept = taken.show.kept;
    keepShow(conducting);
    conducting.journal = taken.world->journal().report();
    conducting.looks.makeWorld = worldsOf(rig, options.show, place);
    const Shown shown{taken.assets.bytes, taken.world->living(), *taken.world};
    show(rig, conducting, shown, std::move(channels));
}

}  // namespace

bool hasStandby(const config::Rig& rig, const MasterOptions& options) {
    return rig.standby && !options.lockstep && options.show.recordPath.empty() &&
           options.show.replayPath.empty();
}

bool showByLease(const config::Rig& rig,
                 const MasterOptions& options,
                 std::unique_ptr<net::MasterChannels> channels) {
    const std::string machine = options.standsBy ? rig.standby->machine : "main";
    lease::Mastership mastership(membersOf(rig, options), lease::Candidate{rig.name, machine});
    auto fenced = std::make_unique<standby::FencedChannels>(std::move(channels), mastership);
    std::optional<conductor::Preparation> answers(std::in_place, *fenced);
    answers->say("machine " + machine + " stands by");
    const fs::path folder = wire::journalOf(options.show.rigPath);
    JournalPlace place{folder, std::make_shared<journal::FolderLock>(folder), {}};
    std::optional<standby::Follower> follower(followerOptions(rig, options, machine));
    options.service->ready();
    logInfo("machine {} stands by", machine);
    if (!standBy(*follower, mastership, options)) return false;
    answers.reset();
    MasterOptions leading = options;
    leading.mastership = &mastership;
    leading.machine = machine;
    if (follower->hasWorld()) {
        auto taken = follower->takeOver();
        follower.reset();
        showTakenOver(rig, leading, std::move(taken), place, std::move(fenced));
    } else {
        // Its journal, and the lock of the folder, are for showNew().
        follower.reset();
        place.lock.reset();
        if (options.standsBy)
            throw Error(
                "the master's world was lost before this machine could go on with it; start it "
                "again");
        showNew(rig, leading, std::move(fenced));
    }
    return mastership.isLost();
}

}  // namespace aquarama
