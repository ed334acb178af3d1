// SPDX-License-Identifier: Apache-2.0
#include "common/cli/passphrase.h"

#include <chrono>
#include <fstream>
#include <iostream>

#include <unistd.h>

#include "common/base/log.h"
#include "common/cli/keyboard.h"

namespace aquarama::cli {

namespace {

constexpr char kInterrupt = '\x03', kEnd = '\x04', kBackspace = '\b', kDelete = '\x7F';

// Takes away the last character, of whatever number of bytes.
void removeLast(std::string& text) {
    const auto isWithin = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
    while (!text.empty() && isWithin(text.back())) text.pop_back();
    if (!text.empty()) text.pop_back();
}

// Takes a key; true: the line has ended.
bool take(char key, std::string& line) {
    if (key == kInterrupt || key == kEnd) throw Error("no passphrase was given");
    if (key == '\n' || key == '\r') return true;
    if (key == kBackspace || key == kDelete)
        removeLast(line);
    else
        line += key;
    return false;
}

std::string ask(const std::string& question) {
    Keyboard keyboard;  // before the question: nothing that is typed early is shown
    std::cerr << question << ": " << std::flush;
    std::string keys, line;
    for (bool isOver = false; !isOver;) {
        if (!keyboard.read(keys, std::chrono::hours(1))) throw Error("no passphrase was given");
        for (const char key : keys) isOver = isOver || take(key, line);
    }
    std::cerr << '\n';
    return line;
}

std::string firstLineOf(std::istream& in, const std::string& name) {
    std::string line;
    if (!std::getline(in, line) || line.empty())
        throw Error(name + ": has no passphrase in its first line");
    return line;
}

}  // namespace

std::string readPassphrase(const std::string& file, PassphraseUse use) {
    if (file == "-") return firstLineOf(std::cin, "standard input");
    if (!file.empty()) {
        std::ifstream in(file);
        if (!in) throw Error(file + ": cannot be read; name a file with the passphrase");
        return firstLineOf(in, file);
    }
    if (isatty(STDIN_FILENO) == 0)
        throw Error("the passphrase is asked at a terminal; give --passphrase FILE without one");
    std::string passphrase = ask("Passphrase");
    if (use == PassphraseUse::New && ask("Once more") != passphrase)
        throw Error("the passphrases differ; try again");
    return passphrase;
}

}  // namespace aquarama::cli
