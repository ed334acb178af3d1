// SPDX-License-Identifier: Apache-2.0
// `aquarama master`: connects a world, living or replayed, to the conductor, which shows it on the
// wall.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <sys/stat.h>

#include "commands/commands.h"
#include "common/base/amounts.h"
#include "common/base/digest.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/cli/command_line.h"
#include "common/cli/outputs.h"
#include "common/config/hours.h"
#include "common/config/keys.h"
#include "common/config/rig.h"
#include "common/config/scene.h"
#include "common/lease/mastership.h"
#include "common/net/channels.h"
#include "common/wall/wall.h"
#include "common/wire/recording.h"
#include "master/conductor/conductor.h"
#include "master/conductor/preparation.h"
#include "master/journal/journalled_world.h"
#include "master/simulation/living_world.h"
#include "master/simulation/recorded_world.h"
#include "master/standby/fenced_channels.h"
#include "master/standby/follower.h"
#include "master/supervisor/children.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// `lockstep`: frame n shows tick n. `resume`: the show continues after a crash of its master.
struct MasterOptions {
    supervisor::ShowOptions show;
    bool lockstep = false;
    bool resume = false;
    bool standsBy = false;         // it becomes the master of a show alone that it has followed
    std::shared_ptr<LogFile> log;  // only of a live show
    machine::ServiceNotifier* service = nullptr;  // null: nobody is notified
    // As the conductor's; null: of a rig without a standby.
    lease::Mastership* mastership = nullptr;
    std::string machine = {};
};

// The quality; empty: the nodes measure which one they can draw. In lockstep no clock is read, so
// nothing is measured.
std::optional<config::QualityTier> qualityOf(const config::Rig& rig, const MasterOptions& options) {
    constexpr config::QualityTier kOfLockstep = config::QualityTier::Low;
    if (!options.show.quality.empty()) return config::tierNamed(options.show.quality);
    if (!rig.quality && options.lockstep) return kOfLockstep;
    return rig.quality;
}

// The suffix of a scene's file. A text without it is the name of a scene beside the rig's scene.
constexpr std::string_view kSceneEnding = ".txtpb";

// The names of scenes without suffix, sorted, for an error message.
std::string scenesIn(const fs::path& folder) {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == kSceneEnding) names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    std::string list;
    for (const std::string& one : names) list += (list.empty() ? "" : ", ") + one;
    return list;
}

// The file of a scene: a name lies beside the rig's scene. Throws Error, which lists the scenes
// that exist.
std::string sceneFile(const config::Rig& rig, const std::string& rigPath, const std::string& name) {
    if (name.ends_with(kSceneEnding)) return name;
    const fs::path folder = fs::path(config::scenePathOf(rig, rigPath)).parent_path();
    const fs::path file = folder / (name + std::string(kSceneEnding));
    if (fs::is_regular_file(file)) return file.string();
    throw Error("there is no scene \"" + name + "\" in " + folder.string() + ", only " +
                scenesIn(folder));
}

// What is chosen for this run: by the options, else by the rig.
v1::WantedShow chosenBy(const MasterOptions& options) {
    const supervisor::ShowOptions& show = options.show;
    v1::WantedShow chosen;
    if (!show.scenePath.empty()) chosen.set_scene(show.scenePath);
    if (!show.quality.empty()) chosen.set_quality(wire::tierOf(config::tierNamed(show.quality)));
    if (const auto pattern = wire::patternNamed(show.pattern))
        chosen.set_pattern(static_cast<v1::WantedShow::Shown>(*pattern));
    return chosen;
}

// What earlier runs were told to show. A file that cannot be read does not keep the wall dark.
v1::WantedShow keptShow(const config::Rig& rig, const MasterOptions& options) {
    const fs::path path = wire::keptShowOf(options.show.rigPath);
    try {
        v1::WantedShow kept = wire::readKeptShow(path);
        if (kept.has_scene()) static_cast<void>(sceneFile(rig, options.show.rigPath, kept.scene()));
        return kept;
    } catch (const Error& problem) {
        logWarning("what was set before is not shown: {}", problem.what());
        return {};
    }
}

