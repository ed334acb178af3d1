// SPDX-License-Identifier: Apache-2.0
// A node that has no key yet: the code that its screen shows, and what it answers to whoever wants
// to give it a key.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "common/config/keys.h"
#include "common/enrol/proof.h"
#include "common/enrol/words.h"
#include "common/net/channels.h"

namespace aquarama::enrol {

// A value on a simulated clock. Takes a key from the first who shows the code, over one connection,
// and from nobody else.
class WaitingNode {
  public:
    // Keeps a key where the node finds it again. Throws Error where it cannot.
    using Keep = std::function<void(const config::KeyFile&)>;
    // `publicKey`: under which it is spoken to.
    WaitingNode(std::string publicKey, net::Moment now, Keep keep);

    // As typed_code.h has it, without the hyphen that a screen shows.
    [[nodiscard]] const std::string& code() const { return code_; }
    // Whether the code was replaced: it is valid for ten minutes, and for so many wrong guesses.
    bool renewCode(net::Moment now);
    // What it answers; nothing: it says nothing to that.
    [[nodiscard]] std::optional<Word> hear(const net::PeerId& peer,
                                           const Word& word,
                                           net::Moment now);
    // The key that it was given, and has kept.
    [[nodiscard]] const std::optional<config::KeyFile>& key() const { return key_; }

    static constexpr net::Duration kCodeLives = std::chrono::minutes(10);
    static constexpr int kMostWrong = 20;
    static constexpr net::Duration kBetweenGuesses = std::chrono::seconds(1);

  private:
    [[nodiscard]] Word judge(const net::PeerId& peer, std::string_view proof, net::Moment now);
    [[nodiscard]] Word take(const std::string& text);
    void makeCode(net::Moment now);

    std::string publicKey_;
    Keep keep_;
    std::string code_;
    std::optional<CodeKey> codeKey_;  // of the code
    net::Moment madeAt_;
    net::Moment guessedAt_{};  // last
    int wrong_ = 0;            // guesses at this code
    net::PeerId known_;        // who has shown the code; empty: nobody
    std::optional<config::KeyFile> key_;
};

}  // namespace aquarama::enrol
