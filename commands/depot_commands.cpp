// SPDX-License-Identifier: Apache-2.0
// `aquarama release serve`, `follow`, `stage`, `go`, `back` and `status`: a release comes to all
// machines of a hall together.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "commands/commands.h"
#include "common/base/dates.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/cli/outputs.h"
#include "common/config/calendar.h"
#include "common/config/keys.h"
#include "common/config/rig.h"
#include "common/config/text_file.h"
#include "common/machine/service_notifier.h"
#include "releases/agent.h"
#include "releases/depot.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// The name of the master's machine.
constexpr const char* kMainMachine = "main";

struct ServeOptions {
    std::string rig = supervisor::kDefaultRig;
    std::string keys;   // folder; empty: the rig's
    std::string depot;  // folder
    std::string key;    // public, file
    releases::RolloutLimits limits = {};
};

struct FollowOptions {
    std::string depot;  // address; empty: the key says it
    std::string key;    // file, of CURVE; empty: the depot is on this machine
    std::string place;  // without a key
    std::string system, program, showKey;
};

struct AskOptions {
    std::string rig = supervisor::kDefaultRig;
    std::string key;      // file; empty: the crew's, where the rig needs one
    std::string version;  // of stage
    bool json = false;    // of status
};

// Throws Error where the rig has none.
std::string depotOf(const config::Rig& rig, const std::string& path) {
    if (rig.sides.depot.empty())
        throw Error(path + ": has no depot; give its network one: depot: \"tcp://127.0.0.1:7403\"");
    return rig.sides.depot;
}

releases::HallMachines machinesOf(const config::Rig& rig) {
    releases::HallMachines machines;
    const auto add = [&](const std::string& place, const std::string& machine) {
        machines.machineOf[place] = machine;
        if (std::ranges::find(machines.names, machine) == machines.names.end())
            machines.names.push_back(machine);
    };
    add(kMainMachine, kMainMachine);
    for (const config::Channel& channel : rig.channels)
        add(channel.name, channel.machine.empty() ? kMainMachine : channel.machine);
    if (rig.standby)
        add(std::string(config::nameOf(config::KeyRole::Standby)), rig.standby->machine);
    return machines;
}

// Hours that cannot be read, and a clock that is wrong, close nothing.
bool isClosedBy(const fs::path& file) {
    try {
        if (!fs::exists(file)) return false;
        const double now = systemSeconds();
        if (!clockDoubt(now, static_cast<double>(builtAt())).empty()) return false;
        const auto hours = config::parseHours(config::readTextFile(file.string()), file.string());
        return !config::wantedAt(hours, static_cast<long long>(now)).isOpen;
    } catch (const Error& problem) {
        logWarning("{}; a release waits for a word", problem.what());
        return false;
    }
}

// Until a signal.
void serveReleases(const ServeOptions& options) {
    cli::holdSignals();
    const config::Rig rig = config::readRig(options.rig);
    const std::string address = depotOf(rig, options.rig);
    supervisor::ShowOptions show;
    show.rigPath = options.rig;
    show.keyFolder = options.keys;
    const auto keys = masterKeysOf(rig, show);
    const fs::path hours = config::consoleFolderOf(options.rig) / config::kHoursFile;
    releases::Depot depot({.machines = machinesOf(rig),
                           .folder = options.depot,
                           .key = releases::readShowKey(options.key),
                           .limits = options.limits,
                           .isClosed = [hours] { return isClosedBy(hours); },
                           .hasKeys = keys.has_value()},
                          net::bindMaster(address, "tcp://127.0.0.1:*", {}, keys));
    machine::ServiceNotifier service;
    service.ready();
    service.alive(0);
    cli::say("the depot " + options.depot + " is at " + address);
    const cli::SignalWatch watch([&] { depot.stop(); });
    depot.run();
}

std::optional<net::PeerKeys> peerKeysOf(const std::string& file) {
    if (file.empty()) return std::nullopt;
    const config::KeyFile key = config::readOwnKey(file);
    return net::PeerKeys{key.masterKey, {key.publicKey, key.secretKey}};
}

// Throws Error where neither the options nor the key name it.
std::string depotOf(const FollowOptions& options) {
    std::string address = options.depot;
    if (address.empty() && !options.key.empty())
        address = config::readKeyFile(options.key).depotAddress;
    if (address.empty())
        throw Error(options.key.empty()
                        ? "there is no key that names the depot; name it with --depot"
                        : options.key +
                              ": names no depot, as its rig had none when the key "
                              "was made; name it with --depot");
    return address;
}