// The values with which the show begins. A live show begins with earlier values, overridden by the
// options of its command line. A restarted master keeps all values that were set.
void chooseWanted(const config::Rig& rig,
                  const MasterOptions& options,
                  conductor::ConductorOptions& conductor) {
    conductor.wanted.set_scene(fs::path(rig.scene).stem().string());
    conductor.wanted.set_quality(wire::tierOf(qualityOf(rig, options)));
    const bool isKept = !options.lockstep && options.show.replayPath.empty();
    if (isKept) {
        conductor.keptAt = wire::keptShowOf(options.show.rigPath);
        conductor.drawingsAt = wire::drawingsOf(options.show.rigPath);
        conductor.kept = keptShow(rig, options);
    }
    const v1::WantedShow chosen = chosenBy(options);
    const auto& [under, over] =
        options.resume ? std::pair{chosen, conductor.kept} : std::pair{conductor.kept, chosen};
    wire::apply(conductor.wanted, under);
    wire::apply(conductor.wanted, over);
    if (const std::string text = wire::textOf(conductor.kept); !text.empty())
        logInfo("as it was set before: {} (change it with aquarama set)", text);
}

// Looks at the files that a rig names, whether they have changed: LookSources::changedRig.
class RigFileWatch {
  public:
    RigFileWatch(config::Rig rig, std::string path)
        : rig_{std::move(rig)}, path_{std::move(path)}, seen_{look()} {}

    // The new rig; empty where no file has changed. Throws Error where the new files are wrong,
    // once for each change.
    std::optional<config::Rig> operator()() {
        auto now = look();
        if (now == seen_) return std::nullopt;
        seen_ = std::move(now);
        config::readRigFiles(rig_, path_);
        wall::checkGeometry(rig_, path_);
        return rig_;
    }

  private:
    // Inode, size and times of change of a file: its replacement may have the same size and time of
    // writing. A file may be missing while it is being replaced.
    using Stamp = std::array<std::int64_t, 7>;
    static Stamp stampOf(const std::string& file) {
        struct stat found {};
        if (stat(file.c_str(), &found) != 0) return {};
        return {static_cast<std::int64_t>(found.st_dev),
                static_cast<std::int64_t>(found.st_ino),
                found.st_size,
                found.st_mtim.tv_sec,
                found.st_mtim.tv_nsec,
                found.st_ctim.tv_sec,
                found.st_ctim.tv_nsec};
    }
    [[nodiscard]] std::vector<Stamp> look() const {
        std::vector<Stamp> stamps;
        for (const auto& [name, content] : rig_.files)
            stamps.push_back(stampOf(config::besideFile(path_, name)));
        return stamps;
    }

    config::Rig rig_;
    std::string path_;
    std::vector<Stamp> seen_;
};

// The conductor's options for this run.
conductor::ConductorOptions conductorOptions(const config::Rig& rig, const MasterOptions& options) {
    conductor::ConductorOptions conductor;
    conductor.pace = options.lockstep ? wire::Pace::Lockstep : wire::Pace::Live;
    chooseWanted(rig, options, conductor);
    conductor.frames = options.show.frames;
    conductor.traceDirectory = options.show.traceFolder;
    conductor.log = options.log.get();
    conductor.service = options.service;
    if (options.mastership == nullptr) return conductor;
    conductor.machine = options.machine;
    conductor.isSuperseded = [leads = options.mastership] { return leads->isLost(); };
    conductor.resign = [leads = options.mastership] { leads->resign(); };
    conductor.guestsKey = guestsKeyOf(rig, options.show);
    conductor.hoursAt = config::consoleFolderOf(options.show.rigPath) / config::kHoursFile;
    if (!rig.files.empty()) conductor.looks.changedRig = RigFileWatch(rig, options.show.rigPath);
    return conductor;
}

