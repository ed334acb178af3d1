// SPDX-License-Identifier: Apache-2.0
#include "common/machine/machine_power.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama::machine {
namespace {

namespace fs = std::filesystem;

TEST(MachinePower, aMachineIsToldOneOfTwoWordsWhereItTakesThem) {
    const fs::path folder =
        fs::temp_directory_path() / ("aquarama-power-" + std::to_string(getpid()));
    fs::create_directories(folder);
    EXPECT_FALSE(takesPowerWord(folder / "none"));
    EXPECT_THROW(sayPower(folder / "none", "reboot"), Error);
    EXPECT_TRUE(takesPowerWord(folder));
    EXPECT_THROW(sayPower(folder, "reboot; rm"), Error);
    EXPECT_TRUE(fs::is_empty(folder));
    sayPower(folder, "reboot");
    std::ifstream file(folder / "word");
    std::string word;
    EXPECT_TRUE(std::getline(file, word) && !file.eof()) << "a whole line";
    EXPECT_EQ(word, "reboot");
    fs::remove_all(folder);
}

TEST(MachinePower, theFolderIsThatOfTheServiceUnlessTheEnvironmentNamesAnother) {
    unsetenv("AQUARAMA_POWER_FOLDER");
    EXPECT_EQ(powerFolder(), "/run/aquarama/power");
    setenv("AQUARAMA_POWER_FOLDER", "/tmp/word", 1);
    EXPECT_EQ(powerFolder(), "/tmp/word");
    unsetenv("AQUARAMA_POWER_FOLDER");
}

}  // namespace
}  // namespace aquarama::machine