// Until a signal, or until the machine starts anew.
void followDepot(const FollowOptions& options) {
    cli::holdSignals();
    releases::Agent agent({.place = options.place.empty() ? kMainMachine : options.place,
                           .system = options.system,
                           .program = options.program,
                           .memory = userFolder("XDG_STATE_HOME", ".local/state") / "release.txtpb",
                           .key = releases::readShowKey(options.showKey)},
                          net::connectNode(depotOf(options), {}, peerKeysOf(options.key)));
    machine::ServiceNotifier service;
    service.ready();
    service.alive(0);
    const cli::SignalWatch watch([&] { agent.stop(); });
    agent.run();
}

std::string keyPathOf(const AskOptions& options, const config::Rig& rig) {
    if (!options.key.empty() || !config::needsKeys(rig)) return options.key;
    return config::keyFileIn(config::keyFolderOf(options.rig), "crew").string();
}

// Nothing where nobody answers in time. A question is repeated, since the connection may not be
// there yet; a request is not.
std::optional<v1::DepotReply> replyTo(net::NodeChannels& channels,
                                      const v1::DepotRequest& request,
                                      net::Duration patience) {
    constexpr auto kBetween = std::chrono::milliseconds(100);
    const bool isQuestion = request.what() == v1::DepotRequest::STATUS;
    v1::DepotMessage message;
    *message.mutable_request() = request;
    const std::vector<std::byte> packet = releases::encode(message);
    const net::Moment end = net::monotonicNow() + patience;
    for (bool isSent = false; net::monotonicNow() < end; isSent = true) {
        if (!isSent || isQuestion) channels.sendControl(packet);
        channels.wait(kBetween);
        while (const auto answer = channels.receiveControl())
            if (const auto heard = releases::decode(*answer);
                heard && heard->has_reply() && heard->reply().number() == request.number())
                return heard->reply();
    }
    return std::nullopt;
}

// Throws Error where nobody answers, or where it is refused.
v1::DepotReply askDepot(const AskOptions& options, v1::DepotRequest::What what) {
    using namespace std::chrono_literals;
    constexpr auto kPatience = 5s, kPatienceOfStage = 600s;  // in which a release is checked
    const config::Rig rig = config::readRig(options.rig);
    const std::string address = depotOf(rig, options.rig);
    const auto channels = net::connectNode(address, {}, peerKeysOf(keyPathOf(options, rig)));
    v1::DepotRequest request;
    request.set_number(1);
    request.set_what(v1::DepotRequest::STATUS);
    auto reply = replyTo(*channels, request, kPatience);
    if (reply && what != v1::DepotRequest::STATUS) {
        request.set_number(2);
        request.set_what(what);
        if (!options.version.empty()) request.set_version(options.version);
        reply = replyTo(*channels, request, kPatienceOfStage);
    }
    if (!reply)
        throw Error("no depot answers at " + address +
                    "; start it (aquarama release serve), or show a key that may ask (--key)");
    if (reply->has_refusal()) throw Error(reply->refusal());
    return *reply;
}

nlohmann::json jsonOf(const v1::ReleaseName& name) {
    if (name.version().empty()) return nullptr;
    return {{"version", name.version()}, {"serial", name.serial()}};
}

nlohmann::json jsonOf(const v1::DepotReply& reply) {
    const releases::RolloutState state = releases::stateIn(reply.rollout());
    nlohmann::json machines = nlohmann::json::array();
    for (const v1::MachineStatus& machine : reply.machines())
        machines.push_back({{"name", machine.name()},
                            {"runs", jsonOf(machine.booted())},
                            {"silent_s", machine.silent_s()},
                            {"frames", machine.frames()},
                            {"problem", machine.problem()}});
    return {{"phase", releases::nameOf(state.phase)},
            {"stable", jsonOf(reply.rollout().stable())},
            {"candidate", jsonOf(reply.rollout().candidate())},
            {"before", jsonOf(reply.rollout().before())},
            {"ready", reply.is_ready()},
            {"reason", reply.rollout().reason()},
            {"waiting_for", reply.waiting_for()},
            {"machines", machines}};
}

