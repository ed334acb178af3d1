// SPDX-License-Identifier: Apache-2.0
#include "common/enrol/waiting_node.h"

#include <utility>

#include "common/base/log.h"
#include "common/base/typed_code.h"

namespace aquarama::enrol {

WaitingNode::WaitingNode(std::string publicKey, net::Moment now, Keep keep)
    : publicKey_{std::move(publicKey)}, keep_{std::move(keep)}, madeAt_{now} {
    makeCode(now);
}

void WaitingNode::makeCode(net::Moment now) {
    code_ = freshCode();
    codeKey_.emplace(code_, publicKey_);
    madeAt_ = now;
    wrong_ = 0;
    known_.clear();
}

bool WaitingNode::renewCode(net::Moment now) {
    if (wrong_ < kMostWrong && now < madeAt_ + kCodeLives) return false;
    makeCode(now);
    return true;
}

std::optional<Word> WaitingNode::hear(const net::PeerId& peer, const Word& word, net::Moment now) {
    if (word.kind == Word::Kind::Proof) return judge(peer, word.content, now);
    if (word.kind == Word::Kind::KeyFile && !known_.empty() && peer == known_)
        return take(word.content);
    return std::nullopt;
}

// Guesses are slow: 2^40 of them are not made while a code is valid. Who has shown it may say so
// again, as the answer may be on its way.
Word WaitingNode::judge(const net::PeerId& peer, std::string_view proof, net::Moment now) {
    const bool isKnown = !known_.empty() && peer == known_;
    if (!isKnown && now < guessedAt_ + kBetweenGuesses)
        return {Word::Kind::Refused, "somebody has just tried a code; try again in a second"};
    guessedAt_ = now;
    if (!codeKey_->isProof(Side::Assigner, proof)) {
        ++wrong_;
        return {Word::Kind::Refused, "this is not the code on its screen"};
    }
    known_ = peer;
    return {Word::Kind::Proof, codeKey_->proofOf(Side::Node)};
}

Word WaitingNode::take(const std::string& text) {
    try {
        config::KeyFile key = config::parseKeyFile(text, "the key that was handed over");
        if (key.role != config::KeyRole::Node)
            return {Word::Kind::Refused, "it takes the key of a channel only"};
        keep_(key);
        key_ = std::move(key);
        return {Word::Kind::Taken, ""};
    } catch (const Error& problem) {
        return {Word::Kind::Refused, problem.what()};
    }
}

}  // namespace aquarama::enrol
