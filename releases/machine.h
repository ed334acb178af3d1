// SPDX-License-Identifier: Apache-2.0
// What an agent wants of its machine: a program that tells what runs, and switches channels, boot
// entries and power.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "releases/release.h"

namespace aquarama::releases {

// A machine, as the agent knows it. All functions throw Error where the program fails.
class Machine {
  public:
    // `program`: called with a word, and what follows it.
    explicit Machine(std::filesystem::path program) : program_(std::move(program)) {}

    // The version that runs, and a word that differs with each start of the machine.
    struct Started {
        std::string version, boot;
    };
    [[nodiscard]] Started started() const;
    // How many frames each channel has presented without a break; of a machine without channels,
    // more than any.
    [[nodiscard]] std::uint64_t frames() const;
    void show(bool isOn) const;  // returns when the channels are on their way, or dark
    // The text of the boot loader's entry.
    [[nodiscard]] std::string entry(const ReleaseId& release) const;
    void reboot() const;  // returns before

  private:
    // What the program says.
    [[nodiscard]] std::string ask(const std::string& words) const;
    std::filesystem::path program_;
};

}  // namespace aquarama::releases
