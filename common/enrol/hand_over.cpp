// SPDX-License-Identifier: Apache-2.0
#include "common/enrol/hand_over.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include "common/base/dates.h"
#include "common/base/log.h"
#include "common/base/typed_code.h"
#include "common/enrol/proof.h"
#include "common/enrol/words.h"
#include "common/net/channels.h"

namespace aquarama::enrol {

namespace {

namespace fs = std::filesystem;
using config::KeyFile;
using config::KeyRole;

constexpr net::Duration kPatience = std::chrono::seconds(5);  // for each answer

// The node's first word of a kind, or its refusal.
std::optional<Word> hear(net::NodeChannels& channels, Word::Kind kind) {
    while (const auto packet = channels.receiveControl()) {
        const auto word = wordIn(*packet);
        if (word && word->kind == Word::Kind::Refused)
            throw Error("the node refuses: " + word->content);
        if (word && word->kind == kind) return word;
    }
    return std::nullopt;
}

// Says it until the answer is there: what is said before the connection is made is lost.
Word ask(net::NodeChannels& channels, const Word& question, Word::Kind answer, bool isRepeated) {
    constexpr net::Duration kBetween = std::chrono::milliseconds(200);
    const net::Moment begun = net::monotonicNow();
    const std::vector<std::byte> packet = packetOf(question);
    channels.sendControl(packet);
    while (net::monotonicNow() < begun + kPatience) {
        channels.wait(kBetween);
        if (const auto word = hear(channels, answer)) return *word;
        if (isRepeated) channels.sendControl(packet);
    }
    throw Error("it does not answer; see that it still shows its letter, and try again");
}

}  // namespace

void handOver(const FoundNode& node,
              std::string_view code,
              const std::function<KeyFile()>& makeKey) {
    const auto channels = net::connectNode(node.address,
                                           {.toMaster = kMostWordBytes, .toNode = kMostWordBytes},
                                           net::PeerKeys{node.publicKey, net::makeKeyPair()});
    const CodeKey key(plainCode(code), node.publicKey);
    const Word proof =
        ask(*channels, {Word::Kind::Proof, key.proofOf(Side::Assigner)}, Word::Kind::Proof, true);
    if (!key.isProof(Side::Node, proof.content))
        throw Error("it does not know the code itself: somebody else answers in its place");
    ask(*channels, {Word::Kind::KeyFile, config::textOf(makeKey())}, Word::Kind::Taken, false);
}

std::string dayOfNewKey(double now, double built) {
    if (const std::string doubt = clockDoubt(now, built); !doubt.empty())
        throw Error(doubt + ": no key is made now; " + kSetTheClock);
    return dayOf(std::max(now, built));
}

KeyFile freshKey(const config::Rig& rig,
                 const std::string& rigPath,
                 const std::string& name,
                 KeyRole role,
                 const std::string& day) {
    net::KeyPair pair = net::makeKeyPair();
    return {.rig = fs::path(rigPath).stem().string(),
            .masterAddress = rig.controlAddress,
            .masterKey = {},
            .name = name,
            .role = role,
            .publicKey = std::move(pair.publicKey),
            .secretKey = std::move(pair.secretKey),
            .made = day,
            .revoked = {},
            .depotAddress = rig.sides.depot};
}

void assignChannel(const std::string& rigPath,
                   const fs::path& folder,
                   const FoundNode& node,
                   const std::string& channel,
                   std::string_view code,
                   const std::string& day) {
    const config::Rig rig = config::readRig(rigPath);
    if (!config::needsKeys(rig))
        throw Error(rigPath + ": listens on its own machine only; give network the address of a " +
                    "network card first");
    if (std::ranges::find(rig.channels, channel, &config::Channel::name) == rig.channels.end())
        throw Error(rigPath + ": has no channel \"" + channel + "\"");
    const KeyFile master = config::readKeyFile(config::keyFileIn(folder, "master"));
    handOver(node, code, [&] {
        KeyFile key = freshKey(rig, rigPath, channel, KeyRole::Node, day);
        key.masterKey = master.publicKey;
        // The node alone has the secret: who starts with the master's file does not take its place.
        KeyFile known = key;
        known.secretKey.clear();
        config::writeKeyFile(config::keyFileIn(folder, channel), known);
        return key;
    });
}

}  // namespace aquarama::enrol
