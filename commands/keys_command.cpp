// SPDX-License-Identifier: Apache-2.0
// `aquarama keys`: makes, lists, revokes and replaces the keys of a rig, and writes the key file
// for another machine.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

#include "commands/commands.h"
#include "common/base/counted.h"
#include "common/base/dates.h"
#include "common/base/log.h"
#include "common/base/output_file.h"
#include "common/config/keys.h"
#include "common/config/rig.h"
#include "common/enrol/hand_over.h"
#include "common/net/channels.h"
#include "master/conductor/conductor.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;
using config::KeyFile;
using config::KeyRole;

// The name of the master's own key.
constexpr std::string_view kMaster = "master";

// Options of all subcommands, each of which uses some.
struct KeyOptions {
    std::string rig = supervisor::kDefaultRig;
    std::string folder;  // empty: config::keyFolderOf()
    std::string name;    // whose key
    std::string out;     // of a bundle; empty: NAME.key here

    [[nodiscard]] fs::path keys() const { return config::keyFolderOf(rig, folder); }
};

// Why the clock is certainly wrong; empty where it may be right.
std::string doubtOfClock() {
    return clockDoubt(systemSeconds(), static_cast<double>(builtAt()));
}

// Of a key that is made now. Throws Error where the clock is wrong.
std::string dayOfNewKey() {
    return enrol::dayOfNewKey(systemSeconds(), static_cast<double>(builtAt()));
}

// Warns on standard error about a wrong clock, and continues: a revocation must not wait.
void warnOfClock(const std::string& what) {
    if (const std::string doubt = doubtOfClock(); !doubt.empty())
        std::cerr << "aquarama keys: " << doubt << "; " << what << "; " << kSetTheClock << '\n';
}

// Today in UTC; never before the day on which this program was built.
std::string today() {
    return dayOf(std::max(systemSeconds(), static_cast<double>(builtAt())));
}

// Throws Error where the rig is on one machine and so needs no keys.
config::Rig keyedRig(const KeyOptions& options) {
    config::Rig rig = config::readRig(options.rig);
    if (!config::needsKeys(rig))
        throw Error(options.rig + ": listens on its own machine only (" + rig.controlAddress +
                    "), which needs no keys; give network the address of a network card first");
    return rig;
}

// The names of all holders: the master, each channel, and each role of users.
std::vector<std::pair<std::string, KeyRole>> holdersOf(const config::Rig& rig) {
    std::vector<std::pair<std::string, KeyRole>> holders{{std::string(kMaster), KeyRole::Master}};
    for (const config::Channel& channel : rig.channels)
        holders.emplace_back(channel.name, KeyRole::Node);
    for (const KeyRole role :
         {KeyRole::Watcher, KeyRole::Visitor, KeyRole::Operator, KeyRole::Crew, KeyRole::Guests})
        holders.emplace_back(config::nameOf(role), role);
    if (rig.standby) holders.emplace_back(config::nameOf(KeyRole::Standby), KeyRole::Standby);
    return holders;
}

// Throws Error, with the place in the rig, where a channel has the name of a role: both would share
// a key file.
void requireOwnNames(const KeyOptions& options, const config::Rig& rig) {
    for (const config::Channel& channel : rig.channels)
        if (std::ranges::find(config::kRoleNames, channel.name) != config::kRoleNames.end())
            throw Error(config::placed(
                options.rig,
                channel.place,
                "channel \"" + channel.name + "\" has the name of a role: rename it"));
}

// Throws Error where the rig has no keys yet.
KeyFile masterOf(const KeyOptions& options) {
    const fs::path path = config::keyFileIn(options.keys(), kMaster);
    if (!fs::exists(path))
        throw Error(path.string() +
                    ": is not there: make the keys of the rig first (aquarama keys " + "new " +
                    options.rig + ")");
    return config::readKeyFile(path);
}

