// SPDX-License-Identifier: Apache-2.0
#include "master/capture/species_text.h"

#include <cassert>
#include <cctype>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <sstream>
#include <string_view>
#include <tuple>

#include "common/base/log.h"

namespace aquarama::capture {

namespace {

constexpr std::size_t kEnd = std::string_view::npos;

// Whether a character is part of a name or a number.
bool isWord(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-' ||
           c == '+';
}

// Reads the tokens of protobuf's text format that matter here: words (names and numbers) and
// braces. It skips comments, strings and all other characters. Strings have no escapes in species
// files.
class TextWalk {
  public:
    explicit TextWalk(std::string_view text) : text_(text) {}

    // The next word, "{" or "}"; empty at the end.
    std::string_view next() {
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '#')
                skipTo('\n');
            else if (c == '"') {
                ++at_;
                skipTo('"');
            } else if (c == '{' || c == '}')
                return text_.substr(at_++, 1);
            else if (isWord(c))
                return word();
        }
        return {};
    }
    // The place in the text just after the last token.
    [[nodiscard]] std::size_t position() const { return at_; }

  private:
    void skipTo(char end) {
        at_ = text_.find(end, at_);
        if (at_ == kEnd) at_ = text_.size();
    }
    std::string_view word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && isWord(text_[at_])) ++at_;
        return text_.substr(begin, at_ - begin);
    }

    std::string_view text_;  // must outlive the walk
    std::size_t at_ = 0;
};

std::string written(double value) {
    std::ostringstream number;
    number.precision(4);
    number << value;
    return number.str();
}

}  // namespace

std::string withNumber(const std::string& text,
                       const std::vector<std::string>& field,
                       double value) {
    assert(!field.empty());
    TextWalk walk(text);
    // The names of the open messages, and at the end the last word read: where it equals `field`,
    // the next token is the value.
    std::vector<std::string> path{""};
    for (std::string_view token = walk.next(); !token.empty(); token = walk.next()) {
        if (token == "{")
            path.emplace_back();
        else if (token == "}") {
            if (path.size() > 1) path.pop_back();
        } else
            path.back() = token;
        if (path != field) continue;
        const std::string_view old = walk.next();
        return std::string(text).replace(walk.position() - old.size(), old.size(), written(value));
    }
    throw Error(
        "the species file has no field " +
        std::accumulate(field.begin() + 1,
                        field.end(),
                        field.front(),
                        [](const std::string& a, const std::string& b) { return a + '.' + b; }));
}

std::string withGaitsOf(const config::Species& species, std::string text) {
    const auto& [tissue, water, swim] = std::tie(species.tissue, species.water, species.swim);
    const auto set = [&](const std::vector<std::string>& field, double value) {
        text = withNumber(text, field, value);
    };
    set({"tissue", "stiffness"}, tissue.stiffness);
    set({"tissue", "cross_stiffness"}, tissue.crossStiffness);
    set({"tissue", "muscle_stiffness"}, tissue.muscleStiffness);
    set({"tissue", "tail_stiffening"}, tissue.tailStiffening);
    set({"tissue", "damping"}, tissue.damping);
    set({"water", "drag"}, water.drag);
    set({"water", "front_factor"}, water.frontFactor);
    set({"swim", "middle_drive"}, swim.middleDrive);
    set({"swim", "back_drive"}, swim.backDrive);
    set({"swim", "back_lag_deg"}, swim.backLagRadians * 180 / std::numbers::pi);
    set({"swim", "slow", "gain"}, swim.slow.gain);
    set({"swim", "fast", "gain"}, swim.fast.gain);
    set({"turn", "gradual", "strength"}, species.turn.gradual.strength);
    set({"turn", "sharp", "strength"}, species.turn.sharp.strength);
    return text;
}

}  // namespace aquarama::capture