// The simulation that is shown: the living world, or `simulation`, a decorator that records or
// replays it.
struct Shown {
    const wire::AssetBundle& assets;
    const simulation::LivingWorld& world;
    conductor::Simulation& simulation;
};

// Returns when the show is over. Until then `*running` is its conductor.
void show(const config::Rig& rig,
          const conductor::ConductorOptions& options,
          const Shown& shown,
          std::unique_ptr<net::MasterChannels> channels,
          conductor::Conductor** running = nullptr) {
    conductor::Conductor conductor(rig,
                                   options,
                                   shown.simulation,
                                   shown.assets,
                                   shown.world.world().traits(),
                                   std::move(channels));
    if (running != nullptr) *running = &conductor;
    const cli::SignalWatch watch([&] { conductor.stop(); });
    conductor.run();
}

// Answers requests while the master's world is made, and notifies the service manager.
class WorldPreparation {
  public:
    WorldPreparation(net::MasterChannels& channels, machine::ServiceNotifier* service)
        : answers_{channels}, service_{service} {}
    // Any thread, but never two at once.
    void tell(const std::string& what) {
        const std::string sentence = answers_.tell(what);
        if (service_ != nullptr) service_->beginLongWork(sentence);
    }

  private:
    conductor::Preparation answers_;
    machine::ServiceNotifier* service_;
};

// What a show is made of, by its rig.
simulation::AssetChoice choiceOf(const config::Rig& rig, const supervisor::ShowOptions& options) {
    simulation::AssetChoice choice{.seed = options.seed, .fish = {}};
    if (!rig.drawings) return choice;
    choice.drawnSpecies = rig.drawings->species;
    choice.mostDrawings = rig.drawings->most;
    choice.drawingsMayBeEaten = rig.drawings->mayBeEaten;
    return choice;
}

// Of a show that keeps no journal because of its kind.
std::shared_ptr<const conductor::JournalReport> noJournal(const std::string& why) {
    return std::make_shared<conductor::JournalReport>(v1::JournalStatus::NOT_KEPT, why);
}

// Shows a new world and records it.
void showRecorded(const config::Rig& rig,
                  const MasterOptions& options,
                  const simulation::Assets& assets,
                  conductor::ConductorOptions conducting,
                  std::unique_ptr<net::MasterChannels> channels) {
    conducting.whyOneScene = "the show is recorded, and a recording has one scene";
    conducting.journal = noJournal("the show is recorded to " + options.show.recordPath);
    simulation::LivingWorld world(simulation::worldOptionsOf(assets));
    simulation::RecordingFile file(options.show.recordPath, assets.bytes);
    {
        simulation::RecordedWorld recorded(world, file);
        show(rig, conducting, {assets.bytes, world, recorded}, std::move(channels));
    }
    file.close();
}

// Where the worlds of a show are journalled, as long as the lock is held; or why they are not.
struct JournalPlace {
    fs::path folder;
    std::shared_ptr<journal::FolderLock> lock;
    std::shared_ptr<const conductor::JournalReport> absence;  // null: they are
};

// A world of a scene, in its journal where there is one. `made` is within `simulation`.
struct MadeWorld {
    std::unique_ptr<conductor::Simulation> simulation;
    const simulation::LivingWorld* made = nullptr;
    std::shared_ptr<const conductor::JournalReport> journal;
};
MadeWorld makeWorld(const simulation::Assets& assets,
                    const JournalPlace& place,
                    journal::TimeAway away) {
    if (place.absence) {
        auto world = std::make_unique<simulation::LivingWorld>(simulation::worldOptionsOf(assets));
        const simulation::LivingWorld* const made = world.get();
        return {std::move(world), made, place.absence};
    }
    auto world = journal::makeJournalled(place.folder, assets, away);
    const simulation::LivingWorld* const made = &world->living();
    auto report = world->journal().report();
    return {std::move(world), made, std::move(report)};
}