std::string lineOf(const v1::MachineStatus& machine) {
    if (!machine.has_booted()) return fmt::format("{:<16} was not heard", machine.name());
    return fmt::format("{:<16} {:<16} heard {:.0f} s ago{}",
                       machine.name(),
                       machine.booted().version(),
                       machine.silent_s(),
                       machine.has_problem() ? ": " + machine.problem() : "");
}

// "trying 1.4.0 instead of 1.3.0"
std::string headOf(const releases::RolloutState& state) {
    if (!state.stable) return "not all machines have said what they run";
    if (!state.candidate) return "all run " + state.stable.version;
    return fmt::format("{} {} of {}",
                       releases::nameOf(state.phase),
                       state.candidate.version,
                       state.stable.version);
}

void printStatus(const v1::DepotReply& reply) {
    cli::say(headOf(releases::stateIn(reply.rollout())));
    for (const v1::MachineStatus& machine : reply.machines()) cli::say(lineOf(machine));
    if (reply.has_waiting_for()) cli::say("waiting: " + reply.waiting_for());
    if (reply.is_ready()) cli::say("all machines have it; aquarama release go starts them with it");
    if (reply.rollout().has_reason()) cli::say(reply.rollout().reason());
}

void showReleaseStatus(const AskOptions& options) {
    const v1::DepotReply reply = askDepot(options, v1::DepotRequest::STATUS);
    options.json ? cli::say(jsonOf(reply).dump(2)) : printStatus(reply);
}

// Adds RIG and --key to what people ask for.
template <class Run>
AddedCommand<AskOptions> addRequest(CommandLine& line,
                                    CLI::App& parent,
                                    const std::string& name,
                                    const std::string& what,
                                    Run run) {
    const auto added = line.addTo<AskOptions>(parent, name, what, run);
    added.app.add_option("RIG", added.options.rig, "whose machines")->required();
    added.app.add_option(
        "--key", added.options.key, "file of the key to show, instead of the crew's");
    return added;
}

// One that changes something.
auto asking(v1::DepotRequest::What what) {
    return [what](const AskOptions& options) { printStatus(askDepot(options, what)); };
}

void addServe(CommandLine& line, CLI::App& release) {
    const auto [app, options] = line.addTo<ServeOptions>(
        release, "serve", "give releases to the machines of a rig, until a signal", serveReleases);
    app.add_option("RIG", options.rig, "whose network names the depot")->required();
    app.add_option("--depot", options.depot, "folder with the releases, VERSION/ each")->required();
    app.add_option("--signed-by", options.key, "the show's public key")->required();
    app.add_option("--keys", options.keys, "folder of the rig's keys, instead of the user's");
    app.add_option(
           "--frames", options.limits.frames, "that each node presents until a release is good")
        ->capture_default_str();
    app.add_option("--seconds", options.limits.trial, "after which one that is not good is left")
        ->check(cli::number(1, 86400))
        ->capture_default_str();
}

void addFollow(CommandLine& line, CLI::App& release) {
    const auto [app, options] = line.addTo<FollowOptions>(
        release, "follow", "let this machine run what the depot says, until a signal", followDepot);
    app.add_option("--depot", options.depot, "address of the depot, where the key does not say it");
    app.add_option("--key", options.key, "file of the key to show (aquarama keys bundle)");
    app.add_option("--place", options.place, "without a key: a channel that this machine shows")
        ->check(cli::plainWord());
    app.add_option("--system", options.system, "folder of the system partition")->required();
    app.add_option("--machine", options.program, "program that tells of this machine")->required();
    app.add_option("--signed-by", options.showKey, "the show's public key")->required();
}

}  // namespace

void addDepotCommands(CommandLine& line, CLI::App& release) {
    addServe(line, release);
    addFollow(line, release);
    const auto stage = addRequest(line,
                                  release,
                                  "stage",
                                  "let all machines copy a release, while the show runs",
                                  asking(v1::DepotRequest::STAGE));
    stage.app.add_option("VERSION", stage.options.version, "a release in the depot's folder")
        ->required();
    addRequest(line,
               release,
               "go",
               "start all machines with the release that they have copied",
               asking(v1::DepotRequest::GO));
    addRequest(line,
               release,
               "back",
               "leave the release that comes, or return to the one before",
               asking(v1::DepotRequest::BACK));
    const auto status =
        addRequest(line, release, "status", "what all machines run", showReleaseStatus);
    status.app.add_flag("--json", status.options.json, "for programs");
}

}  // namespace aquarama
