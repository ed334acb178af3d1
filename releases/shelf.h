// SPDX-License-Identifier: Apache-2.0
// The releases of a machine's system partition: their folders, and the boot loader's entries.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "releases/boot.h"
#include "releases/machine.h"

namespace aquarama::releases {

// A folder with aquarama/VERSION/ and loader/entries/. One thread uses it.
class Shelf {
  public:
    explicit Shelf(std::filesystem::path system) : system_(std::move(system)) {}

    // Where a release lies, or would.
    [[nodiscard]] std::filesystem::path folderOf(const std::string& version) const;
    // Without those that a power cut has left empty: the boot loader passes over them.
    [[nodiscard]] std::vector<BootEntry> entries() const;
    // Those that the boot loader holds for good.
    [[nodiscard]] std::vector<ReleaseId> good() const;
    // Removes empty entries, then changes the others, one after the other. Throws Error where one
    // cannot be changed.
    void change(const std::vector<BootStep>& steps, const Machine& machine) const;
    // Leaves these, if one of them is good; all others are removed, with their entries.
    void keepOnly(const std::vector<ReleaseId>& kept, const Machine& machine) const;

  private:
    [[nodiscard]] std::filesystem::path entryFolder() const { return system_ / "loader/entries"; }
    // Of our own entries.
    [[nodiscard]] std::vector<std::filesystem::path> entryFiles() const;
    std::filesystem::path system_;
};

}  // namespace aquarama::releases