// Makes missing keys; existing keys stay. So a rig with a new channel gets a key for it.
void makeKeys(const KeyOptions& options) {
    const config::Rig rig = keyedRig(options);
    requireOwnNames(options, rig);
    const std::string day = dayOfNewKey();
    const fs::path folder = options.keys();
    requireWritableFolder(folder);
    fs::permissions(folder, fs::perms::owner_all);
    std::string masterKey;
    std::uint64_t made = 0;
    for (const auto& [name, role] : holdersOf(rig)) {
        const fs::path path = config::keyFileIn(folder, name);
        if (fs::exists(path)) {
            if (role == KeyRole::Master) masterKey = config::readKeyFile(path).publicKey;
            continue;
        }
        KeyFile key = enrol::freshKey(rig, options.rig, name, role, day);
        if (role == KeyRole::Master) masterKey = key.publicKey;
        key.masterKey = masterKey;
        config::writeKeyFile(path, key);
        ++made;
    }
    std::cout << counted(made, "key") << " made in " << folder.string() << "\n"
              << "aquarama keys bundle " << options.rig
              << " NAME writes the file that another machine needs\n";
}

// Never prints a secret key.
void listKeys(const KeyOptions& options) {
    masterOf(options);
    warnOfClock("how old a key is cannot be told");
    const std::vector<KeyFile> keys = config::readKeyFolder(options.keys());
    fmt::print("{:<16} {:<10} {:<12} {:<20} {}\n", "name", "role", "made", "state", "public key");
    for (const KeyFile& key : keys)
        fmt::print("{:<16} {:<10} {:<12} {:<20} {}\n",
                   key.name,
                   config::nameOf(key.role),
                   key.made,
                   key.revoked.empty() ? "valid" : "revoked " + key.revoked,
                   key.publicKey);
}

// The key of options.name. Throws Error, which lists the existing names, where there is none.
KeyFile chosen(const KeyOptions& options) {
    masterOf(options);
    std::string names;
    for (const KeyFile& key : config::readKeyFolder(options.keys())) {
        if (key.name == options.name) return key;
        names += (names.empty() ? "" : ", ") + key.name;
    }
    throw Error("no key is named \"" + options.name + "\" in " + options.keys().string() +
                "; there are " + names);
}

// Revokes a key; a second revocation keeps the first day. Throws Error for the master's key.
void revokeKey(const KeyOptions& options) {
    KeyFile key = chosen(options);
    if (key.role == KeyRole::Master)
        throw Error("the master's key cannot be revoked; replace it (aquarama keys rotate " +
                    options.rig + " master)");
    warnOfClock("the key is revoked, under the day of the build");
    if (key.revoked.empty()) key.revoked = today();
    config::writeKeyFile(config::keyFileIn(options.keys(), key.name), key);
    std::cout << key.name << " is revoked; a running master cuts it off within two seconds\n";
}

// Replaces the master's key. Every key file contains it, so all are rewritten.
void rotateMaster(const KeyOptions& options, const KeyFile& fresh) {
    for (KeyFile key : config::readKeyFolder(options.keys())) {
        if (key.role == KeyRole::Master) key = fresh;
        key.masterKey = fresh.publicKey;
        config::writeKeyFile(config::keyFileIn(options.keys(), key.name), key);
    }
    std::cout << "the master has a new key; start it again, and bundle every other key anew\n";
}

// Replaces a key. The new one is valid even if the old one was revoked.
void rotateKey(const KeyOptions& options) {
    const config::Rig rig = keyedRig(options);
    const KeyFile old = chosen(options);
    KeyFile fresh = enrol::freshKey(rig, options.rig, old.name, old.role, dayOfNewKey());
    if (old.role == KeyRole::Master) return rotateMaster(options, fresh);
    fresh.masterKey = old.masterKey;
    config::writeKeyFile(config::keyFileIn(options.keys(), fresh.name), fresh);
    std::cout << fresh.name << " has a new key; bundle it anew\n";
}