// A show in lockstep keeps no journal, nor does one where another show of the rig holds the folder.
JournalPlace placeOfJournal(const MasterOptions& options) {
    if (options.lockstep) return {{}, {}, noJournal("the show is in lockstep")};
    const fs::path folder = wire::journalOf(options.show.rigPath);
    try {
        return {folder, std::make_shared<journal::FolderLock>(folder), {}};
    } catch (const Error& problem) {
        logWarning("{}; this one keeps none", problem.what());
        return {
            {},
            {},
            std::make_shared<conductor::JournalReport>(v1::JournalStatus::REFUSED, problem.what())};
    }
}

// Makes the worlds of other scenes, in the journal where there is one.
auto worldsOf(const config::Rig& rig,
              const supervisor::ShowOptions& options,
              const JournalPlace& place) {
    return [rig, place, options](const std::string& scene) {
        simulation::Assets next =
            simulation::readAssets(sceneFile(rig, options.rigPath, scene), choiceOf(rig, options));
        MadeWorld made = makeWorld(next, place, journal::TimeAway::LeftOut);
        const auto traits = made.made->world().traits();
        return conductor::NextWorld{std::move(next.bytes),
                                    {traits.begin(), traits.end()},
                                    std::move(made.simulation),
                                    std::move(made.journal)};
    };
}

// Shows a new world, or the one of the show's journal. A show in lockstep keeps no journal.
void showNew(const config::Rig& rig,
             const MasterOptions& options,
             std::unique_ptr<net::MasterChannels> channels) {
    conductor::ConductorOptions conducting = conductorOptions(rig, options);
    std::optional<WorldPreparation> preparation(std::in_place, *channels, options.service);
    simulation::AssetChoice choice = choiceOf(rig, options.show);
    choice.fish = options.show.fish;
    choice.tell = [&](const std::string& what) { preparation->tell(what); };
    const simulation::Assets assets = simulation::readAssets(
        sceneFile(rig, options.show.rigPath, conducting.wanted.scene()), choice);
    preparation->tell("making the world");
    if (!options.show.recordPath.empty()) {
        preparation.reset();
        return showRecorded(rig, options, assets, std::move(conducting), std::move(channels));
    }
    const JournalPlace place = placeOfJournal(options);
    using journal::TimeAway;
    const TimeAway away = conducting.wanted.freeze() ? TimeAway::LeftOut : TimeAway::MadeUpFor;
    const MadeWorld world = makeWorld(assets, place, away);
    preparation.reset();
    conducting.journal = world.journal;
    conducting.looks.makeWorld = worldsOf(rig, options.show, place);
    show(rig, conducting, {assets.bytes, *world.made, *world.simulation}, std::move(channels));
}

// Shows a recording; the show ends with it.
void showAgain(const config::Rig& rig,
               const MasterOptions& options,
               std::unique_ptr<net::MasterChannels> channels) {
    std::optional<WorldPreparation> preparation(std::in_place, *channels, options.service);
    preparation->tell("reading the recording");
    const wire::Recording recording = wire::readRecording(options.show.replayPath);
    for (const std::string& doubt : wire::doubtsAbout(recording))
        logWarning("{}: {}", options.show.replayPath, doubt);
    const Tick from{options.show.replayFromTick};
    if (from > recording.lastTick())
        throw Error(options.show.replayPath + ": ends after " + timeOf(recording.lastTick()) +
                    "; begin --at an earlier time");
    simulation::LivingWorld world(simulation::worldOptionsOf(recording.assets));
    preparation->tell("going to " + timeOf(from));
    conductor::Conductor* running = nullptr;
    const auto onEnd = [&] {
        if (!options.lockstep) running->stop();
    };
    simulation::ReplayedWorld replayed(recording, world, from, onEnd);
    preparation.reset();
    conductor::ConductorOptions conducting = conductorOptions(rig, options);
    conducting.whyOneScene = "a recording is shown, and has one scene";
    conducting.journal = noJournal("a recording is shown");
    // In lockstep the world runs ahead of the frames, so the frames are counted instead.
    if (options.lockstep) {
        const std::uint64_t frames = recording.lastTick().value + 1 - from.value;
        conducting.frames = std::min(conducting.frames.value_or(frames), frames);
    }
    show(rig, conducting, {recording.assets, world, replayed}, std::move(channels), &running);
}