// Throws Error for the master's key, for a revoked one, and where the file exists.
void bundleKey(const KeyOptions& options) {
    const config::Rig rig = keyedRig(options);
    KeyFile key = chosen(options);
    if (key.role == KeyRole::Master)
        throw Error("the master's key stays on its machine; bundle that of a channel or a role");
    if (!key.revoked.empty())
        throw Error(key.name + " was revoked on " + key.revoked +
                    "; make a new key (aquarama keys rotate)");
    if (key.secretKey.empty())
        throw Error(key.name + ": its node alone has its secret (aquarama nodes assign); make a " +
                    "new key (aquarama keys rotate)");
    key.masterAddress = rig.controlAddress;
    key.depotAddress = rig.sides.depot;
    const fs::path out =
        options.out.empty() ? config::keyFileIn("", key.name) : fs::path(options.out);
    std::error_code none;
    if (fs::is_regular_file(out, none))
        throw Error(
            out.string() +
            ": is there already; remove it if its key was rotated, or choose another --out");
    config::writeKeyFile(out, key);
    std::cout << out.string() << ": carry it to its machine by a way that nobody reads\n";
    if (key.role == KeyRole::Node)
        std::cout << "there: aquarama-node --key " << out.filename().string() << '\n';
}

// Adds NAME only to commands about one key.
template <class Run>
AddedCommand<KeyOptions> addKeys(CommandLine& line,
                                 CLI::App& parent,
                                 const std::string& name,
                                 const std::string& what,
                                 Run run) {
    const auto added = line.addTo<KeyOptions>(parent, name, what, run);
    added.app.add_option("RIG", added.options.rig, "whose keys")->required();
    added.app.add_option("--keys", added.options.folder, "their folder, instead of the user's");
    return added;
}

template <class Run>
AddedCommand<KeyOptions> addOneKey(CommandLine& line,
                                   CLI::App& parent,
                                   const std::string& name,
                                   const std::string& what,
                                   Run run) {
    const auto added = addKeys(line, parent, name, what, run);
    added.app
        .add_option("NAME", added.options.name, "a channel, or watcher, visitor, operator, crew")
        ->required();
    return added;
}

}  // namespace

// `allowed` reads the folder at each call, so that a running master obeys revocations.
std::optional<net::MasterKeys> masterKeysOf(const config::Rig& rig,
                                            const supervisor::ShowOptions& show) {
    if (!config::needsKeys(rig)) return std::nullopt;
    KeyOptions options;
    options.rig = show.rigPath;
    options.folder = show.keyFolder;
    const KeyFile own = masterOf(options);
    // A file that is briefly unreadable excludes nobody.
    const auto allowed = [folder = options.keys(), last = net::Allowed{}]() mutable {
        try {
            net::Allowed now;
            for (const KeyFile& key : config::readKeyFolder(folder))
                if (key.revoked.empty() && key.role != KeyRole::Master)
                    now.emplace(key.publicKey, conductor::userOf(key.role, key.name));
            last = std::move(now);
        } catch (const Error& error) {
            logWarning("{}; the keys before stay valid", error.what());
        }
        return last;
    };
    return net::MasterKeys{{own.publicKey, own.secretKey}, allowed};
}

std::string guestsKeyOf(const config::Rig& rig, const supervisor::ShowOptions& show) {
    if (!rig.guests || !config::needsKeys(rig)) return {};
    KeyOptions options;
    options.rig = show.rigPath;
    options.folder = show.keyFolder;
    const fs::path file = config::keyFileIn(options.keys(), nameOf(KeyRole::Guests));
    if (fs::exists(file)) return config::readKeyFile(file).publicKey;
    logWarning("visitors with phones cannot take part: there is no {}; make it (aquarama keys new)",
               file.string());
    return {};
}

void addKeyCommands(CommandLine& line) {
    struct Nothing {};
    const auto keys = line.add<Nothing>(
        "keys", "manage the keys of a rig of several machines", [](const Nothing&) {
            throw CLI::RequiredError("keys: new, list, revoke, rotate or bundle");
        });
    addKeys(line, keys.app, "new", "make those that the rig lacks", makeKeys);
    addKeys(line, keys.app, "list", "list the keys: holder, age, and whether revoked", listKeys);
    addOneKey(line, keys.app, "revoke", "somebody may not take part any more", revokeKey);
    addOneKey(
        line, keys.app, "rotate", "replace a holder's key; the old one becomes invalid", rotateKey);
    const auto bundle =
        addOneKey(line, keys.app, "bundle", "write the one file for another machine", bundleKey);
    bundle.app.add_option("--out", bundle.options.out, "file; NAME.key here when left out");
}

}  // namespace aquarama