// Whether a show has a standby. One that keeps no journal has none.
bool hasStandby(const config::Rig& rig, const MasterOptions& options) {
    return rig.standby && !options.lockstep && options.show.recordPath.empty() &&
           options.show.replayPath.empty();
}

// Where etcd is, and the files for it, which lie beside the keys of the rig. Throws Error where one
// is missing.
lease::Members membersOf(const config::Rig& rig, const MasterOptions& options) {
    lease::Members members{.urls = rig.standby->etcd};
    const auto isSecure = [](const std::string& url) { return url.starts_with("https"); };
    if (std::ranges::none_of(members.urls, isSecure)) return members;
    const fs::path folder = options.show.keyFolder.empty()
                                ? config::keyFolderOf(options.show.rigPath)
                                : fs::path(options.show.keyFolder);
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

// How this machine follows the other one.
standby::FollowerOptions followerOptions(const config::Rig& rig,
                                         const MasterOptions& options,
                                         const std::string& machine) {
    const std::string master = options.standsBy ? rig.controlAddress : rig.standby->controlAddress;
    std::optional<net::PeerKeys> keys;
    if (config::needsKeys(rig)) {
        const fs::path folder = options.show.keyFolder.empty()
                                    ? config::keyFolderOf(options.show.rigPath)
                                    : fs::path(options.show.keyFolder);
        const config::KeyFile own = config::readKeyFile(
            config::keyFileIn(folder, config::nameOf(config::KeyRole::Standby)));
        keys = net::PeerKeys{own.masterKey, {own.publicKey, own.secretKey}};
    }
    return {.machine = machine,
            .connect = [master, keys] { return net::connectNode(master, {}, keys); },
            .journal = wire::journalOf(options.show.rigPath),
            .assets =
                [rig, show = options.show](const std::string& scene, std::uint32_t seed) {
                    simulation::AssetChoice choice = choiceOf(rig, show);
                    choice.seed = seed;
                    choice.fish = show.fish;
                    return simulation::readAssets(sceneFile(rig, show.rigPath, scene), choice);
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

// Starts this program anew, as it was started: as a standby of the machine that is the master now.
[[noreturn]] void startAnew() {
    std::ifstream file("/proc/self/cmdline");
    std::vector<std::string> arguments;
    for (std::string argument; std::getline(file, argument, '\0');)
        arguments.push_back(std::move(argument));
    arguments.erase(arguments.begin());
    supervisor::become({supervisor::ownProgram(), arguments});
}

// Which of both machines is the master is decided by the lease; the other one stands by.
void showByLease(const config::Rig& rig,
                 const MasterOptions& options,
                 std::unique_ptr<net::MasterChannels> channels) {
    const std::string machine = options.standsBy ? rig.standby->machine : "main";
    std::optional<lease::Mastership> mastership;
    mastership.emplace(membersOf(rig, options), lease::Candidate{rig.name, machine});
    auto fenced = std::make_unique<standby::FencedChannels>(std::move(channels), *mastership);
    std::optional<conductor::Preparation> answers(std::in_place, *fenced);
    answers->say("machine " + machine + " stands by");
    const fs::path folder = wire::journalOf(options.show.rigPath);
    JournalPlace place{folder, std::make_shared<journal::FolderLock>(folder), {}};
    standby::Follower follower(followerOptions(rig, options, machine));
    options.service->ready();
    logInfo("machine {} stands by", machine);
    if (!standBy(follower, *mastership, options)) return;
    answers.reset();
    MasterOptions leading = options;
    leading.mastership = &*mastership;
    leading.machine = machine;
    if (follower.hasWorld()) {
        showTakenOver(rig, leading, follower.takeOver(), place, std::move(fenced));
    } else {
        place.lock.reset();  // for showNew()
        showNew(rig, leading, std::move(fenced));
    }
    if (!mastership->isLost()) return;
    mastership.reset();
    startAnew();
}

// Opens the log of this rig's shows, which also gets the master's own lines. Where it cannot be
// written, the show runs without it.
std::shared_ptr<LogFile> openLog(const std::string& rigPath) {
    const fs::path path = userFolder("XDG_STATE_HOME", ".local/state") / "logs" /
                          (fs::path(rigPath).stem().string() + ".jsonl");
    try {
        auto log = std::make_shared<LogFile>(path);
        setLogListener([log](Severity severity, const std::string& line) {
            log->write("master", log->masterFrame, severity, line);
        });
        return log;
    } catch (const Error& problem) {
        logWarning("{}", problem.what());
        return nullptr;
    }
}

// Throws Error also where the rig names no standby and this is to be one.
std::unique_ptr<net::MasterChannels> bindOwn(const config::Rig& rig, const MasterOptions& options) {
    const auto keys = masterKeysOf(rig, options.show);
    if (!options.standsBy) return net::bindMaster(rig.controlAddress, rig.stateAddress, {}, keys);
    if (!rig.standby)
        throw Error(options.show.rigPath + ": names no standby: write standby { ... } in it");
    return net::bindMaster(rig.standby->controlAddress, rig.standby->stateAddress, {}, keys);
}

// Binds the addresses before the world is made, which takes seconds, or minutes at the first start.
// So a second master is refused at once, and requests are answered meanwhile.
void runMaster(const MasterOptions& options) {
    cli::holdSignals();
    machine::ServiceNotifier service;
    const config::Rig rig = config::readRig(options.show.rigPath);
    wall::checkGeometry(rig, options.show.rigPath);
    cli::requireFolder("--trace", options.show.traceFolder);
    if (!options.show.recordPath.empty()) simulation::requireNewRecording(options.show.recordPath);
    cli::requireFile("--record", options.show.recordPath);
    auto channels = bindOwn(rig, options);
    MasterOptions telling = options;
    telling.service = &service;
    if (!options.lockstep) telling.log = openLog(options.show.rigPath);
    service.beginLongWork("making the world");
    const auto showThis = hasStandby(rig, options)          ? showByLease
                          : options.show.replayPath.empty() ? showNew
                                                            : showAgain;
    showThis(rig, telling, std::move(channels));
    setLogListener({});
}

}  // namespace

void addMaster(CommandLine& line) {
    const auto [command, options] = line.add<MasterOptions>(
        "master", "the master of a rig, alone: aquarama master RIG", runMaster);
    describeWorld(command, options.show);
    describeWall(command, options.show);
    command.add_flag("--lockstep", options.lockstep, "frame n shows tick n; no clock is read");
    command
        .add_flag("--resume",
                  options.resume,
                  "continue a show: values that were set override the options")
        ->excludes("--lockstep");
    command.add_option("--from-tick", options.show.replayFromTick, "begin --replay at this tick");
    command.add_option("--replay", options.show.replayPath, "show this recording")
        ->excludes("--record")
        ->excludes("--seed")
        ->excludes("--scene")
        ->excludes("--fish");
}

void addStandby(CommandLine& line) {
    const auto [command, options] = line.add<MasterOptions>(
        "standby",
        "simulate along with the master of a rig, and take over when it dies: aquarama standby RIG",
        runMaster);
    options.standsBy = options.resume = true;
    command.add_option("RIG", options.show.rigPath, "the rig's file")->required();
    command
        .add_option("--fish",
                    options.show.fish,
                    "number of fish of the first species, as the master was told")
        ->check(cli::wholeNumber(0, kMostFish));
    command.add_option("--keys",
                       options.show.keyFolder,
                       "folder of the rig's keys, instead of the user's (aquarama keys)");
}

}  // namespace aquarama
